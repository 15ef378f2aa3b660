// Where Newton's method by itself goes round between smooth branches of a system.
#pragma once

#include <gnomon/newton/newton.hpp>

namespace gnomon {

/// Solves an algebraic system on one smooth branch (Point::branch) after the other, from that of y,
/// until the solution lies in its own. All switches that disagree change while their number falls,
/// else the last of them alone, which cannot go round (Murty 1974; block principal pivoting of
/// Judice and Pires 1994). y is unspecified when the report says not converged.
NewtonReport solve_by_branches(NewtonSolver& newton, const System& system, std::span<double> y);

}  // namespace gnomon
