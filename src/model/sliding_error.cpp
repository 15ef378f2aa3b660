#include "model/sliding_error.hpp"

#include <array>
#include <cmath>
#include <set>
#include <type_traits>

#include "mesh/facet_table.hpp"

namespace gnomon {

namespace {

/// Means over one side of a pair in a phase, by the contact forces.
template <int dim>
struct MeanOfSide {
  double force = 0;
  Vector<dim> x = Vector<dim>::Zero(), moved = Vector<dim>::Zero();  // in space
  std::vector<std::pair<double, Vector<dim>>> forces;                // of nodes, and where

  /// `motion`: of the nodes in the frame of the body, u or its rate.
  MeanOfSide(const Assembly<dim>& assembly, const std::set<int>& nodes, const BodyPlace<dim>& place,
             const NodalField<dim>& d, const NodalField<dim>& u, const NodalField<dim>& motion,
             const std::vector<ContactNode<dim>>& contact) {
    for (const int node : nodes) {
      const ContactNode<dim>& at = contact[static_cast<std::size_t>(assembly.contact_node(node))];
      const double part = at.area * std::max(0.0, -at.traction);
      const Vector<dim> own = u.row(node).transpose();
      force += part;
      moved += part * (place.turn * motion.row(node).transpose());
      forces.emplace_back(part, place.of(assembly.mesh.nodes[static_cast<std::size_t>(node)] +
                                         d.row(node).transpose() + own));
      x += part * forces.back().second;
    }
    if (force > 0) moved /= force, x /= force;
  }
};

}  // namespace

template <int dim>
std::optional<MovedAxis> find_moved_axis(const WornBodyEquations<dim>& equations,
                                         const FieldValues<dim>& values,
                                         const std::vector<PhaseContact<dim>>& contacts) {
  const Assembly<dim>& assembly = equations.assembly();
  if (assembly.interface.rolling) return {};
  std::optional<MovedAxis> most;
  for (const MortarPair<dim>& pair : assembly.pairs)
    for (const int side : {0, 1}) {
      const std::set<int> nodes = nodes_of_facets(side == 0 ? pair.slave : pair.master);
      double fast = 0, sliding = 0, way = 0;
      for (std::size_t p = 0; p < contacts.size(); ++p) {
        const Phase<dim>& phase = equations.phases()[p];
        const PairPlaces<dim> places(pair, phase.places);
        const Tensor<dim> spin = phase.places.empty()
                                     ? pair.spins[static_cast<std::size_t>(side)]
                                     : places.of[static_cast<std::size_t>(side)].motion.spin;
        const NodalField<dim>& u = values.vector(equations.fields(p).u);
        const MeanOfSide<dim> mean(assembly, nodes, places.of[static_cast<std::size_t>(side)],
                                   values.vector(equations.fields(p).d), u, u, contacts[p].nodes);
        const Vector<dim> v = places.motion.at(mean.x), wrong = spin * mean.moved;
        const double weight = contacts[p].weight * mean.force;
        const double across = places.motion.across_at(mean.x);
        const double speed = std::hypot(v.norm(), across);
        // The first body's velocity is subtracted.
        const Vector<dim> right = v - (side == 0 ? -1.0 : 1.0) * wrong;
        // Of a whole ring the mean place is the centre, where nothing slides.
        for (const auto& [force, x] : mean.forces)
          sliding += contacts[p].weight * force *
                     std::hypot(places.motion.at(x).norm(), places.motion.across_at(x));
        fast += weight * (speed - std::hypot(right.norm(), across));
        if (!spin.isZero(0)) way = std::max(way, mean.moved.norm());
      }
      if (way == 0 || sliding == 0) continue;
      if (const double part = fast / sliding; !most || std::abs(part) > std::abs(most->part))
        most = MovedAxis{
            assembly.bodies[static_cast<std::size_t>(pair.numbers[static_cast<std::size_t>(side)])]
                .name,
            way, part};
    }
  return most;
}

namespace {

/// The change with time in a phase of a field of each, by those before and after it.
template <int dim, class FieldOf>
auto rate_in_phase(const WornBodyEquations<dim>& equations, const FieldOf& field, std::size_t p) {
  const std::vector<Phase<dim>>& phases = equations.phases();
  const std::size_t count = phases.size(), before = (p + count - 1) % count,
                    after = (p + 1) % count;
  double part = phases[after].position - phases[before].position;
  if (part <= 0) part += 1;
  const double time = part * equations.assembly().cycle->motion.cycle.period;
  using Field = std::decay_t<decltype(field(equations.fields(p)))>;
  return Field((field(equations.fields(after)) - field(equations.fields(before))) / time);
}

template <int dim>
NodalField<dim> rate_of_displacement(const WornBodyEquations<dim>& equations,
                                     const FieldValues<dim>& values, std::size_t p) {
  return rate_in_phase(
      equations,
      [&](const WornBodyFields& fields) -> NodalField<dim> { return values.vector(fields.u); }, p);
}

/// Without the part along the mean normal of the contact, by its forces.
template <int dim>
Vector<dim> tangential(const Vector<dim>& v, const Assembly<dim>& assembly,
                       const MortarPair<dim>& pair, const BodyPlace<dim>& slave,
                       const std::vector<ContactNode<dim>>& contact) {
  Vector<dim> normal = Vector<dim>::Zero();
  for (const int node : nodes_of_facets(pair.slave)) {
    const ContactNode<dim>& at = contact[static_cast<std::size_t>(assembly.contact_node(node))];
    normal += at.area * std::max(0.0, -at.traction) * at.normal;
  }
  normal = (slave.turn * normal).normalized();
  return v - v.dot(normal) * normal;
}

/// How fast the free guides of the counter-body move it in a phase, but for turns.
template <int dim>
Vector<dim> following(const WornBodyEquations<dim>& equations, const FieldValues<dim>& values,
                      std::size_t p) {
  Vector<dim> velocity = Vector<dim>::Zero();
  if (equations.fields(p).w == FieldId::none) return velocity;
  const Eigen::VectorXd rate = rate_in_phase(
      equations,
      [&](const WornBodyFields& fields) -> Eigen::VectorXd { return values.scalar(fields.w); }, p);
  const std::vector<Guide<dim>>& guides = equations.phases()[p].counter_body.guides;
  for (std::size_t k = 0; k < guides.size(); ++k)
    velocity += guides[k].travelled(rate[static_cast<Eigen::Index>(k)]);
  return velocity;
}

/// Of a counter-body, or a body, that follows the other one on inclined contact.
template <int dim>
std::optional<UnseenSliding> unseen_beside_partner(const WornBodyEquations<dim>& equations,
                                                   const FieldValues<dim>& values,
                                                   const std::vector<PhaseContact<dim>>& contacts) {
  const Assembly<dim>& assembly = equations.assembly();
  double unseen = 0, sliding = 0;
  for (std::size_t p = 0; p < contacts.size(); ++p) {
    const RigidMotion<dim>& motion = equations.phases()[p].counter_body.motion;
    const Vector<dim> follows = following(equations, values, p);
    const NodalField<dim> rate = rate_of_displacement(equations, values, p);
    const NodalField<dim>&d = values.vector(equations.fields(p).d),
          &u = values.vector(equations.fields(p).u);
    for (std::size_t c = 0; c < contacts[p].nodes.size(); ++c) {
      const ContactNode<dim>& node = contacts[p].nodes[c];
      const int at = assembly.contact_nodes[c].node;
      const double force = contacts[p].weight * node.area * std::max(0.0, -node.traction);
      if (!(force > 0)) continue;
      const Vector<dim> x = assembly.mesh.nodes[static_cast<std::size_t>(at)] +
                            Vector<dim>(d.row(at) + u.row(at)),
                        along = motion.at(x), v = along - along.dot(node.normal) * node.normal,
                        missing = follows - Vector<dim>(rate.row(at));
      const double speed = std::hypot(v.norm(), motion.across_at(x));
      sliding += force * speed;
      if (speed > 0) unseen += force * std::abs(missing.dot(v)) / speed;
    }
  }
  if (!(sliding > 0)) return {};
  return UnseenSliding{.body = {}, .part = unseen / sliding};
}

}  // namespace

template <int dim>
std::optional<UnseenSliding> find_unseen_sliding(const WornBodyEquations<dim>& equations,
                                                 const FieldValues<dim>& values,
                                                 const std::vector<PhaseContact<dim>>& contacts) {
  constexpr std::size_t least_phases = 4;
  const Assembly<dim>& assembly = equations.assembly();
  if (!assembly.cycle || assembly.interface.sticks || contacts.size() < least_phases) return {};
  if (assembly.pairs.empty()) return unseen_beside_partner(equations, values, contacts);
  std::optional<UnseenSliding> most;
  for (const MortarPair<dim>& pair : assembly.pairs) {
    double unseen = 0, sliding = 0;
    std::array<double, 2> own{};  // of each side
    for (std::size_t p = 0; p < contacts.size(); ++p) {
      const PairPlaces<dim> places(pair, equations.phases()[p].places);
      const NodalField<dim> rate = rate_of_displacement(equations, values, p);
      const auto mean_of = [&](std::size_t side) {
        return MeanOfSide<dim>(assembly, nodes_of_facets(side == 0 ? pair.slave : pair.master),
                               places.of[side], values.vector(equations.fields(p).d),
                               values.vector(equations.fields(p).u), rate, contacts[p].nodes);
      };
      const MeanOfSide<dim> slave = mean_of(0), master = mean_of(1);
      const Vector<dim> v = tangential<dim>(places.motion.at(slave.x), assembly, pair, places.of[0],
                                            contacts[p].nodes);
      const double weight = contacts[p].weight * slave.force,
                   speed = std::hypot(v.norm(), places.motion.across_at(slave.x));
      if (!(speed > 0)) continue;
      sliding += weight * speed;
      unseen += weight * std::abs((master.moved - slave.moved).dot(v)) / speed;
      own[0] += weight * std::abs(slave.moved.dot(v)) / speed;
      own[1] += weight * std::abs(master.moved.dot(v)) / speed;
    }
    const std::size_t side = own[1] > own[0];
    if (const double part = sliding > 0 ? unseen / sliding : 0; !most || part > most->part)
      most =
          UnseenSliding{assembly.bodies[static_cast<std::size_t>(pair.numbers[side])].name, part};
  }
  return most;
}

template std::optional<UnseenSliding> find_unseen_sliding(const WornBodyEquations<2>&,
                                                          const FieldValues<2>&,
                                                          const std::vector<PhaseContact<2>>&);
template std::optional<UnseenSliding> find_unseen_sliding(const WornBodyEquations<3>&,
                                                          const FieldValues<3>&,
                                                          const std::vector<PhaseContact<3>>&);
template std::optional<MovedAxis> find_moved_axis(const WornBodyEquations<2>&,
                                                  const FieldValues<2>&,
                                                  const std::vector<PhaseContact<2>>&);
template std::optional<MovedAxis> find_moved_axis(const WornBodyEquations<3>&,
                                                  const FieldValues<3>&,
                                                  const std::vector<PhaseContact<3>>&);

}  // namespace gnomon
