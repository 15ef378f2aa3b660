#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/shapes/counter_shape.hpp>
#include <limits>

namespace gnomon {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

}  // namespace

template <int dim>
CounterShape<dim>::CounterShape(Function distance, double reach)
    : distance_(std::move(distance)), reach_(reach) {
  if (!distance_) throw RegistrationError("the shape of a counter-body is made without `distance`");
}

template <int dim>
SignedDistance<dim> CounterShape<dim>::at(const Vector<dim>& x) const {
  SignedDistance<dim> result = distance_(x);
  if (!std::isfinite(result.gap) || !result.normal.allFinite() || !result.normal_by_x.allFinite())
    throw RecoverableError("a contact node lies where the counter-body has no normal");
  if (!result.unique && result.gap < 0)
    throw RecoverableError(
        "a contact node lies inside the counter-body where several points of its surface are "
        "equally near");
  return result;
}

/// From afar, or from within a cavity: in the one nearest to where x is, the point with the most
/// room.
template <int dim>
double CounterShape<dim>::start(const Vector<dim>& x, const Vector<dim>& approach) const {
  constexpr int most_doublings = 30, samples = 256;  // farther away sides are rounding errors
  const double size = reach_ + x.norm();
  const auto gap = [&](double w) { return distance_(x - w * approach).gap; };
  double w = -2 * size;
  for (int k = 0; k <= most_doublings; ++k, w *= 2)
    if (gap(w) > 0) return w;
  const auto sample = [size](int k) { return 2 * size * k / samples; };
  int inside = 0;
  while (inside <= samples && !(gap(sample(-inside)) > 0) && !(gap(sample(inside)) > 0)) ++inside;
  if (inside > samples) return never;
  if (gap(sample(-inside)) > 0) inside = -inside;
  double best = sample(inside);
  for (int step : {-1, 1})
    for (int k = inside; std::abs(k) <= samples && gap(sample(k)) > 0; k += step)
      if (gap(sample(k)) > gap(best)) best = sample(k);
  return best;
}

/// Along the ray by which x comes near, as seen from the shape, the distance says how far one may
/// go without touching (sphere tracing). Where little is left Newton's method ends it, without
/// which a grazing approach would take long.
template <int dim>
double CounterShape<dim>::travel_to(const Vector<dim>& x, const Vector<dim>& approach) const {
  constexpr int most_steps = 100'000, most_refinements = 60;
  const double size = reach_ + x.norm();
  const double near = 1e-6 * size, rounding = 1e-15 * size;
  const auto seen = [&](double w) -> Vector<dim> { return x - w * approach; };
  if (size == 0)  // the origin, through which the plane goes
    return distance_(x).normal.dot(approach) > 0 ? 0 : never;

  double w = start(x, approach);
  if (w == never) return never;
  SignedDistance<dim> there = distance_(seen(w));
  for (int k = 0; there.gap > near; ++k) {
    const bool leaves = there.normal.dot(approach) <= 0 && seen(w).norm() > reach_ && w > 0;
    if (leaves || k == most_steps) return never;
    w += there.gap;
    there = distance_(seen(w));
  }
  double outside = w;
  for (int k = 0; k < most_refinements && std::abs(there.gap) > rounding; ++k) {
    const double slope = there.normal.dot(approach);
    if (there.gap > 0) outside = w;
    if (there.gap > 0 && slope <= 0) return never;
    const double next = slope > 0 ? w + there.gap / slope : (outside + w) / 2;
    if (next == w) break;
    w = next;
    there = distance_(seen(w));
  }
  if (!(std::abs(there.gap) <= 1e-3 * near)) return never;
  // One more step, so that on a plane only the last digit of w is uncertain.
  const double slope = there.normal.dot(approach);
  return slope > 0 ? w + there.gap / slope : w;
}

template <int dim>
CounterShape<dim> complement(const CounterShape<dim>& shape) {
  return {
      [shape](const Vector<dim>& x) {
        const SignedDistance<dim> inside = shape.unchecked(x);
        return SignedDistance<dim>{-inside.gap, -inside.normal, -inside.normal_by_x, inside.unique};
      },
      shape.reach()};
}

template <int dim>
void visit_surface(const CounterShape<dim>& shape, const Vector<dim>& centre,
                   const std::function<void(const Vector<dim>& x, const Vector<dim>& n)>& visit) {
  constexpr int samples = 200;
  const double extent = shape.reach() + centre.norm(), size = extent > 0 ? extent : 1;
  for (int k = 1; k <= samples; ++k) {
    Vector<dim> x;
    for (int i = 0; i < dim; ++i) {  // a Kronecker sequence: spread evenly
      const double step = std::sqrt(double(i == 0 ? 2 : i == 1 ? 3 : 5));
      x[i] = 1.5 * size * (2 * (k * step - std::floor(k * step)) - 1);
    }
    const SignedDistance<dim> from = shape.unchecked(x);
    const Vector<dim> on_surface = x - from.gap * from.normal;
    if (from.unique && on_surface.allFinite()) visit(on_surface, from.normal);
  }
}

template <int dim>
bool turns_into_itself(const CounterShape<dim>& shape, const Tensor<dim>& spin,
                       const Vector<dim>& centre) {
  constexpr double rounding = 1e-9;
  const double extent = shape.reach() + centre.norm(), size = extent > 0 ? extent : 1;
  bool moves_along_itself = true;
  visit_surface<dim>(shape, centre, [&](const Vector<dim>& x, const Vector<dim>& n) {
    if (std::abs(n.dot(spin * (x - centre))) > rounding * spin.norm() * size)
      moves_along_itself = false;
  });
  return moves_along_itself;
}

template class CounterShape<2>;
template class CounterShape<3>;
template CounterShape<2> complement(const CounterShape<2>&);
template CounterShape<3> complement(const CounterShape<3>&);
template bool turns_into_itself(const CounterShape<2>&, const Tensor<2>&, const Vector<2>&);
template bool turns_into_itself(const CounterShape<3>&, const Tensor<3>&, const Vector<3>&);

template void visit_surface(const CounterShape<2>&, const Vector<2>&,
                            const std::function<void(const Vector<2>&, const Vector<2>&)>&);
template void visit_surface(const CounterShape<3>&, const Vector<3>&,
                            const std::function<void(const Vector<3>&, const Vector<3>&)>&);

}  // namespace gnomon
