#include "model/limit_of_friction.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "model/upstream.hpp"

namespace gnomon {

namespace {

/// A given moment about the normal.
template <int dim>
struct Moment {
  double value = 0;  ///< [force length]
  Tensor<dim> turn = Tensor<dim>::Zero();
  Vector<dim> centre = Vector<dim>::Zero();
};

template <int dim>
Moment<dim> moment_of(const Assembly<dim>& assembly) {
  const Rolling<dim>& rolling = *assembly.interface.rolling;
  if (rolling.moment) return {*rolling.moment, rolling.turn, rolling.centre};
  const CounterBody<dim>& partner = assembly.interface.partner;
  for (const Guide<dim>& guide : partner.guides)
    if (guide.spins())
      return {*guide.force * guide.factors.factor(0), guide.turn, partner.position + guide.centre};
  return {};
}

/// Of all nodes that have friction.
template <int dim>
struct Friction {
  Vector<dim> sum = Vector<dim>::Zero();  ///< [force]
  double most = 0;                        ///< f P, without regard to directions [force]
  double moment = 0, most_moment = 0;     ///< the same about the axis of a moment [force length]
  bool sticks = false;                    ///< somewhere
};

template <int dim>
Friction<dim> friction_of(const Assembly<dim>& assembly,
                          const std::vector<ContactNode<dim>>& nodes) {
  Friction<dim> friction;
  const Moment<dim> about = moment_of(assembly);
  for (const Upstream& at : upstream_of(assembly)) {
    const ContactNode<dim>& node = nodes[static_cast<std::size_t>(assembly.contact_node(at.node))];
    if (!node.active) continue;
    const Vector<dim> own =
                          assembly.copies * (node.force - node.area * node.traction * node.normal),
                      way = about.turn * (assembly.mesh.nodes[at.node] - about.centre);
    const double most = -assembly.copies * node.friction * node.area * node.traction;
    friction.sum += own;
    friction.most += most;
    friction.moment += own.dot(way);
    friction.most_moment += most * way.norm();
    friction.sticks = friction.sticks || node.sticks;
  }
  return friction;
}

/// Whether a creepage is found by forces, and none is given: beside a given one all may slip, and
/// forces still turn the direction of slip.
template <int dim>
bool creeps_by_forces(const Assembly<dim>& assembly) {
  const Rolling<dim>& rolling = *assembly.interface.rolling;
  const auto& guides = assembly.interface.partner.guides;
  return (rolling.creeps() || std::ranges::any_of(guides, &Guide<dim>::creeps)) &&
         rolling.creepage.isZero(0) && rolling.spin.isZero(0);
}

}  // namespace

template <int dim>
std::optional<Limit> limit_of_friction(const Assembly<dim>& assembly,
                                       const std::vector<ContactNode<dim>>& nodes) {
  constexpr double nearly = 1 - 1e-3;
  if (!creeps_by_forces(assembly)) return {};
  const Friction<dim> friction = friction_of(assembly, nodes);
  const double along = friction.sum.norm(), moment = std::abs(friction.moment);
  if (moment > nearly * friction.most_moment)
    return Limit{fmt::format("the moment about the normal, {:.4g}, reaches what friction holds, "
                             "{:.4g}",
                             moment, friction.most_moment),
                 !friction.sticks};
  if (along == 0 || along < nearly * friction.most) return {};
  return Limit{fmt::format("the force along the surface, {:.4g}, reaches what friction holds, f P "
                           "= {:.4g}",
                           along, friction.most),
               !friction.sticks};
}

template <int dim>
std::string excess_at_start(const Assembly<dim>& assembly,
                            const std::vector<ContactNode<dim>>& nodes) {
  Vector<dim> sum = Vector<dim>::Zero();
  for (int i = 0; i < dim; ++i) sum[i] = assembly.interface.rolling->force[i].value_or(0);
  for (const Guide<dim>& guide : assembly.interface.partner.guides)
    if (guide.creeps() && guide.force) sum += *guide.force * guide.factors.factor(0) * guide.along;
  const Friction<dim> friction = friction_of(assembly, nodes);
  const double along = sum.norm(), moment = std::abs(moment_of(assembly).value);
  if (moment > friction.most_moment)
    return fmt::format("a moment of {:.4g} is more than friction holds about its axis, {:.4g}",
                       moment, friction.most_moment);
  if (along <= friction.most) return "";
  return fmt::format("{:.4g} is more than friction holds, f P = {:.4g}", along, friction.most);
}

template std::optional<Limit> limit_of_friction(const Assembly<2>&,
                                                const std::vector<ContactNode<2>>&);
template std::optional<Limit> limit_of_friction(const Assembly<3>&,
                                                const std::vector<ContactNode<3>>&);
template std::string excess_at_start(const Assembly<2>&, const std::vector<ContactNode<2>>&);
template std::string excess_at_start(const Assembly<3>&, const std::vector<ContactNode<3>>&);

}  // namespace gnomon
