#include <gnomon/base/error.hpp>
#include <gnomon/model/gap_motion.hpp>
#include <optional>
#include <set>

#include "model/initial_gradient.hpp"

namespace gnomon {

namespace {

/// The nodes that wear, by the first surface that has them.
template <int dim>
std::vector<ContactPatch<dim>> nodes_of(const AssemblyParts<dim>& parts,
                                        const Surface<dim>& surface) {
  return contact_patches<dim>(parts.mesh, surface.facets, parts.interface.boundary,
                              parts.section());
}

/// Whether a body does over the cycle.
template <int dim>
bool turns(const AssemblyParts<dim>& parts, int body) {
  return std::ranges::any_of(parts.phases, [&](const Phase<dim>& phase) {
    return !phase.places.empty() && !phase.places[static_cast<std::size_t>(body)].turn.isIdentity();
  });
}

/// The direction in which the partner of a surface comes near to it, in the frame of its body: of
/// bodies that meet several others, or turn over the cycle, there is none.
template <int dim>
std::optional<Vector<dim>> approach_to(const AssemblyParts<dim>& parts,
                                       const Surface<dim>& surface) {
  if (parts.pairs.empty()) return parts.interface.partner.approach;
  std::optional<Vector<dim>> approach;
  const auto has = [&](const std::vector<typename Mesh<dim>::Facet>& facets) {
    return std::ranges::find(facets, surface.facets.front()) != facets.end();
  };
  for (const MortarPair<dim>& pair : parts.pairs)
    for (const bool slave : {true, false}) {
      if (!has(slave ? pair.slave : pair.master)) continue;
      if (approach || turns(parts, pair.numbers[slave ? 0 : 1])) return {};
      approach = slave ? pair.approach : Vector<dim>(-pair.approach);
    }
  return approach;
}

/// Whether depths along the direction in which the partner comes describe the worn surface: it does
/// not turn away from it by more than 60 degrees.
template <int dim>
bool faces_partner(const std::vector<ContactPatch<dim>>& nodes,
                   const std::optional<Vector<dim>>& approach) {
  constexpr double least_cosine = 0.5;
  return approach && std::ranges::all_of(nodes, [&](const ContactPatch<dim>& patch) {
           return -patch.initial_normal.dot(*approach) >= least_cosine;
         });
}

/// m: the wanted direction within the motion that is free; where that is across, the direction that
/// changes the volume. Zero where no motion does.
template <int dim>
Vector<dim> direction_of(const Mesh<dim>& mesh, ContactPatch<dim> patch, const Tensor<dim>& free,
                         const Vector<dim>& wanted) {
  constexpr double across = 0.1, none = 1e-4;
  if (const Vector<dim> m = free * wanted; m.norm() > across) return m.normalized();
  patch.shape_free = free;
  const Vector<dim> a = initial_volume_gradient(mesh, patch);
  return a.norm() > none * patch.initial_area ? Vector<dim>(a.normalized()) : Vector<dim>::Zero();
}

/// Node by node: components that m does not have need no unknown.
template <int dim>
void move_along(int node, Vector<dim> m, ShapeMotion<dim>& shape) {
  constexpr double rounding = 1e-12;
  for (double& component : m)
    if (std::abs(component) < rounding) component = 0;
  Tensor<dim> along = m * m.transpose();
  for (int i = 0; i < dim; ++i) shape.held(node, i) = m[i] == 0;
  if (!along.isDiagonal(rounding)) shape.along[node] = along;
}

}  // namespace

template <int dim>
ShapeMotion<dim> gap_motion(const AssemblyParts<dim>& parts) {
  if (parts.interface.normal_rule != NormalRule::conservative)
    throw InputError("wear.normal: expected \"conservative\" with shape.motion = \"gap\"");
  if (parts.shape.constraint != ConstraintForm::eliminated)
    throw InputError("shape.constraint: expected \"eliminated\" with shape.motion = \"gap\"");
  ShapeMotion<dim> shape = parts.shape;
  shape.gap = true;
  shape.held.setOnes();
  shape.along.clear();
  std::set<int> moved;
  for (const Surface<dim>& surface : parts.interface.surfaces) {
    if (!surface.wears) continue;
    const std::vector<ContactPatch<dim>> nodes = nodes_of(parts, surface);
    const std::optional<Vector<dim>> approach = approach_to(parts, surface);
    const bool faces = faces_partner<dim>(nodes, approach);
    for (const ContactPatch<dim>& patch : nodes)
      if (moved.insert(patch.node).second)
        move_along<dim>(patch.node,
                        direction_of<dim>(parts.mesh, patch, parts.shape.free(patch.node),
                                          faces ? Vector<dim>(-*approach) : patch.initial_normal),
                        shape);
  }
  return shape;
}

template <int dim>
bool is_worn_away(const Assembly<dim>& assembly, const NodalField<dim>& d, const Vector<dim>& X) {
  constexpr double beside = 1.5;  // of an oblique side
  return assembly.shape.gap &&
         std::ranges::any_of(assembly.contact_nodes, [&](const ContactPatch<dim>& patch) {
           return (X - patch.initial_position).norm() <= beside * d.row(patch.node).norm();
         });
}

template bool is_worn_away(const Assembly<2>&, const NodalField<2>&, const Vector<2>&);
template bool is_worn_away(const Assembly<3>&, const NodalField<3>&, const Vector<3>&);
template ShapeMotion<2> gap_motion(const AssemblyParts<2>&);
template ShapeMotion<3> gap_motion(const AssemblyParts<3>&);

}  // namespace gnomon
