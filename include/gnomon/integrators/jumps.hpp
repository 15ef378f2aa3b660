// Steps over jumps: of rates, where a switching function changes its sign (a wear law with a jump
// in the depth), and of loads, at a breakpoint in time.
#pragma once

#include <gnomon/base/counters.hpp>
#include <gnomon/integrators/error_norm.hpp>
#include <gnomon/system/state.hpp>
#include <vector>

namespace gnomon {

/// What a step has crossed (Structure::switch_jumps).
struct CrossedJumps {
  std::vector<std::size_t> functions;  ///< the switching functions that changed their sign
  double first = 1;             ///< part of the step after which the first of them did, by a line
  std::vector<double> by = {};  ///< jumps of the rate of each unknown, at the end of the step: sums
  std::vector<double> before = {};  ///< values of the switching functions at the start
};

/// The largest jump that a rate makes at both states by one switching function, as the smaller of
/// the two. Of a condition on both sides of which rates are the same, as if(p > p0, p - p0, 0), the
/// branches differ at the two states with unlike signs: it does not jump. Throws RecoverableError
/// where a rate has no value.
double common_jump(const System& system, const State& from, const State& to, std::size_t function);

/// The jumps between two states, `by` only if `size` is wanted.
CrossedJumps jumps_between(const System& system, const State& from, const State& to, bool size);

/// The part of the error of a step that comes from jumps in it.
struct JumpError {
  double error = 0;    ///< 1 being the tolerance, as ErrorNorm
  double shorter = 0;  ///< if it is more: the size to try next, up to the jump or over it
};
/// Of a step of size h that evaluates rates at both states. They are wrong in a part of the step,
/// which is taken for half of it. Steps that follow the error become short there, and no shorter
/// than the tolerance asks for.
JumpError error_of_jumps(const System& system, const ErrorNorm& norm, const State& from,
                         const State& to, double h);

/// Makes a state at a breakpoint that of later times: where loads jump there, its algebraic
/// components are solved for again, on the branch that they lie in, or by settings.behind_jump;
/// where rates do, they are set. Returns whether something has changed. Throws SolutionError.
bool pass_breakpoint(const System& system, const IntegratorSettings& settings, Counters& counters,
                     const ActiveSet* branch, State& state);

}  // namespace gnomon
