// The loop of place and force that a path in the plane stores.
#pragma once

#include <gnomon/model/model.hpp>

namespace gnomon::testing {

/// A value of a phase, whose number may be one past the last: place along x and y, then force.
inline double at_phase(const ContactSurface& surface, std::size_t phase, std::size_t value) {
  constexpr std::size_t values = 4;
  const std::vector<double>& loop = surface.phase_loop;
  return loop[(values * phase) % loop.size() + value];
}

/// Work of the force along the loop.
inline double enclosed_by_loop(const ContactSurface& surface) {
  double work = 0;
  for (std::size_t p = 0; p < surface.phase_position.size(); ++p)
    for (const std::size_t i : {0u, 1u})
      work += (at_phase(surface, p, 2 + i) + at_phase(surface, p + 1, 2 + i)) / 2 *
              (at_phase(surface, p + 1, i) - at_phase(surface, p, i));
  return work;
}

}  // namespace gnomon::testing
