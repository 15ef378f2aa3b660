// Hertzian point contact: typical values of a ball before it wears.
#pragma once

#include <cmath>

namespace gnomon {

/// A rigid and an elastic body, one of them a ball of radius R, under a force F; E* = E/(1 - nu^2).
/// K. L. Johnson, Contact Mechanics, Cambridge 1985, sec. 4.2.
struct HertzPoint {
  double radius;         ///< a = (3 F R / (4 E*))^(1/3) [length]
  double approach;       ///< a^2/R [length]
  double peak_pressure;  ///< p0 = 3 F / (2 pi a^2) [stress]

  HertzPoint(double force, double R, double young, double poisson) {
    const double E = young / (1 - poisson * poisson);
    radius = std::cbrt(3 * force * R / (4 * E));
    approach = radius * radius / R;
    peak_pressure = 3 * force / (2 * M_PI * radius * radius);
  }
};

}  // namespace gnomon
