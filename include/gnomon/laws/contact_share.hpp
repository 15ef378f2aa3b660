// The share of the area of a contact node that counts as in contact, for wear laws that do not
// vanish with the pressure: so that their wear is continuous where nodes close.
#pragma once

namespace gnomon {

/// s = x (2 - x), x = p / full; 0 without pressure, 1 from `full` on. Its slope jumps at p = 0
/// alone, where it is that below.
struct ContactShare {
  double value = 1, by_pressure = 0;

  ContactShare() = default;
  ContactShare(double pressure, double full) {
    if (pressure >= full) return;
    const double x = pressure > 0 ? pressure / full : 0;
    value = x * (2 - x);
    by_pressure = pressure > 0 ? 2 * (1 - x) / full : 0;
  }
};

}  // namespace gnomon
