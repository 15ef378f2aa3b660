// Linear systems with the Jacobian of a system, by the solver that its structure chooses.
#pragma once

#include <gnomon/base/counters.hpp>
#include <gnomon/system/system.hpp>
#include <memory>
#include <span>

namespace gnomon {

/// Solves J x = b for a sequence of Jacobians on the pattern of a structure: by blocks as long as
/// they serve, else by factors of the whole Jacobian (Structure::solver). Counts its work.
class LinearSolve {
public:
  /// The referenced objects must outlive it. Throws InputError as BlockPreconditioner.
  LinearSolve(const Structure& structure, Counters& counters);
  ~LinearSolve();

  /// Takes the values of a new Jacobian, which must outlive the solves with it. Throws
  /// RecoverableError where it is not finite or, as far as is known at once, singular.
  void set_up(std::span<const double> J);
  /// x = J^-1 b, both with size entries; x may be b. The residual, rows divided by their
  /// Structure::row_scale, falls in the Euclidean norm to `reduction` of that of b; where blocks
  /// without factors to help cannot do it, to 0.3 at least, so that a repeated solve for what is
  /// left goes on. Throws RecoverableError otherwise. Factors take no notice of `reduction`.
  void solve(std::span<const double> b, std::span<double> x, double reduction);

private:
  class Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace gnomon
