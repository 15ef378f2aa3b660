// Elliptical contact of two bodies: K. L. Johnson, Contact Mechanics, Cambridge 1985, sec. 4.2(c).
#pragma once

#include <cmath>

namespace gnomon::testing {

/// Under a force F, with the gap A x^2 + B y^2, A <= B, before contact, and E* [stress].
struct HertzEllipse {
  double along_x, along_y;  ///< half axes a >= b [length]
  double peak_pressure;     ///< p0 = 3 F / (2 pi a b) [stress]

  HertzEllipse(double F, double A, double B, double modulus) {
    double low = 0, high = 1;  // of the eccentricity e, with which B/A grows
    for (int k = 0; k < 100; ++k) {
      const double e = (low + high) / 2;
      (ratio(e) > B / A ? high : low) = e;
    }
    const double e = low, K = std::comp_ellint_1(e), E = std::comp_ellint_2(e);
    along_x = B > A ? std::cbrt(1.5 * F * (K - E) / (M_PI * modulus * A * e * e))
                    : std::cbrt(0.375 * F / (modulus * A));
    along_y = along_x * std::sqrt(1 - e * e);
    peak_pressure = 1.5 * F / (M_PI * along_x * along_y);
  }
  double pressure(double x, double y) const {
    const double r = std::hypot(x / along_x, y / along_y);
    return r < 1 ? peak_pressure * std::sqrt(1 - r * r) : 0;
  }

private:
  static double ratio(double e) {
    const double K = std::comp_ellint_1(e), E = std::comp_ellint_2(e);
    return (E / (1 - e * e) - K) / (K - E);
  }
};

}  // namespace gnomon::testing
