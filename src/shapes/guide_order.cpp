#include "shapes/guide_order.hpp"

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <tuple>

namespace gnomon {

namespace {

template <int dim>
using Normals = std::vector<Vector<dim>>;

/// Unit; zero of a closed surface, or of none.
template <int dim>
Vector<dim> mean_of(const Normals<dim>& normals) {
  constexpr double rounding = 1e-9;
  Vector<dim> sum = Vector<dim>::Zero();
  double whole = 0;
  for (const Vector<dim>& normal : normals) sum += normal, whole += normal.norm();
  return sum.norm() <= rounding * whole ? Vector<dim>(Vector<dim>::Zero()) : sum.normalized();
}

/// In the mean: a curved surface also faces what pushes along it.
template <int dim>
bool lies_along(const Vector<dim>& outward, const Guide<dim>& guide) {
  constexpr double grazing = 0.1;
  return !outward.isZero(0) && (guide.turns() || std::abs(outward.dot(guide.along)) < grazing);
}

/// A force along it presses little on a side that it faces obliquely.
template <int dim>
bool is_oblique(const Vector<dim>& outward, const Guide<dim>& guide) {
  constexpr double facing = 0.5;
  return guide.force && !outward.isZero(0) && !guide.turns() && -outward.dot(guide.along) < facing;
}

template <int dim>
bool meets_none(const Normals<dim>& normals, const Guide<dim>& guide) {
  constexpr double rounding = 1e-9;
  return guide.turns() || std::ranges::all_of(normals, [&](const Vector<dim>& normal) {
           return std::abs(normal.dot(guide.along)) <= rounding * normal.norm();
         });
}

/// Forces first, of them those that press straight on the surface before oblique ones, and those
/// that swing after others, then what is given, then what no force holds back, then what is held;
/// before all that lies along the surface.
template <int dim>
void sort(const Scene& scene, const Vector<dim>& outward, std::vector<Guide<dim>>& guides) {
  const auto rank = [&](const Guide<dim>& guide) {
    return std::tuple(lies_along(outward, guide),
                      guide.turns()        ? 1
                      : guide.force == 0.0 ? 3
                      : guide.force        ? 0
                      : guide.travel       ? 2
                                           : 4,
                      is_oblique(outward, guide), scene.given(guide.key + ".cycle"),
                      -guide.force.value_or(0));
  };
  std::ranges::stable_sort(guides, {}, rank);
}

/// It does not come near along a force that swings, or lies along the surface, beside the one that
/// presses it.
template <int dim>
Vector<dim> pressing_sum(const Scene& scene, const Vector<dim>& outward,
                         const std::vector<Guide<dim>>& guides) {
  const Guide<dim>& first = guides.front();
  Vector<dim> sum = Vector<dim>::Zero();
  for (const Guide<dim>& guide : guides) {
    const bool beside = scene.given(guide.key + ".cycle") || lies_along(outward, guide);
    if (guide.force && !guide.turns() && (&guide == &first || !beside))
      sum += *guide.force * guide.along;
  }
  if (sum.isZero(0) && first.force)
    throw InputError(scene.path().string() +
                     ": [[counter_body.press]]: expected a direction with a force above zero" +
                     (std::ranges::any_of(guides, &Guide<dim>::turns)
                          ? ", also beside a moment, which brings nothing into contact"
                          : ""));
  for (const Guide<dim>& guide : guides)
    if (guide.travel && !first.force) sum += guide.travel->factor(0) * guide.along;
  return sum;
}

}  // namespace

template <int dim>
void order_guides(const Scene& scene, const Normals<dim>& normals, CounterBody<dim>& body) {
  const Vector<dim> outward = mean_of<dim>(normals);
  std::vector<Guide<dim>>& guides = body.guides;
  sort(scene, outward, guides);
  const auto lies = [&](const Guide<dim>& guide) { return lies_along(outward, guide); };
  if (!outward.isZero(0) && std::ranges::all_of(guides, [&](const Guide<dim>& guide) {
        return meets_none(normals, guide);
      }))
    guides.insert(guides.begin(), Guide<dim>{.along = -outward});
  Guide<dim>& first = guides.front();
  body.approach = first.along;
  // Beside an approach a force, which would move the counter-body freely, lies along the surface.
  const bool alone = std::all_of(guides.begin() + 1, guides.end(), lies) ||
                     (!first.force && std::ranges::any_of(guides, [](const Guide<dim>& guide) {
                       return guide.force && !guide.turns();
                     }));
  const Vector<dim> sum = pressing_sum(scene, outward, guides);
  if (!alone && !sum.isZero(0))
    body.come_along(sum);
  else if (!first.is_held())
    first.share = 1;
}

template void order_guides(const Scene&, const Normals<2>&, CounterBody<2>&);
template void order_guides(const Scene&, const Normals<3>&, CounterBody<3>&);

}  // namespace gnomon
