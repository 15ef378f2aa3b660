#include <cmath>
#include <gnomon/expressions/expression.hpp>
#include <limits>

#include "fuzz/targets.hpp"

namespace gnomon::fuzz {

namespace {

using Numbers = std::vector<double>;
using Branches = std::vector<char>;

const ExpressionNames& names() {
  static const ExpressionNames result{
      .variables = {"p", "v", "s", "t"},
      .constants = {{"k", 1e-3}, {"p0", 2.5}, {"zero", 0}, {"huge", 1e300}},
      .tables = {{"hardness", PiecewiseLinear({0, 1, 3}, {4, 2, 1})},
                 {"level", PiecewiseLinear({0.5}, {6})}}};
  return result;
}

bool same(double a, double b) {
  return a == b || (std::isnan(a) && std::isnan(b));
}

void expect_sound(const Expression& expression, const Numbers& x, const Branches& branches) {
  Numbers gradient(x.size(), 99);
  const double value = expression.value_and_gradient(x, gradient, branches);
  demand(same(value, expression.value(x, branches)), "the value comes with the gradient");
  for (std::size_t i = 0; i < x.size(); ++i)
    demand(expression.depends_on(i) || gradient[i] == 0,
           "there is no derivative by what does not occur");
  Numbers values(expression.kinks());
  expression.switching(x, values, branches);
}

/// Where all switching functions are finite, the branch from their signs gives the same result as
/// no prescribed branch.
void expect_branch_by_signs(const Expression& expression, const Numbers& x) {
  Numbers values(expression.kinks()), again(expression.kinks());
  expression.switching(x, values);
  Branches branches;
  for (const double value : values) {
    if (!std::isfinite(value)) return;
    branches.push_back(value <= 0);
  }
  demand(same(expression.value(x), expression.value(x, branches)), "signs choose the branch");
  expression.switching(x, again, branches);
  for (std::size_t kink = 0; kink < values.size(); ++kink)
    demand(branches[kink] == (again[kink] <= 0), "a branch has the signs that it was chosen by");
}

}  // namespace

void expression(std::string_view bytes) {
  const Expression expression(std::string(bytes), names());
  demand(expression.text() == bytes, "an expression keeps its text");
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const Numbers points[] = {{1.7, 0.9, 2.3, 0.4},
                            {0, 0, 0, 0},
                            {-1, 2, -0.5, 3},
                            {1, 1, 1, 1},
                            {1e200, -1e200, 1e-300, 5e-324},
                            {infinity, -infinity, std::nan(""), -0.}};
  for (const Numbers& x : points) {
    expect_sound(expression, x, {});
    expect_branch_by_signs(expression, x);
    Branches branches(expression.kinks());
    for (unsigned pattern : {0u, ~0u, 0x5a5a5a5au, 0x13579bdfu}) {
      for (std::size_t kink = 0; kink < branches.size(); ++kink)
        branches[kink] = pattern >> kink % 32 & 1;
      expect_sound(expression, x, branches);
    }
  }
}

}  // namespace gnomon::fuzz
