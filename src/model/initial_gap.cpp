#include "model/initial_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/spectrum.hpp"
#include "model/rigid_balance.hpp"

namespace gnomon {

namespace {

/// The contact node that a counter-body touches first when it comes along its approach, and how far
/// it comes; infinite where it passes by.
struct FirstTouch {
  int node = -1;
  double travel = std::numeric_limits<double>::infinity();
};

template <int dim>
FirstTouch first_touch(const Assembly<dim>& body, const NodalField<dim>& d,
                       const CounterBody<dim>& other) {
  FirstTouch first;
  for (const auto& patch : body.contact_nodes) {
    const double travel = other.travel_to(
        body.mesh.nodes[patch.node] + d.row(patch.node).transpose(), patch.initial_normal);
    if (travel < first.travel) first = {patch.node, travel};
  }
  return first;
}

/// A counter-body that is free in several directions rests where its force goes along the traction
/// n - f s of the node that it touches. From the direction of its force, the approach is turned by
/// what the normal there is off: a shaft comes down in the middle of its bore, or, with friction,
/// where it has rolled to, or near there, where no node is just there. A surface with one normal,
/// or the corner between two, has no such place: the approach is then the force again.
template <int dim>
void approach_rest(const Assembly<dim>& body, const NodalField<dim>& d, CounterBody<dim>& other) {
  constexpr int most_turns = 30;
  constexpr double rounding = 1e-6, near = 0.2;  // of the force
  constexpr double nearer = 0.9;                 // of an approach that is the better one
  // Between normals that follow each other: of nodes, and at first by what friction turns.
  constexpr double corner = 0.3, early_corner = 1.2;
  Tensor<dim> free = Tensor<dim>::Zero();
  int ways = 0;
  for (const Guide<dim>& guide : other.guides)
    if (guide.force && !guide.turns() && !guide.creeps() && ++ways)
      free += guide.along * guide.along.transpose();
  if (ways < 2) return;
  const Tensor<dim> within = free * Tensor<dim>(pseudo_inverse(free));
  const Vector<dim> force = other.approach;
  Vector<dim> best = force;
  double least = near;
  bool at_corner = false;
  std::optional<Vector<dim>> last;  // normal
  for (int k = 0; k < most_turns; ++k) {
    const FirstTouch first = first_touch(body, d, other);
    if (first.node < 0) break;
    const Vector<dim> x = body.mesh.nodes[first.node] + d.row(first.node).transpose();
    const PartnerMotion<> q = other.brought(first.travel);
    const Vector<dim> at = other.seen(x, q), n = other.unchecked_distance(x, q, 0).normal;
    if (!n.allFinite()) break;
    const bool early = k <= most_turns / 2;
    at_corner = at_corner || (last && (n - *last).norm() > (early ? early_corner : corner));
    last = n;
    const Sliding<dim> sliding(body.interface.streaming - other.motion.at(at), n,
                               other.motion.across_at(at));
    const Vector<dim> drag = body.interface.friction * (within * sliding.direction),
                      normal = within * n;
    const Vector<dim> off = force * (normal - drag).norm() + drag - normal;
    if (off.norm() < nearer * least) {
      least = off.norm();
      best = other.approach;
    }
    if (least < rounding) break;
    other.come_along(other.approach + off);
  }
  other.come_along(at_corner ? force : best);
}

/// Moves bodies of pairs that no support holds to where they rest, tells `touching` of it, and
/// moves them so far that a node of the slave is in contact: the mean gap over its share of the
/// surface is larger than that where bodies touch, and closes slowly where the surface is steep.
/// Returns the direction in which they have come, beyond the touch by the indentation.
template <int dim>
NodalField<dim> close_gap_of_pairs(const WornBodyEquations<dim>& equations,
                                   const ComposedSystem<dim>& contact, std::size_t phase,
                                   FieldValues<dim>& values,
                                   const std::function<void()>& touching) {
  constexpr double flattest = 1e-3;  // change of gap by motion
  const Assembly<dim>& body = equations.assembly();
  const RigidBalance<dim> balance(body, equations.phases()[phase].places);
  NodalField<dim>& u = values.vector(equations.fields(phase).u);
  u += balance.displacement;
  touching();
  const auto before = equations.contact_nodes(contact, values, {}, phase);
  const double motion = indentation(body, 1);
  u += motion * balance.direction;
  const auto after = equations.contact_nodes(contact, values, {}, phase);
  double farther = 0;
  for (const MortarPair<dim>& pair : body.pairs) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& facet : pair.slave)
      for (const int node : facet) {
        const auto at = static_cast<std::size_t>(body.contact_node(node));
        const double closed = before[at].gap - after[at].gap;
        if (before[at].area > 0 && after[at].area > 0 && closed > flattest * motion)
          least = std::min(least, before[at].gap / closed * motion);
      }
    if (std::isfinite(least)) farther = std::max(farther, least);
  }
  u += farther * balance.direction;
  return balance.direction;
}

