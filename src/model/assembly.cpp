#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/model/assembly.hpp>
#include <map>
#include <set>

#include "mesh/facet_table.hpp"
#include "model/rigid_balance.hpp"
#include "model/tracks.hpp"

namespace gnomon {

namespace {

/// Residuals are relative to the load, displacements to the bodies: if the smallest load of the
/// history hardly strains them, even a state without load would be accepted as an equilibrium.
template <int dim>
void require_strain(const AssemblyParts<dim>& parts) {
  constexpr double strain_at_least = 1e-14;
  double factor = 1, young = parts.bodies.front().material.moduli.young_modulus();
  if (parts.interface.force) factor = parts.interface.history.least(parts.scales.duration);
  for (const Load<dim>& load : parts.loads)
    if (load.presses) factor = std::min(factor, load.history.least(parts.scales.duration));
  for (const Body& body : parts.bodies)
    young = std::min(young, body.material.moduli.young_modulus());
  const double strain = factor * parts.scales.stress / young;
  if (!(strain >= strain_at_least))
    throw InputError(fmt::format(
        "forces and Young's moduli: expected forces that strain the body by {:g} or more, got "
        "about {:.2g}, which is less than rounding errors",
        strain_at_least, strain));
}

/// Stiffnesses along and across an element differ by the square of its aspect ratio: rounding
/// errors of the larger must not exceed the smaller.
template <int dim>
void require_compact_elements(const Mesh<dim>& mesh) {
  constexpr double most = 1e4;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const auto x = mesh.positions(mesh.cells[e]);
    const auto size = (x.colwise().maxCoeff() - x.colwise().minCoeff()).eval();
    if (!(size.maxCoeff() <= most * size.minCoeff()))
      throw InputError(
          fmt::format("the mesh: expected elements at most {:g} times as long as wide, got {:.2g} "
                      "in element {}",
                      most, size.maxCoeff() / size.minCoeff(), e));
  }
}

/// What a program, not a scene, may have mistaken.
template <int dim>
void require_sizes(const AssemblyParts<dim>& parts) {
  const auto nodes = static_cast<Eigen::Index>(parts.mesh.nodes.size());
  const auto require = [](bool fits, const char* what) {
    if (!fits) throw InputError(std::string("an assembly: expected ") + what);
  };
  require(!parts.bodies.empty(), "one body or more");
  require(parts.supports.held.rows() == nodes, "supports.held with a row for every node");
  require(parts.shape.held.rows() == nodes, "shape.held with a row for every node");
  for (const Body& body : parts.bodies)
    require(body.element.section == parts.section(), "bodies of one section");
  for (const Load<dim>& load : parts.loads)
    require(load.forces.rows() == 0 || load.forces.rows() == nodes,
            "forces of loads with a row for every node");
  require(std::ranges::any_of(parts.interface.surfaces,
                              [](const auto& surface) { return !surface.facets.empty(); }),
          "a surface that touches the partner");
}

/// The first of the surfaces that have the node.
template <int dim>
std::vector<int> surfaces_of_nodes(const std::vector<ContactPatch<dim>>& patches,
                                   const Interface<dim>& interface) {
  std::map<int, int> first;
  for (std::size_t s = 0; s < interface.surfaces.size(); ++s)
    for (const auto& facet : interface.surfaces[s].facets)
      for (const int node : facet) first.try_emplace(node, static_cast<int>(s));
  std::vector<int> result;
  for (const ContactPatch<dim>& patch : patches) result.push_back(first.at(patch.node));
  return result;
}

}  // namespace

template <int dim>
NodalField<dim> pull_of(const SpringSupport<dim>& springs, const AssemblyParts<dim>& parts) {
  NodalField<dim> pull =
      NodalField<dim>::Zero(static_cast<Eigen::Index>(parts.mesh.nodes.size()), dim);
  for (const auto& patch : contact_patches<dim>(parts.mesh, springs.facets, {}, parts.section()))
    pull.row(patch.node) +=
        (patch.initial_area * springs.stiffness.cwiseProduct(springs.displacement)).transpose();
  return pull;
}

template <int dim>
NodalField<dim> forces_of(const Load<dim>& load, const AssemblyParts<dim>& parts) {
  NodalField<dim> forces = load.forces;
  if (forces.size() == 0) forces.setZero(static_cast<Eigen::Index>(parts.mesh.nodes.size()), dim);
  for (const auto& patch : contact_patches<dim>(parts.mesh, load.facets, {}, parts.section()))
    forces.row(patch.node) -= load.pressure * patch.initial_area * patch.initial_normal.transpose();
  return forces;
}

