#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/cycles/cycle_scene.hpp>
#include <set>
#include <string>

#include "winkler_system.hpp"

namespace gnomon::winkler {

namespace {

/// The corners of the functions, and where the flat reverses: there |v| has one.
std::vector<double> kinks_of(const Cycle& cycle) {
  std::vector<double> reversals;
  if (const auto& x = cycle.displacement[0])
    reversals = sign_changes_in_cycle(
        [&x](double tau, std::span<double> values) { values[0] = x->slope(tau); }, 1);
  return merged_kinks(cycle.kinks(), reversals);
}

/// Refuses two keys that say the same, and none of them.
void require_one_of(const Scene& scene, const std::vector<std::string>& keys) {
  std::string first;
  for (const std::string& key : keys) {
    if (!scene.has(key)) continue;
    if (!first.empty())
      throw InputError(
          fmt::format("{}: expected either {} or {}, got both", scene.where(key), first, key));
    first = key;
  }
  if (first.empty())
    throw InputError(fmt::format("{}: missing key `{}` (with a cycle instead also {})",
                                 scene.path().string(), keys.front(),
                                 fmt::join(keys.begin() + 1, keys.end(), " or ")));
}

/// Where nothing presses, the place of the flat is not determined.
void require_forces(const Scene& scene, const std::vector<Phase>& phases) {
  double most = 0;
  for (const Phase& phase : phases) most = std::max(most, phase.press);
  for (const Phase& phase : phases)
    if (!(phase.press >= 1e-6 * most && most > 0))
      throw InputError(fmt::format(
          "{}: expected a force above zero (1e-6 of the largest or more) in every phase, got {:g} "
          "at tau = {:g}; a flat that loses contact is held by cycle.y",
          scene.where("cycle.force"), phase.press, phase.position));
}

/// What a phase stands for, from points of its interval: the whole path, and the mean force or
/// approach on it.
void stand_for(const std::vector<Phase>& interval, Phase& phase) {
  double path = 0, press = 0;
  for (const Phase& at : interval) {
    path += at.weight * at.speed;
    press += at.weight * at.speed * at.press;
  }
  phase.speed = path / phase.weight;
  if (path > 0) phase.press = press / path;
}

}  // namespace

std::vector<Key> phase_keys() {
  std::vector<Key> keys;
  for (Key key : worn_body_keys(2)) {
    if (key.name != "load.force" && key.name != "wear.velocity") continue;
    key.absent_meaning = key.name == "load.force" ? "cycle.force or cycle.y" : "that of cycle.x";
    keys.push_back(key);
  }
  // The flat neither turns nor leaves the plane, and nothing else loads the pin.
  const std::set<std::string> without_use = {"cycle.z", "cycle.rotation", "cycle.load"};
  for (Key key : cycle_keys()) {
    if (without_use.contains(key.name)) continue;
    if (key.name == "cycle.y") key.help = "of the flat towards the pin from the first touch";
    if (key.name == "cycle.force")
      key.unit = "N/mm", key.help = "instead of load.force; above zero";
    keys.push_back(key);
  }
  return keys;
}

FlatMotion read_flat_motion(const Scene& scene) {
  require_one_of(scene, {"load.force", "cycle.force", "cycle.y"});
  require_one_of(scene, {"wear.velocity", "cycle.x"});
  const std::optional<Cycle> cycle = read_cycle(scene);
  const double force = scene.real_if("load.force").value_or(0);
  const double speed = scene.real_if("wear.velocity").value_or(0);
  if (!cycle) return {.phases = {{.speed = speed, .press = force}}, .phase_set = {}};
  const CycleQuadrature quadrature = read_cycle_quadrature(scene, kinks_of(*cycle));
  const auto phase_at = [cycle = *cycle, force, speed](const CyclePoint& point) {
    const auto &x = cycle.displacement[0], &y = cycle.displacement[1];
    const double tau = point.position;
    return Phase{.position = tau,
                 .weight = point.weight,
                 .speed = x ? std::abs(x->slope(tau)) / cycle.period : speed,
                 .held = y.has_value(),
                 .press = y             ? y->value(tau)
                          : cycle.force ? cycle.force->value(tau)
                                        : force};
  };
  FlatMotion motion;
  motion.phase_set = [quadrature, phase_at](const PhaseSet& set) {
    return phases_of(quadrature, set, phase_at, stand_for);
  };
  motion.phases = motion.phase_set({});
  motion.parts = quadrature.parts();
  motion.remarks = cycle->remarks();
  if (cycle->force) require_forces(scene, motion.phases);
  if (!(mean_speed(motion.phases) > 0))
    throw InputError(scene.where("cycle.x") + ": expected a flat that slides in some phase");
  return motion;
}

double mean_speed(const std::vector<Phase>& phases) {
  return mean_over(phases, [](const Phase& phase) { return phase.speed; });
}

}  // namespace gnomon::winkler
