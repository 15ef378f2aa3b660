// Whether loads press bodies of pairs on what they touch.
#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/shapes/counter_surface.hpp>
#include <iterator>
#include <set>

#include "model/bring_together.hpp"
#include "model/rigid_balance.hpp"
#include "part/held_bodies.hpp"

namespace gnomon::part {

template <int dim>
std::vector<LoadTime> load_times(const Scene& scene, const std::vector<Load<dim>>& loads) {
  const double end = scene.real("time.end");
  std::set<double> times = {0, end};
  for (const Load<dim>& load : loads)
    for (const double t : load.history.times())
      if (t > 0 && t < end) times.insert(t);
  std::vector<LoadTime> ends;
  for (auto t = times.begin(); *t < end; ++t) {
    ends.push_back({*t, *t});
    ends.push_back({*std::next(t), *t});
  }
  return ends;
}

namespace {

/// In some phase, by a part of the size of the bodies.
template <int dim>
bool overlap(const AssemblyParts<dim>& parts) {
  constexpr double deep = 1e-3;  // of the size; less is that of round bodies as polygons
  const double size = Box<dim>::around(parts.mesh.nodes).diagonal();
  for (const Phase<dim>& phase : parts.instants()) {
    const auto x = in_space(parts.pairs, phase.places, parts.mesh.nodes);
    for (const MortarPair<dim>& pair : parts.pairs)
      if (travel_to_touch<dim>(pair, pair.approach, x) < -deep * size) return true;
  }
  return false;
}

template <int dim>
InputError unpressed(const Scene& scene, const AssemblyParts<dim>& parts,
                     const RigidPart<dim>& part, const std::string& when, const std::string& motion,
                     const std::string& why) {
  const std::string& name = body_of_part(parts, part).name;
  return InputError(fmt::format(
      "{}: [[load]]: expected loads that press \"{}\" and what it touches on each other at any "
      "time, but {}\"{}\" can {}, and {}; hold it there in [[support]], or direct [[load]] into "
      "the contact",
      scene.path().string(), name, when, name, motion, why));
}

}  // namespace

template <int dim>
void require_pressed_pairs(const Scene& scene, const AssemblyParts<dim>& parts) {
  const std::vector<RigidPart<dim>> rigid = rigid_parts(parts, parts.mesh.nodes);
  const auto free =
      std::ranges::find_if(rigid, [](const RigidPart<dim>& part) { return part.loose.cols() > 0; });
  if (parts.pairs.empty() || free == rigid.end() || supports_press(parts)) return;
  const Foundation<dim> foundation(parts, rigid, parts.mesh.nodes, {});
  const double least = rounding_of_loads * foundation.largest_load();
  const bool overlaps = overlap(parts);
  const auto pulls = [&](const Load<dim>& load) { return !forces_of(load, parts).isZero(0); };
  if (std::ranges::none_of(parts.loads, pulls) && !overlaps)
    return;  // find_magnitudes() tells more
  const std::vector<Pose<dim>> at_first(rigid.size(), Pose<dim>::Identity());
  const std::vector<LoadTime> times = load_times(scene, parts.loads);
  const bool changes = loads_change(parts.loads);
  for (const Phase<dim>& phase : parts.instants())
    for (const LoadTime& at : times) {
      const std::string when = fmt::format(
          "{}{}", changes ? fmt::format("at t = {:g} s ", at.t) : "",
          parts.cycle ? fmt::format("at tau = {:.3g} of the cycle ", phase.position) : "");
      const std::vector<Twist<dim>> loads = foundation.loads(at_first, at);
      bool driven = false;
      for (std::size_t k = 0; k < rigid.size(); ++k) {
        const Twist<dim> along =
            phase.load * (rigid[k].loose * (rigid[k].loose.transpose() * loads[k]));
        if (along.norm() <= least) continue;
        driven = true;
        const Closing contact = closing_of(parts, rigid[k], along);
        if (contact.opens > contact.closes && contact.is_one_sided())
          throw unpressed(scene, parts, rigid[k], when,
                          description_of<dim>(along, rigid[k], parts.section()),
                          "its loads pull it off there");
      }
      if (!driven && !(overlaps && (parts.cycle || wedged(parts))))
        throw unpressed(scene, parts, *free, when, free_motions_of(*free, parts.section()),
                        "no load acts on it in this way");
    }
}

template std::vector<LoadTime> load_times(const Scene&, const std::vector<Load<2>>&);
template std::vector<LoadTime> load_times(const Scene&, const std::vector<Load<3>>&);
template void require_pressed_pairs(const Scene&, const AssemblyParts<2>&);
template void require_pressed_pairs(const Scene&, const AssemblyParts<3>&);

}  // namespace gnomon::part