template <int dim>
std::vector<typename Mesh<dim>::Facet> facets_of(const std::vector<Surface<dim>>& surfaces) {
  std::vector<typename Mesh<dim>::Facet> facets;
  for (const Surface<dim>& surface : surfaces)
    facets.insert(facets.end(), surface.facets.begin(), surface.facets.end());
  return facets;
}

template <int dim>
std::vector<ContactPatch<dim>> contact_nodes_of(const AssemblyParts<dim>& parts) {
  return contact_patches<dim>(parts.mesh, facets_of(parts.interface.surfaces),
                              parts.interface.boundary, parts.section());
}

template <int dim>
Assembly<dim>::Assembly(AssemblyParts<dim> parts) : AssemblyParts<dim>(std::move(parts)) {
  require_sizes(*this);
  require_strain(*this);
  require_compact_elements(this->mesh);
  body_of = body_of_cells(this->bodies, this->mesh.cells.size());
  contact_nodes = contact_nodes_of(*this);
  surface_of = surfaces_of_nodes(contact_nodes, this->interface);
  for (std::size_t c = 0; c < contact_nodes.size(); ++c) {
    ContactPatch<dim>& patch = contact_nodes[c];
    patch.shape_free =
        wears(static_cast<int>(c)) ? this->shape.free(patch.node) : Tensor<dim>::Zero();
  }
  carries.assign(contact_nodes.size(), this->pairs.empty());
  for (const MortarPair<dim>& pair : this->pairs)
    for (const auto& facet : pair.slave)
      for (const int node : facet) carries[static_cast<std::size_t>(contact_node(node))] = 1;
  if (!this->pairs.empty() && this->near.empty())
    for (const Phase<dim>& phase : this->instants())
      this->near.push_back(RigidBalance<dim>(*this, phase.places).x);
  if (this->condensed) {
    std::vector<int> nodes;
    for (const ContactPatch<dim>& patch : contact_nodes) nodes.push_back(patch.node);
    if (!this->condensation || !this->condensation->keeps(nodes))
      this->condensation = std::make_shared<const Condensation<dim>>(*this, nodes);
  }
  SharedShape<dim> shared = shared_shape(*this, contact_nodes);
  carrier = std::move(shared.carrier);
  shape_direction = std::move(shared.direction);
  wear_weight = std::move(shared.weight);
  track_length = std::move(shared.length);
}

NodalFlags<2> held_on_axis(const Mesh<2>& mesh) {
  NodalFlags<2> held = NodalFlags<2>::Zero(static_cast<Eigen::Index>(mesh.nodes.size()), 2);
  for (const int node : axis_nodes(mesh)) held(node, 0) = 1;
  return held;
}

template <int dim>
double AssemblyParts<dim>::nominal_speed(const Surface<dim>& surface) const {
  std::set<typename Mesh<dim>::Facet> own;
  for (const auto& facet : surface.facets) own.insert(sorted(facet));
  const auto is_own = [&](const auto& facet) { return own.contains(sorted(facet)); };
  for (const MortarPair<dim>& pair : pairs)
    if (std::ranges::any_of(pair.slave, is_own) || std::ranges::any_of(pair.master, is_own))
      return pair.slides * nominal_speed();
  return nominal_speed();
}

template double AssemblyParts<2>::nominal_speed(const Surface<2>&) const;
template double AssemblyParts<3>::nominal_speed(const Surface<3>&) const;
template struct Assembly<2>;
template struct Assembly<3>;
template NodalField<2> forces_of(const Load<2>&, const AssemblyParts<2>&);
template NodalField<2> pull_of(const SpringSupport<2>&, const AssemblyParts<2>&);
template NodalField<3> forces_of(const Load<3>&, const AssemblyParts<3>&);
template NodalField<3> pull_of(const SpringSupport<3>&, const AssemblyParts<3>&);
template std::vector<Mesh<2>::Facet> facets_of(const std::vector<Surface<2>>&);
template std::vector<Mesh<3>::Facet> facets_of(const std::vector<Surface<3>>&);
template std::vector<ContactPatch<2>> contact_nodes_of(const AssemblyParts<2>&);
template std::vector<ContactPatch<3>> contact_nodes_of(const AssemblyParts<3>&);

}  // namespace gnomon
