#include "part/shape_support.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "base/spectrum.hpp"
#include "part/groups.hpp"
#include "part/histories.hpp"
#include "part/sliding_sides.hpp"

namespace gnomon::part {

std::vector<Key> shape_support_keys() {
  return {real_key("shape.reach", "mm",
                   absent("the whole body, or, where it is large, what the wear is expected to "
                          "move (gnomon check prints it)"),
                   positive_quantity,
                   "distance from the wearing surfaces up to which the mesh moves (Remark 2)"),
          texts_key("shape.hold", by_default(std::vector<std::string>{}),
                    "groups of the mesh whose shape is held altogether"),
          texts_key("shape.slide", by_default(std::vector<std::string>{}),
                    "groups that are nearly planes, whose shape slides in them, or nearly round "
                    "cylinders along a coordinate direction, along which it slides; exact ones do "
                    "so without being named")};
}

namespace {

/// By node: the sum of what holds it.
template <int dim>
using HeldNodes = std::map<int, Held<dim>>;

template <int dim>
void hold(const typename Mesh<dim>::Facet& facet, const Held<dim>& held, HeldNodes<dim>& nodes) {
  for (int node : facet) nodes.try_emplace(node, Held<dim>::Zero()).first->second += held;
}

/// Projector on the directions that nothing holds. Planes that are `nearly` parallel are one.
template <int size>
Tensor<size> free_directions(const Held<size>& held) {
  const auto [values, vectors] = spectrum_of(held);
  Tensor<size> free = Tensor<size>::Zero();
  for (int k = 0; k < size; ++k)
    if (values[k] < nearly * nearly / 2) free += vectors.col(k) * vectors.col(k).transpose();
  return free;
}

/// What holds one node of a line of a track, holds all, and none moves along it.
template <int dim>
void hold_line(const std::vector<int>& line, const Vector<dim>& along, HeldNodes<dim>& nodes) {
  Held<dim> held = along * along.transpose();
  for (const int node : line)
    if (const auto own = nodes.find(node); own != nodes.end()) held += own->second;
  for (const int node : line) nodes[node] = held;
}

/// Likewise by radius and axis. The nodes move in one direction: that of the normals `area`, as far
/// as nothing holds it.
template <int dim>
void hold_circle(const std::vector<int>& line, const Streamlines<dim>& circle,
                 const Mesh<dim>& mesh, const NodalField<dim>& area, HeldNodes<dim>& nodes) {
  constexpr double across = 0.1, rounding = 1e-9;
  const auto frame = [&](int node) { return circle.across(mesh.nodes[node]); };
  Held<dim - 1> held = Held<dim - 1>::Zero();
  Vector<dim - 1> normal = Vector<dim - 1>::Zero();
  for (const int node : line) {
    normal += frame(node).transpose() * area.row(node).transpose();
    if (const auto own = nodes.find(node); own != nodes.end())
      held += frame(node).transpose() * own->second * frame(node);
  }
  Vector<dim - 1> direction = free_directions<dim - 1>(held) * normal.normalized();
  if (direction.norm() < across) direction.setZero();
  direction.normalize();
  for (double& component : direction)
    if (std::abs(component) < rounding) component = 0;
  for (const int node : line) {
    const Vector<dim> along = frame(node) * direction;
    nodes[node] = altogether<dim>() - along * along.transpose();
  }
}

template <int dim>
void hold_lines(const Mesh<dim>& mesh, const Surface<dim>& surface, HeldNodes<dim>& nodes) {
  const Streamlines<dim>& along = surface.track->along;
  NodalField<dim> area = NodalField<dim>::Zero(static_cast<Eigen::Index>(mesh.nodes.size()), dim);
  for (const auto& patch : contact_patches<dim>(mesh, surface.facets))
    area.row(patch.node) = patch.initial_area * patch.initial_normal.transpose();
  for (const auto& line : lines_of_surface(mesh, surface.facets, along).nodes)
    if (along.centre)
      hold_circle<dim>(line, along, mesh, area, nodes);
    else
      hold_line<dim>(line, along.along, nodes);
}

template <int dim>
HeldNodes<dim> held_nodes(const Scene& scene, const ImportedBody<dim>& part,
                          const std::vector<Surface<dim>>& wearing, const Facets<dim>& bonded) {
  HeldNodes<dim> nodes;
  for (const auto& [facet, held] : held_by_sides<dim>(scene, part, facets_of(wearing)))
    hold<dim>(facet, held, nodes);
  for (const auto& [facet, held] : held_by_bonds<dim>(part.mesh, bonded))
    hold<dim>(facet, held, nodes);
  for (const std::string& name : scene.texts("shape.hold"))
    for (const auto& facet : group_facets(scene, "shape.hold", name, part))
      hold<dim>(facet, altogether<dim>(), nodes);
  for (const Surface<dim>& surface : wearing)
    if (surface.track) hold_lines(part.mesh, surface, nodes);
  return nodes;
}

/// Components that are not free need no unknown; what is oblique to them is described by a
/// projector.
template <int dim>
void hold(int node, Held<dim> held, ShapeSupport<dim>& support) {
  constexpr double rounding = 1e-12;
  for (int i = 0; i < dim; ++i) held(i, i) += support.held(node, i);
  Tensor<dim> free = free_directions<dim>(held);
  for (int i = 0; i < dim; ++i) {
    if (free(i, i) > rounding) continue;
    support.held(node, i) = 1;
    free.row(i).setZero();
    free.col(i).setZero();
  }
  if (!free.isDiagonal(rounding)) support.along[node] = free;
}

template <int dim>
void hold_altogether(int node, ShapeSupport<dim>& support) {
  support.held.row(node).setOnes();
  support.along.erase(node);
}

/// Nodes in boxes as large as the reach, so that only neighbouring boxes are searched.
template <int dim>
class NearNodes {
public:
  NearNodes(const Mesh<dim>& mesh, const std::vector<char>& chosen, double reach)
      : mesh_(mesh), reach_(reach) {
    for (std::size_t node = 0; node < chosen.size(); ++node)
      if (chosen[node]) boxes_[box_of(mesh.nodes[node])].push_back(static_cast<int>(node));
  }
  bool contains(const Vector<dim>& x) const {
    constexpr int neighbours = dim == 2 ? 9 : 27;
    for (int k = 0; k < neighbours; ++k) {
      Box box = box_of(x);
      int steps = k;  // digits to the base three: one box back, the same, one on
      for (long& place : box) place += steps % 3 - 1, steps /= 3;
      const auto found = boxes_.find(box);
      if (found != boxes_.end() && std::ranges::any_of(found->second, [&](int node) {
            return (mesh_.nodes[node] - x).squaredNorm() <= reach_ * reach_;
          }))
        return true;
    }
    return false;
  }

private:
  using Box = std::array<long, dim>;
  Box box_of(const Vector<dim>& x) const {
    Box box;
    for (int i = 0; i < dim; ++i) box[i] = static_cast<long>(std::floor(x[i] / reach_));
    return box;
  }
  const Mesh<dim>& mesh_;
  double reach_;
  std::map<Box, std::vector<int>> boxes_;
};

template <int dim>
double longest_edge(const Mesh<dim>& mesh, const Facets<dim>& facets) {
  double size = 0;
  for (const auto& facet : facets)
    for (std::size_t k = 1; k < facet.size(); ++k)
      size = std::max(size, (mesh.nodes[facet[k]] - mesh.nodes[facet[k - 1]]).norm());
  return size;
}

/// A small body moves as a whole. In a large one elements strain by no more than a twentieth where
/// the mesh moves over twenty depths, and over four facets at least.
template <int dim>
double default_reach(const Mesh<dim>& mesh, const Facets<dim>& wearing, double expected_depth) {
  constexpr std::size_t small = 20'000;  // nodes
  if (mesh.nodes.size() < small) return std::numeric_limits<double>::infinity();
  return std::max(20 * expected_depth, 4 * longest_edge(mesh, wearing));
}

}  // namespace

template <int dim>
ShapeSupport<dim> read_shape_support(const Scene& scene, const ImportedBody<dim>& part,
                                     const std::vector<Surface<dim>>& wearing,
                                     const Facets<dim>& bonded, double expected_depth) {
  const auto nodes = static_cast<Eigen::Index>(part.mesh.nodes.size());
  ShapeSupport<dim> support{.held = NodalFlags<dim>::Zero(nodes, dim)};
  if constexpr (dim == 2)
    if (section_of(scene) == Section::meridian) support.held = held_on_axis(part.mesh);
  for (const auto& [node, held] : held_nodes<dim>(scene, part, wearing, bonded))
    hold<dim>(node, held, support);
  support.reach = scene.real_if("shape.reach")
                      .value_or(default_reach(part.mesh, facets_of(wearing), expected_depth));
  if (!std::isfinite(support.reach)) return support;
  std::vector<char> worn(part.mesh.nodes.size());
  for (const auto& facet : facets_of(wearing))
    for (int node : facet) worn[node] = 1;
  const NearNodes<dim> near(part.mesh, worn, support.reach);
  for (Eigen::Index node = 0; node < nodes; ++node)
    if (!near.contains(part.mesh.nodes[node])) hold_altogether<dim>(node, support);
  return support;
}

template ShapeSupport<2> read_shape_support(const Scene&, const ImportedBody<2>&,
                                            const std::vector<Surface<2>>&, const Facets<2>&,
                                            double);
template ShapeSupport<3> read_shape_support(const Scene&, const ImportedBody<3>&,
                                            const std::vector<Surface<3>>&, const Facets<3>&,
                                            double);

}  // namespace gnomon::part