/// Whether a force moves the counter-body along its approach.
template <int dim>
bool comes_freely(const Phase<dim>& phase) {
  const std::vector<std::optional<double>> forces = phase.forces();
  for (std::size_t k = 0; k < forces.size(); ++k)
    if (forces[k] && phase.counter_body.guides[k].share != 0) return true;
  return false;
}

/// Moves body and counter-body together, or apart, until they touch at a point, so that the first
/// matrix is not singular: moves the counter-body if it is free, otherwise the body. A counter-body
/// that passes by in a phase leaves the body as it is. Returns the counter-body with the direction
/// in which it has come.
template <int dim>
CounterBody<dim> close_initial_gap(const WornBodyEquations<dim>& equations, std::size_t phase,
                                   FieldValues<dim>& values) {
  const Assembly<dim>& body = equations.assembly();
  CounterBody<dim> other = equations.phases()[phase].counter_body;
  const bool free = comes_freely(equations.phases()[phase]);
  if (other.is_given() && !free) return other;
  const NodalField<dim>& d = values.vector(equations.fields().d);
  if (free) approach_rest(body, d, other);
  const double least = first_touch(body, d, other).travel;
  // Nothing presses bodies that overlap it at rest but this.
  if (!std::isfinite(least) || (!free && least < 0 && body.loads.empty())) return other;
  if (free) {
    values.scalar(equations.fields(phase).w) = other.brought(least) - other.given(0, 0);
    return other;
  }
  NodalField<dim>& u = values.vector(equations.fields(phase).u);
  for (Eigen::Index node = 0; node < u.rows(); ++node)
    for (int i = 0; i < dim; ++i)
      if (!body.supports.held(node, i)) u(node, i) = -least * other.approach[i];
  return other;
}

}  // namespace

template <int dim>
double indentation(const Assembly<dim>& body, double fraction) {
  return body.scales.displacement * std::cbrt(fraction * fraction);
}

template <int dim>
std::vector<Approach> close_initial_gaps(const WornBodyEquations<dim>& equations,
                                         const ComposedSystem<dim>& contact,
                                         FieldValues<dim>& values,
                                         const std::function<void()>& touching) {
  std::vector<Approach> approaches;
  for (std::size_t p = 0; p < equations.phases().size(); ++p) {
    if (!equations.assembly().pairs.empty()) {
      const NodalField<dim> along = close_gap_of_pairs(equations, contact, p, values, touching);
      const FieldId field = equations.fields(p).u;
      for (Eigen::Index node = 0; node < along.rows(); ++node)
        for (int i = 0; i < dim; ++i)
          if (const int q = contact.numbering().number(field, node, i); q >= 0)
            approaches.push_back({q,
                                  values.vector(field)(node, i) -
                                      along(node, i) * indentation(equations.assembly(), 1),
                                  along(node, i)});
      continue;
    }
    const std::vector<Guide<dim>> guides = close_initial_gap(equations, p, values).guides;
    const FieldId field = equations.fields(p).w;
    for (std::size_t k = 0; field != FieldId::none && k < guides.size(); ++k)
      if (const int q = contact.numbering().number(field, static_cast<Eigen::Index>(k)); q >= 0)
        approaches.push_back({q, values.scalar(field)[k], guides[k].share});
  }
  return approaches;
}

template double indentation(const Assembly<2>&, double);
template double indentation(const Assembly<3>&, double);
template std::vector<Approach> close_initial_gaps(const WornBodyEquations<2>&,
                                                  const ComposedSystem<2>&, FieldValues<2>&,
                                                  const std::function<void()>&);
template std::vector<Approach> close_initial_gaps(const WornBodyEquations<3>&,
                                                  const ComposedSystem<3>&, FieldValues<3>&,
                                                  const std::function<void()>&);

}  // namespace gnomon
