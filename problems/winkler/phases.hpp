// The phases of the flat that wears the pin on springs: one when it slides steadily, several with
// [cycle].
#pragma once

#include <gnomon/scene/scene.hpp>
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

/// One phase by load.force and wear.velocity; with a cycle those of cycle.phases, with cycle.force
/// or the approach cycle.y instead of the force, and the speed of cycle.x instead of wear.velocity.
/// Throws InputError.
std::vector<Phase> read_phases(const Scene& scene);

/// The mean speed over the cycle [mm/s].
double mean_speed(const std::vector<Phase>& phases);

}  // namespace gnomon::winkler
