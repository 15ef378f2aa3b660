// The error of the step to come, by which its Newton iterations are measured.
#pragma once

#include <cmath>
#include <gnomon/integrators/integrator.hpp>

namespace gnomon {

/// Errors are measured by ErrorNorm, 1 being the tolerance. That of a fixed step follows from the
/// estimate for the last one. It is not in a checkpoint: the first step after one is solved to
/// rounding, whether the run goes on or is resumed.
class ExpectedError {
public:
  /// `order`: the estimated error of a step of size h is of order h^(order + 1).
  ExpectedError(const IntegratorSettings& settings, int order)
      : fixed_(settings.step > 0), order_(order) {}

  /// Of a step of size h; 0 where it is not known.
  double of_step(double h) const {
    if (!fixed_) return 1;
    return last_step_ > 0 ? last_error_ * std::pow(h / last_step_, order_ + 1) : 0;
  }
  /// After a step of size h with this estimated error.
  void learn(double h, double error) {
    last_step_ = h;
    last_error_ = error;
  }

private:
  bool fixed_;
  int order_;
  double last_step_ = 0, last_error_ = 0;
};

}  // namespace gnomon
