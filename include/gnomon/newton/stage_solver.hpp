// Solves the algebraic part of a system for given differential components, stage after stage.
#pragma once

#include <gnomon/newton/newton.hpp>
#include <memory>
#include <string>
#include <vector>

namespace gnomon {

/// Remark 1 of the paper: with the worn surface given, mesh motion and contact are solved one after
/// the other, never together.
class StageSolver {
public:
  StageSolver(const System& system, Counters& counters);
  /// Makes y consistent at t with its differential components, which stay, on a piece (Point). On
  /// failure returns the reason (empty on success) and leaves y unspecified.
  std::string solve(double t, std::span<double> y, const ActiveSet* piece = nullptr);

private:
  std::vector<Stage> stages_;
  std::vector<std::unique_ptr<NewtonSolver>> newton_;
  std::vector<std::vector<double>> unknowns_;
};

/// The residual and Jacobian of a purely algebraic system on a piece (Point), for NewtonSolver.
NonlinearFunction algebraic_function(const System& system, const ActiveSet* piece = nullptr);

}  // namespace gnomon
