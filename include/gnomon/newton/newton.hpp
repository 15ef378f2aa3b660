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

/// G(y) = 0 on the pattern of `structure`.
struct NonlinearFunction {
  std::function<void(std::span<const double> y, std::span<double> G)> residual;
  std::function<void(std::span<const double> y, std::span<double> values)> jacobian;
  /// The smooth branch that y lies in. Kept factors serve one branch only.
  std::function<ActiveSet(std::span<const double> y)> branch{};
  double rate_weight = 0;          ///< of the rates in J; kept factors serve nearby weights
  std::vector<int> switch_node{};  ///< mesh nodes of the entries of `branch`, for the diagnosis
};

/// How a solve went.
struct NewtonReport {
  bool converged = false;
  int iterations = 0;
  std::vector<double> norms;  ///< largest scaled residual at each iterate, the start first
  std::string reason;         ///< why it did not converge
};

/// Newton steps with the exact Jacobian, or with kept factors as long as they contract; a step into
/// a state without residual (inverted element) is halved by KINSOL. What is decided on the way is
/// in src/newton/newton_policy.hpp. Holds the analysed factorization, so make one per system and
/// use it often.
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
