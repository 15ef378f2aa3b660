// Where functions of time change sign.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace gnomon {

/// The values of several functions at a time.
using TimeFunctions = std::function<void(double t, std::span<double> values)>;

/// Times in (0, end], ascending, at which one of `which` of the `count` functions changes its sign.
/// Looked for among two thousand equal parts, and around every minimum of a magnitude, so that a
/// function that is of another sign for a short time only is found. A jump has the side with the
/// smaller magnitude.
std::vector<double> sign_changes(const TimeFunctions& functions, std::size_t count,
                                 const std::vector<std::size_t>& which, double end);

}  // namespace gnomon
