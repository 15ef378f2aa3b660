#include "model/tracks.hpp"

#include <gnomon/base/error.hpp>
#include <numeric>

#include "model/connected_parts.hpp"

namespace gnomon {

namespace {

/// Nodes with one shape, which is carried by the first.
struct UniformLine {
  std::vector<int> nodes;
  double part;  ///< their length by that of the path
};

std::vector<UniformLine> lines_of(const CrossSection& section) {
  std::vector<UniformLine> lines;
  for (const int carrier : section.node)
    lines.push_back({{carrier}, section.length / section.path});
  for (std::size_t node = 0; node < section.of.size(); ++node)
    if (UniformLine& line = lines[section.of[node]]; line.nodes.front() != static_cast<int>(node))
      line.nodes.push_back(static_cast<int>(node));
  return lines;
}

/// What one node of a line may do, all may.
template <int dim>
void require_alike(const UniformLine& line, const ShapeMotion<dim>& shape) {
  constexpr double rounding = 1e-12;
  const Tensor<dim> first = shape.free(line.nodes.front());
  for (const int node : line.nodes)
    if (!(shape.free(node) - first).isZero(rounding))
      throw InputError(
          "an assembly: expected nodes of a line of a track whose shape is held alike");
}

/// `length`: of each surface's; 0: it has no track.
template <int dim>
std::vector<UniformLine> uniform_lines(const AssemblyParts<dim>& parts,
                                       std::vector<double>& length) {
  if (parts.cross_section) return lines_of(*parts.cross_section);
  std::vector<UniformLine> result;
  for (const Surface<dim>& surface : parts.interface.surfaces) {
    length.push_back(0);
    if (!surface.track) continue;
    SurfaceLines lines = lines_of_surface(parts.mesh, surface.facets, surface.track->along);
    length.back() = lines.length;
    for (std::vector<int>& nodes : lines.nodes) {
      result.push_back({std::move(nodes), lines.length / surface.track->path});
      require_alike(result.back(), parts.shape);
    }
  }
  return result;
}

}  // namespace

/// What all nodes of a line together wear off moves all of them. A node that alone had the
/// rate Wdot A moved by it / A; in the sum over the line it counts by its part of the line's area,
/// seen along the mean normal of a line that is curved, and of the path.
template <int dim>
SharedShape shared_shape(const AssemblyParts<dim>& parts,
                         const std::vector<ContactPatch<dim>>& patches) {
  SharedShape result;
  const std::vector<UniformLine> lines = uniform_lines(parts, result.length);
  if (lines.empty()) return {};
  result.carrier.resize(parts.mesh.nodes.size());
  std::iota(result.carrier.begin(), result.carrier.end(), 0);
  std::vector<Vector<dim>> area(parts.mesh.nodes.size(), Vector<dim>::Zero());
  std::vector<double> weight(parts.mesh.nodes.size(), 1);
  for (const ContactPatch<dim>& patch : patches)
    area[patch.node] = patch.initial_area * patch.initial_normal;
  for (const auto& [nodes, part] : lines) {
    Vector<dim> sum = Vector<dim>::Zero();
    for (const int node : nodes) sum += area[node];
    const double whole = sum.norm();
    for (const int node : nodes) {
      result.carrier[node] = nodes.front();
      if (whole > 0) weight[node] = part * area[node].norm() / whole;
    }
  }
  for (const ContactPatch<dim>& patch : patches) result.weight.push_back(weight[patch.node]);
  return result;
}

namespace {

/// Between a facet and where it was.
template <int dim>
double volume_behind(const Mesh<dim>& mesh, const typename Mesh<dim>::Facet& facet,
                     const NodalField<dim>& d) {
  constexpr int corners = Mesh<dim>::facet_nodes;
  CellNodal<dim> X;
  for (int a = 0; a < corners; ++a) {
    const int node = facet[dim == 2 ? a : corners - 1 - a];  // out of the body it goes round
    const Vector<dim> initial = mesh.nodes[static_cast<std::size_t>(node)];
    X.row(a) = initial.transpose();
    X.row(dim == 2 ? 3 - a : corners + a) = initial.transpose() + d.row(node);
  }
  return cell_volume<dim>(X, Section::plane);
}

}  // namespace

template <int dim>
std::vector<double> worn_beyond_mesh(const Assembly<dim>& assembly, const NodalField<dim>& d) {
  std::vector<double> result(assembly.bodies.size(), 0);
  if (assembly.track_length.empty()) return result;
  const std::vector<int> owner = body_of_nodes(assembly.mesh, assembly.body_of);
  for (std::size_t s = 0; s < assembly.interface.surfaces.size(); ++s) {
    const Surface<dim>& surface = assembly.interface.surfaces[s];
    if (!surface.track) continue;
    const double beyond = surface.track->path / assembly.track_length[s] - 1;
    for (const auto& facet : surface.facets)
      result[owner[facet.front()]] += beyond * volume_behind<dim>(assembly.mesh, facet, d);
  }
  return result;
}

template SharedShape shared_shape(const AssemblyParts<2>&, const std::vector<ContactPatch<2>>&);
template SharedShape shared_shape(const AssemblyParts<3>&, const std::vector<ContactPatch<3>>&);
template std::vector<double> worn_beyond_mesh(const Assembly<2>&, const NodalField<2>&);
template std::vector<double> worn_beyond_mesh(const Assembly<3>&, const NodalField<3>&);

}  // namespace gnomon
