// The tables that expressions call.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/untrapped_arithmetic.hpp"
#include "expressions/expression_program.hpp"

namespace gnomon {

namespace {

void check_points(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() != y.size())
    throw ExpressionError(fmt::format(
        "a table has {} abscissae and {} values, expected as many of both", x.size(), y.size()));
  if (x.empty()) throw ExpressionError("a table has no points, expected at least one");
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!std::isfinite(x[i]) || !std::isfinite(y[i]))
      throw ExpressionError(fmt::format("point {} of a table is ({}, {}), expected finite numbers",
                                        i + 1, x[i], y[i]));
    const bool jumps = i > 0 && x[i - 1] == x[i] && !(i > 1 && x[i - 2] == x[i]);
    if (i > 0 && !(x[i - 1] < x[i]) && !jumps)
      throw ExpressionError(fmt::format(
          "abscissa {} of a table is {}, expected more than {}, or the same once for a jump", i + 1,
          x[i], x[i - 1]));
  }
}

}  // namespace

PiecewiseLinear::PiecewiseLinear(const std::vector<double>& x, const std::vector<double>& y) {
  check_points(x, y);
  const UntrappedArithmetic untrapped;
  pieces_.push_back({x[0], y[0], 0});
  for (std::size_t i = 0; i < x.size(); ++i) {
    const bool last = i + 1 == x.size();
    if (!last && x[i] == x[i + 1]) continue;  // a jump
    const double width = last ? 1 : x[i + 1] - x[i];
    const double slope = last ? 0 : (y[i + 1] - y[i]) / width;
    if (!std::isfinite(width) || !std::isfinite(slope))
      throw ExpressionError(
          fmt::format("a table is too wide or too steep between {} and {}", x[i], x[i + 1]));
    const bool jumps = i > 0 && x[i - 1] == x[i] && y[i - 1] != y[i];
    if (slope == pieces_.back().slope && !jumps) continue;
    breakpoints_.push_back(x[i]);
    pieces_.push_back({x[i], y[i], slope});
  }
}

std::size_t PiecewiseLinear::piece_at(double x) const {
  const auto first_not_passed = std::lower_bound(breakpoints_.begin(), breakpoints_.end(), x);
  return static_cast<std::size_t>(first_not_passed - breakpoints_.begin());
}

}  // namespace gnomon
