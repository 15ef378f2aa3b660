// The nodes of a surface that is uniform along straight lines or circles, on these. Straight lines
// may be a little curved, as those of a wheel that turns, where edges of the surface follow them
// from end to end.
#pragma once

#include <gnomon/mesh/mesh.hpp>
#include <optional>
#include <vector>

namespace gnomon {

/// Along which the material of a surface moves: straight lines, or circles.
template <int dim>
struct Streamlines {
  Vector<dim> along;                    ///< direction of the lines, or axis of the circles: unit
  std::optional<Vector<dim>> centre{};  ///< of circles, in space: a point of their axis

  /// What holds nodes that share their shape: they do not move along straight lines; on circles,
  /// where directions differ from node to node, only along the axis.
  Tensor<dim> held() const {
    const Tensor<dim> dyad = along * along.transpose();
    return centre ? Tensor<dim>(Tensor<dim>::Identity() - dyad) : dyad;
  }
};

struct SurfaceLines {
  std::vector<std::vector<int>> nodes;  ///< mesh nodes of each line, from one end to the other
  double length = 0;  ///< of every line; of circles at the mean of their radii; of curved ones that
                      ///< of their chords, over which they are shifted [length]
};

/// In the plane the surface is a single line. Circles may be closed. Throws InputError where a node
/// lies on no line that goes from one end of the surface to the other.
template <int dim>
SurfaceLines lines_of_surface(const Mesh<dim>& mesh,
                              const std::vector<typename Mesh<dim>::Facet>& facets,
                              const Streamlines<dim>& along);

}  // namespace gnomon
