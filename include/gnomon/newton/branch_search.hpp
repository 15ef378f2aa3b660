// Where Newton's method by itself goes round between smooth branches of a system.
#pragma once

#include <gnomon/newton/newton.hpp>

namespace gnomon {

/// Solves an algebraic system on one smooth branch (Point::branch) after the other, from that of y,
/// until the solution lies in its own. All switches that disagree change while their number falls
/// within three changes, else the last of them alone: block principal pivoting of Judice and Pires
/// 1994. It ends for linear complementarity with P-matrices (Murty 1974), and else after 200
/// branches. y is unspecified when the report says not converged.
NewtonReport solve_by_branches(NewtonSolver& newton, const System& system, std::span<double> y);

}  // namespace gnomon
