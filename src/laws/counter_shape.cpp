#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/laws/counter_shape.hpp>
#include <limits>

namespace gnomon {

template <int dim>
SignedDistance<dim> CounterShape<dim>::at(const Vector<dim>& x) const {
  SignedDistance<dim> result = distance_(x);
  if (!std::isfinite(result.gap) || !result.normal.allFinite() || !result.normal_by_x.allFinite())
    throw RecoverableError("a contact node is at a point where the counter-body has no normal");
  return result;
}

/// On the ray along which x approaches in the coordinates of the shape, the distance says how far x
/// may move without touching (sphere tracing). When the distance is small, Newton's method finishes
/// the search; without it a grazing approach would need many steps.
template <int dim>
double CounterShape<dim>::travel_to(const Vector<dim>& x, const Vector<dim>& approach) const {
  constexpr double never = std::numeric_limits<double>::infinity();
  constexpr int most_steps = 100'000, most_doublings = 60, most_refinements = 60;
  const double size = reach_ + x.norm();
  const double near = 1e-6 * size, rounding = 1e-15 * size;
  const auto seen = [&](double w) -> Vector<dim> { return x - w * approach; };
  if (size == 0) return 0;  // the origin, through which the plane goes

  double w = -2 * size;
  SignedDistance<dim> there = distance_(seen(w));
  for (int k = 0; !(there.gap > 0); ++k) {
    if (k == most_doublings) return never;  // no part of the ray is outside
    w *= 2;
    there = distance_(seen(w));
  }
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

template class CounterShape<2>;
template class CounterShape<3>;
}  // namespace gnomon
