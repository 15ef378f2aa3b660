#include "model/observed_rolling.hpp"

#include <fmt/format.h>

#include "model/upstream.hpp"

namespace gnomon {

namespace {

template <int dim>
Vector<dim> friction_on(const ContactNode<dim>& node) {
  return node.force - node.area * node.traction * node.normal;
}

}  // namespace

/// Material brings and takes as much elastic energy, so that contact forces have no power on it as
/// it strains; so it is with differences by the nodes on both sides, not with those upwind.
template <int dim>
PowerOfRolling power_of_rolling(const Assembly<dim>& assembly, const NodalField<dim>& moved,
                                const std::vector<ContactNode<dim>>& nodes) {
  PowerOfRolling power;
  const double speed = assembly.interface.rolling->velocity.norm();
  double force = 0, rubbing = 0;
  for (std::size_t c = 0; c < nodes.size(); ++c)
    if (assembly.carries[c]) force -= nodes[c].area * nodes[c].traction;
  for (const Upstream& at : upstream_of(assembly)) {
    const ContactNode<dim>& node = nodes[static_cast<std::size_t>(assembly.contact_node(at.node))];
    const Vector<dim> friction = friction_on(node);
    power.dissipated += assembly.copies * speed / at.distance * friction.dot(node.slip);
    for (const auto& [of, factor] : at.upwind)
      power.upwind += assembly.copies * speed * factor * friction.dot(moved.row(of).transpose());
    rubbing -= node.area * node.traction;
    if (node.active && node.sticks) power.stick_area += assembly.copies * node.area;
  }
  power.without_friction = force > 0 ? 1 - rubbing / force : 0;
  return power;
}

template <int dim>
double driving_power(const Assembly<dim>& assembly, const std::vector<ContactNode<dim>>& nodes,
                     const Rolling<dim>& rolling) {
  double power = 0;
  for (const Upstream& at : upstream_of(assembly)) {
    const Vector<dim>& X = assembly.mesh.nodes[static_cast<std::size_t>(at.node)];
    const ContactNode<dim>& node = nodes[static_cast<std::size_t>(assembly.contact_node(at.node))];
    power += friction_on(node).dot(rolling.creepage_at(X));
  }
  return assembly.copies * rolling.velocity.norm() * power;
}

template <int dim>
void observe_rolling(const Assembly<dim>& assembly, const NodalField<dim>& moved,
                     const std::vector<ContactNode<dim>>& nodes, const Rolling<dim>& rolling,
                     int units, Observation& observed) {
  for (int i = 0; i < dim; ++i)
    observed.push_back({fmt::format("creepage_{}", "xyz"[i]), "", rolling.creepage[i]});
  if (!rolling.turn.isZero(0))
    observed.push_back({"creepage_spin", "1/mm", rolling.spin_about_turn()});
  const PowerOfRolling power = power_of_rolling(assembly, moved, nodes);
  observed.push_back(common("friction_power", power.dissipated, units));
  observed.push_back(common("stick_area", power.stick_area, units));
}

template PowerOfRolling power_of_rolling(const Assembly<2>&, const NodalField<2>&,
                                         const std::vector<ContactNode<2>>&);
template PowerOfRolling power_of_rolling(const Assembly<3>&, const NodalField<3>&,
                                         const std::vector<ContactNode<3>>&);
template double driving_power(const Assembly<2>&, const std::vector<ContactNode<2>>&,
                              const Rolling<2>&);
template double driving_power(const Assembly<3>&, const std::vector<ContactNode<3>>&,
                              const Rolling<3>&);
template void observe_rolling(const Assembly<2>&, const NodalField<2>&,
                              const std::vector<ContactNode<2>>&, const Rolling<2>&, int,
                              Observation&);
template void observe_rolling(const Assembly<3>&, const NodalField<3>&,
                              const std::vector<ContactNode<3>>&, const Rolling<3>&, int,
                              Observation&);

}  // namespace gnomon
