// How long the next step is: from the errors of the last ones, or fixed.
#pragma once

#include <gnomon/base/packed_numbers.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <vector>

namespace gnomon {

/// PI control of the step size (Gustafsson; Hairer and Wanner II, IV.2) with bounded growth.
class StepSizeControl {
public:
  /// `order`: of the step as a function of its size, error ~ h^(order + 1).
  explicit StepSizeControl(int order) : exponent_(1.0 / (order + 1)) {}

  /// Step after one of size h whose estimated error (1: the tolerance) was accepted.
  double after_success(double h, double error);
  /// Step to repeat one of size h whose error was too large.
  double after_rejection(double h, double error);
  /// A step that failed for another reason is half as long, and the next does not grow.
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

/// Steps that are shorter by this factor than the others are not made: their ends merge.
inline constexpr double sliver = 1e-3;

/// Newton iterations that are spent on one step, or on 1e-5 of a run, before it is given up.
inline constexpr long most_newton_iterations = 5000;

/// The next point after t of the grid k step that is not within a sliver of t (by count rather than
/// by adding up, so that it does not drift), or t_stop where that comes earlier or a sliver later.
double end_of_fixed_step(double t, double step, double t_stop);

/// Where a step from t has to end at the latest: on the next corner (Structure) before t_stop, else
/// on t_stop.
double end_of_smooth_part(const Structure& structure, double t, double t_stop);
/// Whether F may have a kink in time at t, on which a step has ended.
bool is_corner(const Structure& structure, double t);

/// First step: the one in which the surface would move, at its present rate, by as much of its
/// final wear depth as a step of this order can at the tolerance. Rejections correct what this
/// misses.
double first_step(const State& start, const Structure& structure,
                  const IntegratorSettings& settings, int order);

}  // namespace gnomon
