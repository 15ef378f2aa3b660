// Solvers of the linear systems with the Jacobian of a system.
#pragma once

#include <functional>
#include <gnomon/base/counters.hpp>
#include <map>
#include <memory>
#include <span>
#include <string>

namespace gnomon {

struct Structure;

/// Solves J x = b for a sequence of Jacobians on the pattern of a structure. Counts its
/// factorizations, set-ups and iterations.
class LinearSolver {
public:
  virtual ~LinearSolver() = default;

  /// Takes the values of a new Jacobian, which must outlive the solves with it. Throws
  /// RecoverableError where it is not finite or, as far as is known at once, singular.
  virtual void set_up(std::span<const double> J) = 0;
  /// x = J^-1 b, both with size entries; x may be b. The residual, rows divided by their
  /// Structure::row_scale, falls in the Euclidean norm to `reduction` of that of b, or to 0.3 at
  /// least, so that a repeated solve for what is left goes on. Throws RecoverableError otherwise.
  virtual void solve(std::span<const double> b, std::span<double> x, double reduction) = 0;
};

/// How to make the linear solver of a structure.
struct LinearSolverMaker {
  /// What the solver is given must outlive it. Throws InputError for a structure without what the
  /// solver needs.
  std::function<std::unique_ptr<LinearSolver>(const Structure&, Counters&)> make = {};
  /// The keys of a scene that the size decides where the scene does not, with their values.
  std::map<std::string, std::string> keys = {};
  bool coarsens = false;  ///< needs Structure::coarsening
};

}  // namespace gnomon
