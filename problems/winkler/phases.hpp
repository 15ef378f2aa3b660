// The phases of the flat that wears the pin on springs: one when it slides steadily, several with
// [cycle].
#pragma once

#include <functional>
#include <gnomon/cycles/phase_mean.hpp>
#include <gnomon/scene/scene.hpp>
#include <string>
#include <vector>

namespace gnomon::winkler {

/// The flat at a position of the cycle.
struct Phase {
  double position = 0;  ///< tau
  double weight = 1;    ///< omega, its part of the mean over the cycle
  double speed = 0;     ///< v_q [mm/s]
  bool held = false;    ///< whether `press` is the approach [mm] instead of the force [N/mm]
  double press = 0;
};

/// Keys of load.force, wear.velocity and [cycle]: what presses and moves the flat.
std::vector<Key> phase_keys();

/// Phases of a cycle.
using PhaseSource = std::function<std::vector<Phase>(const PhaseSet&)>;

/// One phase by load.force and wear.velocity; with a cycle those of cycle.phases, with cycle.force
/// or the approach cycle.y instead of the force, and the speed of cycle.x instead of wear.velocity;
/// then also where others of the cycle come from. Throws InputError.
struct FlatMotion {
  std::vector<Phase> phases;
  PhaseSource phase_set;               ///< empty: there is no cycle
  int parts = 0;                       ///< of the cycle between corners and reversals
  std::vector<std::string> remarks{};  ///< for the user
};
FlatMotion read_flat_motion(const Scene& scene);

/// The mean speed over the cycle [mm/s].
double mean_speed(const std::vector<Phase>& phases);

}  // namespace gnomon::winkler
