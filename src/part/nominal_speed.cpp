#include "part/nominal_speed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/model/wear_scene.hpp>
#include <gnomon/terms/sliding.hpp>
#include <limits>
#include <map>
#include <vector>

#include "part/histories.hpp"
#include "part/part_cycle.hpp"
#include "part/phases.hpp"

namespace gnomon::part {

namespace {

template <int dim>
using Patches = std::vector<const ContactPatch<dim>*>;
/// The counter-body at several positions of a cycle, or where it is.
template <int dim>
using Instants = std::vector<CounterBody<dim>>;

/// Whether the counter-body meets facets between their nodes.
template <int dim>
bool meets_between_nodes(const Instants<dim>& instants, const Patches<dim>& all) {
  std::map<int, Vector<dim>> place;
  for (const auto* patch : all) place[patch->node] = patch->initial_position;
  const auto meets = [&](const Vector<dim>& x, const Vector<dim>& outward) {
    return std::ranges::any_of(instants, [&](const CounterBody<dim>& other) {
      return std::isfinite(other.travel_to(x, outward));
    });
  };
  constexpr int parts = 8;
  for (const auto* patch : all)
    for (const auto& corner : patch->corners)
      for (const int other : corner.nodes) {
        const auto to = place.find(patch->nodes[static_cast<std::size_t>(other)]);
        if (to == place.end()) continue;
        const Vector<dim>& from = patch->initial_position;
        for (int k = 1; k < parts; ++k)
          if (meets(from + double(k) / parts * (to->second - from), patch->initial_normal))
            return true;
      }
  return false;
}

/// The contact nodes that touch first.
template <int dim>
Patches<dim> first_touch(const Scene& scene, const Instants<dim>& instants,
                         const Patches<dim>& all) {
  double least = std::numeric_limits<double>::infinity();
  Patches<dim> touching;
  for (const auto* patch : all) {
    double travel = std::numeric_limits<double>::infinity();
    for (const CounterBody<dim>& other : instants)
      travel = std::min(travel, other.travel_to(patch->initial_position, patch->initial_normal));
    if (travel < least) {
      least = travel;
      touching.clear();
    }
    if (!(travel <= least)) continue;
    touching.push_back(patch);
  }
  const auto faces = [&](double side) {
    constexpr double rounding = 1e-12;
    return std::ranges::any_of(all, [&](const auto* patch) {
      return side * patch->initial_normal.dot(instants.front().approach) > rounding;
    });
  };
  if (!faces(-1))
    refuse(scene, "counter_body.press.direction",
           std::string("a direction into the body, but ") +
               (faces(1) ? "the surfaces of wear.on face the same way"
                         : "it lies in the surfaces of wear.on and does not press on them"));
  if (!std::isfinite(least) && meets_between_nodes(instants, all))
    throw InputError(scene.where("counter_body.shape") +
                     ": the counter-body meets the surfaces of wear.on between their nodes alone, "
                     "expected a mesh that is finer there");
  if (!std::isfinite(least))
    refuse(scene, "counter_body.shape",
           "a counter-body that meets the surfaces of wear.on when it moves along "
           "counter_body.press.direction, but it passes by: change its place, that direction, or "
           "its solid side (normal of a plane, else counter_body.side)");
  return touching;
}

/// A point of the worn surface and its normal, unit.
template <int dim>
struct Place {
  Vector<dim> point, normal;
};

template <int dim>
Place<dim> place_of(const ContactPatch<dim>& patch) {
  return {patch.initial_position, patch.initial_normal};
}

/// A point of the body in the coordinates of the counter-body that touches it: a gap at first is
/// closed along the approach.
template <int dim>
Vector<dim> touched_by(const CounterBody<dim>& other, const Vector<dim>& point) {
  const double travel = other.travel_to(point);
  return other.seen(point, std::isfinite(travel) ? travel : 0);
}

/// |v_T| of the counter-body's surface at a place, its mean over the instants.
template <int dim>
double speed_at(const Instants<dim>& instants, const Place<dim>& place) {
  double sum = 0;
  for (const CounterBody<dim>& other : instants) {
    auto motion = other.motion;
    motion.reference = touched_by(other, place.point);
    motion.normal = place.normal;
    sum += motion.nominal_speed(Vector<dim>::Zero());
  }
  return sum / static_cast<double>(instants.size());
}

/// By the nodes' shares of the surface.
template <int dim>
double mean_speed(const Instants<dim>& other, const Patches<dim>& patches) {
  double sum = 0, area = 0;
  for (const auto* patch : patches) {
    sum += patch->initial_area * speed_at<dim>(other, place_of(*patch));
    area += patch->initial_area;
  }
  return sum / area;
}

/// The middle of the nodes. Where the counter-body turns about it, or where they face all sides,
/// the one of them whose speed is nearest to their mean.
template <int dim>
Place<dim> typical_place(const Instants<dim>& other, const Patches<dim>& patches) {
  Place<dim> middle{Vector<dim>::Zero(), Vector<dim>::Zero()};
  for (const auto* patch : patches) {
    middle.point += patch->initial_position / static_cast<double>(patches.size());
    middle.normal += place_of(*patch).normal / static_cast<double>(patches.size());
  }
  const bool faces_one_side = middle.normal.norm() > 0.5;
  middle.normal.normalize();
  const double mean = mean_speed<dim>(other, patches);
  if (faces_one_side && speed_at<dim>(other, middle) >= mean / 2) return middle;
  const auto off = [&](const ContactPatch<dim>* patch) {
    return std::abs(speed_at<dim>(other, place_of(*patch)) - mean);
  };
  return place_of(**std::ranges::min_element(patches, {}, off));
}

/// That of the counter-body where it first comes to the place, to which facets are only near.
template <int dim>
Vector<dim> counter_normal(const Instants<dim>& instants, const Place<dim>& place) {
  const CounterBody<dim>& first = *std::ranges::min_element(
      instants, {}, [&](const CounterBody<dim>& other) { return other.travel_to(place.point); });
  const double travel = first.travel_to(place.point);
  if (!std::isfinite(travel)) return place.normal;
  const Vector<dim> normal =
      first.unchecked_distance(first.seen(place.point, travel), 0).normal.normalized();
  return normal.allFinite() && !normal.isZero(0) ? normal : place.normal;
}

/// Whether the counter-body slides where it comes to some of the nodes: along its own surface, to
/// which facets of a round body are inclined.
template <int dim>
bool slides(const Instants<dim>& other, const Patches<dim>& patches) {
  constexpr double rounding = 1e-9;
  return std::ranges::any_of(patches, [&](const ContactPatch<dim>* patch) {
    Place<dim> place = place_of(*patch);
    place.normal = counter_normal<dim>(other, place);
    const double whole = speed_at<dim>(other, {place.point, Vector<dim>::Zero()});
    return speed_at<dim>(other, place) > rounding * whole;
  });
}

}  // namespace

template <int dim>
Meeting<dim> find_meeting(const Scene& scene, const std::vector<ContactPatch<dim>>& patches,
                          const CounterBody<dim>& rest,
                          const std::optional<CyclicMotion<dim>>& cycle) {
  const Instants<dim> other = instants(rest, cycle);
  Patches<dim> all;
  for (const auto& patch : patches) all.push_back(&patch);
  Patches<dim> touching = first_touch<dim>(scene, other, all);
  // A ball that turns about the node where it touches slides where it will touch later.
  constexpr double nothing = 1e-9;
  const double overall = mean_speed<dim>(other, all);
  if (overall > 0 && mean_speed<dim>(other, touching) <= nothing * overall) touching = all;
  Place<dim> place = typical_place<dim>(other, touching);
  place.normal = counter_normal<dim>(other, place);
  Meeting<dim> meeting{rest, 0};
  meeting.partner.motion.reference = touched_by(rest, place.point);
  meeting.partner.motion.normal = place.normal;
  const auto by_motion = [&] {
    return cycle ? mean_speed(*cycle, meeting.partner) : speed_at<dim>(other, place);
  };
  const std::optional<double> given = scene.real_if("wear.velocity");
  meeting.speed = given ? *given : by_motion();
  return meeting;
}

template <int dim>
std::vector<std::string> remarks_on_speeds(const Scene& scene,
                                           const std::vector<ContactPatch<dim>>& patches,
                                           const CounterBody<dim>& rest,
                                           const std::optional<CyclicMotion<dim>>& cycle) {
  const Instants<dim> other = instants(rest, cycle);
  std::vector<std::string> remarks;
  Patches<dim> all;
  for (const auto& patch : patches) all.push_back(&patch);
  if (!slides<dim>(other, all) && asks_for_wear(scene))
    remarks.push_back(
        "counter_body.motion or cycle.x, .y, .z, .rotation: the counter-body does not slide on the "
        "surfaces of wear.on, so that nothing wears");
  constexpr double many = 10;
  const double turns =
      rest.turning && !cycle ? scene.real("time.end") / rest.turning->duration() : 0;
  if (turns > many)
    remarks.push_back(fmt::format(
        "the counter-body turns {:.3g} times in the run and changes its place, and steps follow "
        "every turn: [cycle] with `rotation` has the mean over turns (docs/cycles.md)",
        turns));
  const auto is_turned_about = [&other](const ContactPatch<dim>& patch) {
    const double speed = speed_at<dim>(other, place_of(patch));
    return speed * speed < velocity_variance<dim>(patch, other.front().motion.spin,
                                                  other.front().motion.across_by_x);
  };
  if (dim == 3 && std::ranges::any_of(patches, is_turned_about))
    remarks.push_back(
        "the counter-body turns about a point of the wearing surface: there the worn volume is "
        "accurate to first order in the size of the facets, compare a finer mesh");
  return remarks;
}

template std::vector<std::string> remarks_on_speeds(const Scene&,
                                                    const std::vector<ContactPatch<2>>&,
                                                    const CounterBody<2>&,
                                                    const std::optional<CyclicMotion<2>>&);
template std::vector<std::string> remarks_on_speeds(const Scene&,
                                                    const std::vector<ContactPatch<3>>&,
                                                    const CounterBody<3>&,
                                                    const std::optional<CyclicMotion<3>>&);
template Meeting<2> find_meeting(const Scene&, const std::vector<ContactPatch<2>>&,
                                 const CounterBody<2>&, const std::optional<CyclicMotion<2>>&);
template Meeting<3> find_meeting(const Scene&, const std::vector<ContactPatch<3>>&,
                                 const CounterBody<3>&, const std::optional<CyclicMotion<3>>&);

}  // namespace gnomon::part
