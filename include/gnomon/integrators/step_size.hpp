// The size and the error of the next step, from the errors of the last ones.
#pragma once

#include <algorithm>
#include <cmath>
#include <gnomon/base/packed_numbers.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/system/system.hpp>
#include <vector>

namespace gnomon {

/// Bound on the growth of steps by the next one.
inline constexpr double most_growth = 5;

/// PI control of the step size (Gustafsson; Hairer and Wanner II, IV.2) with bounded growth:
///
///   h_new = h * 0.9 * e_n^(-0.7/p) * e_(n-1)^(0.4/p),   p = order + 1.
///
/// Errors are measured by ErrorNorm, 1 being the tolerance.
class StepSizeControl {
public:
  /// `order`: the error of a step of size h is proportional to h^(order + 1).
  explicit StepSizeControl(int order) : exponent_(1.0 / (order + 1)) {}

  /// Step after one of size h whose estimated error was accepted.
  double after_success(double h, double error) {
    error = std::max(error, least_error);
    const double factor = safety * std::pow(error, -proportional * exponent_) *
                          std::pow(last_error_, integral * exponent_);
    last_error_ = error;
    const double bound = may_grow_ ? most_growth : 1.0;
    may_grow_ = true;
    return h * std::clamp(factor, most_shrink, bound);
  }
  /// Size with which to repeat a step of size h whose error was too large. The step after it does
  /// not grow.
  double after_rejection(double h, double error) {
    may_grow_ = false;
    return h * std::max(safety * std::pow(error, -exponent_), most_shrink);
  }
  /// Size after a step of size h that failed for another reason: the half. The step after it does
  /// not grow.
  double after_failure(double h) {
    may_grow_ = false;
    return h / 2;
  }

  std::vector<double> memory() const { return {last_error_, double(may_grow_)}; }
  void restore(Unpacker& memory) {
    last_error_ = memory.one();
    may_grow_ = memory.one() != 0;
  }

private:
  // Aims at nine tenths of the step that the estimate allows, so that few are rejected.
  static constexpr double safety = 0.9;
  // Gustafsson's gains: 0.7 and 0.4 of the exponent of the elementary (I) controller.
  static constexpr double proportional = 0.7, integral = 0.4;
  // An estimate holds for steps of similar size: beyond these factors the error law is unreliable.
  static constexpr double most_shrink = 0.2;
  static constexpr double least_error = 1e-8;  // smaller estimates give no more information

  double exponent_;
  double last_error_ = 1;
  bool may_grow_ = true;
};

/// Size of the first step: the surface moves in it, at its present rate, by the part of its final
/// wear depth that a step of this order can resolve at the tolerance. If it is too large,
/// rejections correct it.
inline double first_step(const State& start, const Structure& structure,
                         const IntegratorSettings& settings, int order) {
  constexpr double parts = 100;  // parts of the remaining run, if nothing moves yet
  double largest = 0;
  for (std::size_t i = 0; i < start.ydot.size(); ++i)
    if (structure.differential[i]) largest = std::max(largest, std::abs(start.ydot[i]));
  const double longest = settings.end - start.t;
  if (largest == 0) return longest / parts;
  const double part = std::pow(settings.rtol, 1.0 / (order + 1));
  return std::min(longest, part * settings.scale / largest);
}

/// The error of the step to come, by which its Newton iterations are measured; 1 is the tolerance
/// (ErrorNorm). That of a fixed step follows from the estimate for the last one, if this is of the
/// order of the method: an embedded method of lower order says nothing about it. It is not in a
/// checkpoint: the first step after one is solved to rounding, whether the run goes on or is
/// resumed.
class ExpectedError {
public:
  /// The estimated error of a step of size h is of order h^(error_order + 1).
  ExpectedError(const IntegratorSettings& settings, int order, int error_order)
      : fixed_(settings.step > 0), order_(error_order), known_(error_order >= order) {}

  /// Of a step of size h; 0 where it is not known.
  double of_step(double h) const {
    if (!fixed_) return 1;
    return known_ && last_step_ > 0 ? last_error_ * std::pow(h / last_step_, order_ + 1) : 0;
  }
  /// After a step of size h with this estimated error.
  void learn(double h, double error) {
    last_step_ = h;
    last_error_ = error;
  }

private:
  bool fixed_;
  int order_;
  bool known_;
  double last_step_ = 0, last_error_ = 0;
};

}  // namespace gnomon
