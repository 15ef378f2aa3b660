// How much of the typical load acts, by the contact multipliers.
#pragma once

#include <algorithm>
#include <cmath>
#include <gnomon/base/processes.hpp>
#include <gnomon/system/system.hpp>

namespace gnomon {

/// The largest contact multiplier in units of its typical value, at least `least` and at most 1.
/// Under a thousandth of the load forces have to balance to a thousandth of what is enough
/// otherwise. 1 for systems without contact.
class PressureLevel {
public:
  explicit PressureLevel(const Structure& structure) : scale_(structure.unknown_scale) {
    for (std::size_t i = 0; i < structure.block.size(); ++i)
      if (structure.role(i) == Role::multiplier) multipliers_.push_back(static_cast<int>(i));
  }

  double operator()(std::span<const double> y) const {
    constexpr double least = 1e-6;
    double level = multipliers_.empty() ? 1 : least;
    for (int i : multipliers_) level = std::max(level, std::abs(y[i]) / scale_[i]);
    return std::min(1.0, largest_over_processes(level));
  }

private:
  std::vector<int> multipliers_;
  const std::vector<double>& scale_;
};

}  // namespace gnomon
