// The pin of the paper with small strains as the text of a scene, without mesh and settings.
#pragma once

#include <string>

namespace gnomon::test {

/// Until `end`: 0.002 mm^2 wear per second.
inline std::string pin_text(int end) {
  return R"(problem = "pin_on_flat"
[pin]
radius = 5
height = 10
width = 10
[body]
young_modulus = 640
poisson_ratio = 0.3
[load]
force = 20
[wear]
coefficient = 1e-7
velocity = 1000
[time]
end = )" +
         std::to_string(end) + "\n";
}

}  // namespace gnomon::test
