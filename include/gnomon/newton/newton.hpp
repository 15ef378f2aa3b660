// Semismooth Newton for one nonlinear system, by KINSOL with an exact Jacobian.
#pragma once

#include <functional>
#include <gnomon/base/counters.hpp>
#include <gnomon/newton/newton_options.hpp>
#include <gnomon/system/system.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace gnomon {

using Distance = std::function<double(std::span<const double> before, std::span<const double> y)>;

/// The equations G(y) = 0; the Jacobian has the pattern of `structure`.
struct NonlinearFunction {
  std::function<void(std::span<const double> y, std::span<double> G)> residual;
  std::function<void(std::span<const double> y, std::span<double> values)> jacobian;
  /// The smooth branch that y lies in. Kept factors are used on one branch only.
  std::function<ActiveSet(std::span<const double> y)> branch{};
  double rate_weight = 0;  ///< weight of the rates in J; kept factors are used for similar weights
  std::vector<int> switch_node{};  ///< mesh nodes of the entries of `branch`, for the diagnosis
  /// Distance of two iterates in units of the tolerated error of the step, for
  /// NewtonOptions::fraction. Empty: the equations are solved to NewtonOptions::tolerance.
  Distance distance{};
  /// That of the points of `jacobian`, which is made again when the iteration needs it.
  SlowPart* slow = nullptr;
};

/// Report on a solve.
struct NewtonReport {
  bool converged = false;
  int iterations = 0;
  std::vector<double> norms;  ///< largest scaled residual at each iterate, the start first
  std::string reason;         ///< why it did not converge
};

/// Newton steps with the exact Jacobian, or with kept factors as long as they contract; a step into
/// a state without residual (inverted element) is halved by KINSOL. The decisions are made in
/// src/newton/newton_policy.hpp. It holds the analysed factorization, so make one solver per system
/// and use it many times.
class NewtonSolver {
public:
  /// `structure` must outlive the solver.
  NewtonSolver(const Structure& structure, Counters& counters, const NewtonOptions& options = {});
  ~NewtonSolver();

  /// Solves from the guess y, in place; y is unspecified when the report says not converged.
  /// Exceptions of `function` other than RecoverableError pass through.
  NewtonReport solve(const NonlinearFunction& function, std::span<double> y);

private:
  class Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace gnomon
