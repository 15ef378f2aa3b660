// The rates of a consistent state.
#pragma once

#include <gnomon/integrators/error_norm.hpp>
#include <gnomon/system/state.hpp>
#include <optional>

namespace gnomon {

/// Rates of the differential components on a smooth branch (Point::branch): every differential row
/// is ydot + f(t, y) = 0, so they are minus the row at ydot = 0. Fills ydot, zero elsewhere.
/// At a time where a rate jumps, `within` says from which side it is meant (Point::within); absent:
/// from later times.
void set_rates(const System& system, const ActiveSet* branch, State& state,
               std::optional<double> within = {});

/// Norm of the difference of the rates of two y at the time of `at`, weighted as there [1/time].
double distance_of_rates(const System& system, const ErrorNorm& norm, const ActiveSet* branch,
                         const State& at, std::span<const double> a, std::span<const double> b,
                         std::optional<double> within = {});

/// Gives the state the rates after a jump at its time or at an event, and returns true. Where they
/// do not jump, those of the step that ended there stay to the last digit.
bool set_rates_behind_jump(const System& system, const ActiveSet* branch, State& state);

}  // namespace gnomon
