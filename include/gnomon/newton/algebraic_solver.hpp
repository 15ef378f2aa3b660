// Solves the algebraic part of a system for given differential components.
#pragma once

#include <gnomon/newton/newton.hpp>
#include <memory>
#include <string>
#include <vector>

namespace gnomon {

/// Remark 1 of the paper: with the worn surface given, mesh motion and contact are solved one after
/// the other, never together (System::algebraic_stages).
class AlgebraicSolver {
public:
  /// `fraction`: NewtonOptions::fraction, for solves with a distance.
  AlgebraicSolver(const System& system, Counters& counters, double fraction = 0);
  /// Makes y consistent at t on a smooth branch (Point::branch); its differential components do not
  /// change. On failure returns the reason (empty on success) and leaves y unspecified.
  /// `distance`: of two y, in units of the tolerated error (NonlinearFunction::distance).
  std::string solve(double t, std::span<double> y, const ActiveSet* branch = nullptr,
                    const Distance& distance = {});

private:
  struct Subproblem {
    AlgebraicStage equations;
    std::unique_ptr<NewtonSolver> newton;
    std::vector<double> unknowns;
  };
  static void put(const Subproblem& subproblem, std::span<const double> unknowns,
                  std::span<double> y);

  std::vector<Subproblem> subproblems_;  // in the order in which they are solved
};

/// The residual and Jacobian of a purely algebraic system on a smooth branch (Point::branch),
/// for NewtonSolver.
NonlinearFunction algebraic_function(const System& system, const ActiveSet* branch = nullptr);

}  // namespace gnomon
