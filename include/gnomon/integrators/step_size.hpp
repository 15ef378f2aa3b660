// The size of the next step, from the errors of the last ones.
#pragma once

#include <gnomon/base/packed_numbers.hpp>
#include <gnomon/integrators/integrator.hpp>
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
  double after_success(double h, double error);
  /// Size with which to repeat a step of size h whose error was too large. The step after it does
  /// not grow.
  double after_rejection(double h, double error);
  /// Size after a step of size h that failed for another reason: the half. The step after it does
  /// not grow.
  double after_failure(double h);

  std::vector<double> memory() const { return {last_error_, double(may_grow_)}; }
  void restore(Unpacker& memory) {
    last_error_ = memory.one();
    may_grow_ = memory.one() != 0;
  }

private:
  double exponent_;
  double last_error_ = 1;
  bool may_grow_ = true;
};

/// Size of the first step: the surface moves in it, at its present rate, by the part of its final
/// wear depth that a step of this order can resolve at the tolerance. If it is too large,
/// rejections correct it.
double first_step(const State& start, const Structure& structure,
                  const IntegratorSettings& settings, int order);

}  // namespace gnomon
