#include <cmath>
#include <gnomon/shapes/counter_body.hpp>

#include "base/spectrum.hpp"

namespace gnomon {

Tensor<2> spin_in_plane(double rate) {
  return Tensor<2>{{0, -rate}, {rate, 0}};
}

Tensor<3> spin_about(const Vector<3>& axis, double rate) {
  const Vector<3> a = rate * axis.normalized();
  return Tensor<3>{{0, -a[2], a[1]}, {a[2], 0, -a[0]}, {-a[1], a[0], 0}};
}

/// By Rodrigues' formula: with a = |spin| / sqrt 2, W = spin / a and the angle phi = a (start +
/// rate t), 1 + sin(phi) W + (1 - cos(phi)) W^2.
template <int dim>
Tensor<dim> Turning<dim>::rotation(double t) const {
  const double a = spin.norm() / std::sqrt(2.0);
  if (a == 0) return Tensor<dim>::Identity();
  const Tensor<dim> W = spin / a;
  const double angle = a * (start + rate * t), half = std::sin(angle / 2);
  return Tensor<dim>::Identity() + std::sin(angle) * W + 2 * half * half * W * W;
}

namespace {

template <int dim>
using Turned = std::optional<std::pair<Tensor<dim>, Vector<dim>>>;

/// The signed distance of a shape that has turned, by that of the shape at rest.
template <int dim, class Rest>
SignedDistance<dim> turned(const Turned<dim>& place, const Vector<dim>& seen, const Rest& at_rest) {
  if (!place) return at_rest(seen);
  const auto& [R, centre] = *place;
  SignedDistance<dim> at = at_rest(Vector<dim>(centre + R.transpose() * (seen - centre)));
  at.normal = R * at.normal;
  at.normal_by_x = R * at.normal_by_x * R.transpose();
  return at;
}

}  // namespace

/// How the shape has turned: rotation and centre.
template <int dim>
Turned<dim> CounterBody<dim>::place(const PartnerMotion<>& q, double t) const {
  if (turning) return {{turning->rotation(t), turning->centre}};
  for (Eigen::Index k = 0; k < q.size(); ++k)
    if (const Guide<dim>& guide = guides[k]; guide.turns())
      return {{Turning<dim>{guide.turn, guide.centre}.rotation(q[k]), guide.centre}};
  return {};
}

template <int dim>
Vector<dim> CounterBody<dim>::seen(const Vector<dim>& x, const PartnerMotion<>& q) const {
  Vector<dim> result = x - position;
  for (Eigen::Index k = 0; k < q.size(); ++k) result -= guides[k].travelled(q[k]);
  return result;
}

template <int dim>
PartnerMotion<> CounterBody<dim>::given(double t, double within) const {
  PartnerMotion<> q(guides.size());
  for (Eigen::Index k = 0; k < q.size(); ++k)
    q[k] = guides[k].travel ? guides[k].travel->factor(t, within) : 0;
  return q;
}

template <int dim>
void CounterBody<dim>::come_along(const Vector<dim>& direction) {
  const bool free = std::ranges::any_of(guides, [](const Guide<dim>& guide) {
    return guide.force && !guide.turns() && !guide.creeps();
  });
  std::vector<Guide<dim>*> moving;
  for (Guide<dim>& guide : guides)
    if (!guide.turns() && !guide.creeps() &&
        (free ? guide.force.has_value() : guide.travel.has_value()))
      moving.push_back(&guide);
  // The shares of least sum of squares.
  Tensor<dim> reached = Tensor<dim>::Zero();
  for (const Guide<dim>* guide : moving) reached += guide->along * guide->along.transpose();
  const Vector<dim> pull = Tensor<dim>(pseudo_inverse(reached)) * direction;
  const Vector<dim> part = reached * pull;
  if (!(part.norm() > 1e-9 * direction.norm())) return;
  approach = part.normalized();
  for (Guide<dim>* guide : moving) guide->share = guide->along.dot(pull) / part.norm();
}

/// What is given elsewhere than along `approach` has its place at t = 0.
template <int dim>
PartnerMotion<> CounterBody<dim>::brought(double w) const {
  PartnerMotion<> q = given(0, 0);
  for (Eigen::Index k = 0; k < q.size(); ++k)
    if (guides[k].share != 0) q[k] = guides[k].share * w;
  return q;
}

template <int dim>
SignedDistance<dim> CounterBody<dim>::unchecked_distance(const Vector<dim>& seen, double t) const {
  return turned<dim>(place({}, t), seen, [this](const auto& x) { return shape.unchecked(x); });
}

template <int dim>
SignedDistance<dim> CounterBody<dim>::unchecked_distance(const Vector<dim>& x,
                                                         const PartnerMotion<>& q, double t) const {
  return turned<dim>(place(q, t), seen(x, q),
                     [this](const auto& at) { return shape.unchecked(at); });
}

/// With r from the centre of a turn W, which carries a point along by G = W r: at a fixed node the
/// normal n(q) = R n(R'r) changes by (W n - H W r) dq.
template <int dim>
Partner<dim> CounterBody<dim>::meet(const Vector<dim>& x, const PartnerMotion<>& q,
                                    double t) const {
  const Vector<dim> at = seen(x, q);
  const SignedDistance<dim> distance =
      turned<dim>(place(q, t), at, [this](const auto& y) { return shape.at(y); });
  const Vector<dim>& n = distance.normal;
  const Tensor<dim>& H = distance.normal_by_x;
  const Eigen::Index count = q.size();
  Partner<dim> partner{.gap = distance.gap,
                       .normal = n,
                       .unique = distance.unique,
                       .velocity = motion.at(at),
                       .across = motion.across_at(at)};
  partner.weights.resize(dim, count);
  partner.gap_by.resize(dim + count);
  partner.across_by.setZero(dim + count);
  partner.normal_by.resize(dim, dim + count);
  partner.velocity_by.setZero(dim, dim + count);
  partner.gap_by.template head<dim>() = n.transpose();
  partner.across_by.template head<dim>() = motion.across_by_x.transpose();
  partner.normal_by.template leftCols<dim>() = H;
  partner.velocity_by.template leftCols<dim>() = motion.spin;
  for (Eigen::Index k = 0; k < count; ++k) {
    const Guide<dim>& guide = guides[k];
    const Tensor<dim> turn = guide.turns() ? guide.turn : Tensor<dim>::Zero();
    const Vector<dim> G = turn * (at - guide.centre) + guide.travelled(1);
    partner.weights.col(k) = G;
    partner.gap_by[dim + k] = -n.dot(G);
    partner.normal_by.col(dim + k) = turn * n - H * G;
    partner.velocity_by.col(dim + k) = -motion.spin * guide.travelled(1);
    partner.across_by[dim + k] = -motion.across_by_x.dot(guide.travelled(1));
    if (!guide.turns()) continue;
    auto& weight_by = partner.weights_by[k];
    weight_by.resize(dim, dim + count);
    weight_by.template leftCols<dim>() = guide.turn;
    for (Eigen::Index l = 0; l < count; ++l)
      weight_by.col(dim + l) = -guide.turn * guides[l].travelled(1);
  }
  return partner;
}

template <int dim>
double CounterBody<dim>::travel_to(const Vector<dim>& x) const {
  const Vector<dim> at = seen(x, brought(0));
  const Turned<dim> turn = place({}, 0);
  if (!turn) return shape.travel_to(at, approach);
  const Tensor<dim> back = turn->first.transpose();
  return shape.travel_to(turn->second + back * (at - turn->second), back * approach);
}

template struct Turning<2>;
template struct Turning<3>;
template struct CounterBody<2>;
template struct CounterBody<3>;

}  // namespace gnomon
