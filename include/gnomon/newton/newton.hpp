// Semismooth Newton for one nonlinear system, by KINSOL with an exact Jacobian.
#pragma once

#include <functional>
#include <gnomon/base/counters.hpp>
#include <gnomon/system/system.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace gnomon {

/// When a nonlinear solve is done. Every integrator solves its equations to this tolerance, so that
/// conserved quantities hold whatever the error tolerance of the time integration.
struct NewtonOptions {
  /// Of the largest residual, each row by its row_scale; rows with rates by what ten roundings of
  /// y leave of alpha y, over `acceptable`, where that is more.
  double tolerance = 1e-11;
  double acceptable = 1e-9;  ///< accepted when rounding stops the iteration above `tolerance`
  int max_iterations = 30;
  bool keep_factors = false;  ///< modified Newton: factorize only when the last factors serve badly
  double slow = 0.2;          ///< contraction an iteration above which kept factors serve badly
};

/// What integrators solve their equations with.
inline constexpr NewtonOptions modified_newton{.max_iterations = 60, .keep_factors = true};

/// G(y) = 0 on the pattern of `structure`.
struct NonlinearFunction {
  std::function<void(std::span<const double> y, std::span<double> G)> residual;
  std::function<void(std::span<const double> y, std::span<double> values)> jacobian;
  /// The smooth piece that y lies in. Kept factors serve one piece only.
  std::function<ActiveSet(std::span<const double> y)> piece{};
  double alpha = 0;                ///< weight of the rates in J; kept factors serve nearby weights
  std::vector<int> switch_node{};  ///< mesh nodes of the piece's entries, for the diagnosis
};

/// How a solve went.
struct NewtonReport {
  bool converged = false;
  int iterations = 0;
  std::vector<double> norms;  ///< largest scaled residual at each iterate, the start first
  std::string reason;         ///< why it did not converge
};

/// Newton steps with the exact Jacobian, or with kept factors as long as they contract; a step into
/// a state without residual (inverted element) is halved by KINSOL. Holds the analysed
/// factorization, so make one a system and use it often.
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
