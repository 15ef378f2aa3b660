// Switching functions of expressions, and their smooth branches continued beyond the borders.

#include <gtest/gtest.h>

#include <cfenv>
#include <cmath>
#include <gnomon/expressions/expression.hpp>
#include <random>

namespace gnomon::expression_kink_test {
namespace {

const ExpressionNames names{.variables = {"x", "y", "z"},
                            .constants = {{"c", 2}},
                            .tables = {{"ramp", PiecewiseLinear({1, 2, 4}, {0, 3, 5})},
                                       {"straight", PiecewiseLinear({0, 1, 2, 3}, {1, 1, 2, 3})},
                                       {"level", PiecewiseLinear({1}, {5})}}};

using Numbers = std::vector<double>;
using Branches = std::vector<char>;

Expression parsed(const std::string& text) {
  return Expression(text, names);
}

Numbers switching(const Expression& expression, const Numbers& x, const Branches& branches = {}) {
  Numbers values(expression.kinks(), 99);
  expression.switching(x, values, branches);
  return values;
}

Numbers gradient(const Expression& expression, const Numbers& x, const Branches& branches = {}) {
  Numbers result(x.size(), 99);
  expression.value_and_gradient(x, result, branches);
  return result;
}

/// The branch that x lies in.
Branches branches_at(const Expression& expression, const Numbers& x) {
  Branches result;
  for (const double value : switching(expression, x)) result.push_back(value <= 0);
  return result;
}

TEST(ExpressionKinks, AreCounted) {
  EXPECT_EQ(parsed("x*y/z + exp(x)^2 - sqrt(y)").kinks(), 0u);
  EXPECT_EQ(parsed("abs(x)").kinks(), 1u);
  EXPECT_EQ(parsed("max(x, y)").kinks(), 1u);
  EXPECT_EQ(parsed("min(x, y, z, 1)").kinks(), 3u);
  EXPECT_EQ(parsed("if(x < 1, y, z)").kinks(), 1u);
  EXPECT_EQ(parsed("if(x < 1 and y > 2 or z <= 3, y, z)").kinks(), 3u);
  EXPECT_EQ(parsed("ramp(x)").kinks(), 3u);
  EXPECT_EQ(parsed("straight(x)").kinks(), 2u);  // the slope changes at 1 and 3 only
  EXPECT_EQ(parsed("level(x)").kinks(), 0u);
  EXPECT_EQ(parsed("ramp(x) + max(ramp(y), abs(z))").kinks(), 8u);
  EXPECT_EQ(parsed("max(1, c) + abs(-c) + ramp(c) + if(c < 1, max(x, y), x)").kinks(), 0u);
}

TEST(ExpressionKinks, HaveSwitchingFunctions) {
  const Numbers x = {3, 5, 7};
  EXPECT_EQ(switching(parsed("max(x, y)"), x), (Numbers{2}));
  EXPECT_EQ(switching(parsed("min(x, y)"), x), (Numbers{-2}));
  EXPECT_EQ(switching(parsed("abs(x - y)"), x), (Numbers{2}));
  EXPECT_EQ(switching(parsed("if(x < y, 1, 2)"), x), (Numbers{2}));
  EXPECT_EQ(switching(parsed("if(x <= y, 1, 2)"), x), (Numbers{-2}));
  EXPECT_EQ(switching(parsed("if(x > y, 1, 2)"), x), (Numbers{-2}));
  EXPECT_EQ(switching(parsed("if(x >= y, 1, 2)"), x), (Numbers{2}));
  EXPECT_EQ(switching(parsed("ramp(x)"), x), (Numbers{2, 1, -1}));
  EXPECT_EQ(switching(parsed("max(x, y, z)"), x), (Numbers{2, 2}));
  EXPECT_EQ(switching(parsed("max(ramp(x), abs(y))"), x), (Numbers{2, 1, -1, -5, 1}));
}

TEST(ExpressionKinks, TellWhatTheyDependOn) {
  const Expression expression = parsed("if(x < c, max(y, 1), ramp(y*z)) + z");
  ASSERT_EQ(expression.kinks(), 5u);
  const bool expected[5][3] = {{true, false, false},
                               {false, true, false},
                               {false, true, true},
                               {false, true, true},
                               {false, true, true}};
  for (std::size_t kink = 0; kink < 5; ++kink)
    for (std::size_t variable = 0; variable < 3; ++variable)
      EXPECT_EQ(expression.kink_depends_on(kink, variable), expected[kink][variable])
          << kink << " on " << variable;
}

TEST(ExpressionKinks, BordersBelongToTheActiveSide) {
  const Numbers equal = {1, 1, 0};
  EXPECT_EQ(gradient(parsed("max(2*x, 2*y)"), equal), (Numbers{2, 0, 0}));
  EXPECT_EQ(gradient(parsed("min(2*x, 2*y)"), equal), (Numbers{2, 0, 0}));
  EXPECT_EQ(gradient(parsed("abs(z)"), equal), (Numbers{0, 0, 1}));
  EXPECT_EQ(parsed("if(x < y, 3, 4)").value(equal), 4);
  EXPECT_EQ(parsed("if(x <= y, 3, 4)").value(equal), 3);
  EXPECT_EQ(parsed("if(x > y, 3, 4)").value(equal), 4);
  EXPECT_EQ(parsed("if(x >= y, 3, 4)").value(equal), 3);
  EXPECT_EQ(gradient(parsed("ramp(x)"), equal), (Numbers{0, 0, 0}));
  EXPECT_EQ(gradient(parsed("ramp(2*x)"), equal), (Numbers{6, 0, 0}));
  for (const char* text : {"max(x, y)", "min(x, y)", "abs(z)", "if(x < y, 3, 4)"})
    EXPECT_EQ(switching(parsed(text), equal), (Numbers{0})) << text;
}

TEST(ExpressionBranches, AreContinued) {
  const Numbers x = {3, 5, -7};
  const auto value = [&](const char* text, const Branches& branches) {
    return parsed(text).value(x, branches);
  };
  EXPECT_EQ(value("max(x, y)", {1}), 3);
  EXPECT_EQ(value("max(x, y)", {0}), 5);
  EXPECT_EQ(value("min(x, y)", {1}), 3);
  EXPECT_EQ(value("min(x, y)", {0}), 5);
  EXPECT_EQ(value("abs(z)", {1}), -7);
  EXPECT_EQ(value("abs(z)", {0}), 7);
  EXPECT_EQ(value("if(x < y, x, y)", {1}), 5);
  EXPECT_EQ(value("if(x < y, x, y)", {0}), 3);
  EXPECT_EQ(value("if(x <= y, x, y)", {1}), 3);
  EXPECT_EQ(value("if(x <= y, x, y)", {0}), 5);
  EXPECT_EQ(value("max(x, y, z)", {1, 0}), -7);
  EXPECT_EQ(value("if(x < y and y < 6, x, y)", {0, 1}), 5);
  EXPECT_EQ(value("if(x < y and y < 6, x, y)", {0, 0}), 3);
  EXPECT_EQ(value("if(x < y or y < 6, x, y)", {1, 0}), 3);
  EXPECT_EQ(value("if(x < y or y < 6, x, y)", {1, 1}), 5);
}

TEST(ExpressionBranches, OfTablesAreContinuedAlongTheirPieces) {
  const Expression expression = parsed("ramp(x)");
  const Numbers pieces[] = {{0, 0}, {-3, 3}, {1, 1}, {5, 0}};  // at 0 and slope
  const Branches branches[] = {{1, 1, 1}, {0, 1, 1}, {0, 0, 1}, {0, 0, 0}};
  for (std::size_t i = 0; i < 4; ++i)
    for (const double x : {-3., 0., 1.5, 3., 7.}) {
      EXPECT_DOUBLE_EQ(expression.value(Numbers{x, 0, 0}, branches[i]),
                       pieces[i][0] + pieces[i][1] * x);
      EXPECT_EQ(gradient(expression, {x, 0, 0}, branches[i]), (Numbers{pieces[i][1], 0, 0}));
    }
  EXPECT_DOUBLE_EQ(expression.value(Numbers{0, 0, 0}, Branches{1, 0, 1}), -3);  // one passed
}

TEST(ExpressionBranches, HaveGradientsOfTheirOwn) {
  const Numbers x = {3, 5, -7};
  EXPECT_EQ(gradient(parsed("max(2*x, y)"), x, {1}), (Numbers{2, 0, 0}));
  EXPECT_EQ(gradient(parsed("max(2*x, y)"), x, {0}), (Numbers{0, 1, 0}));
  EXPECT_EQ(gradient(parsed("abs(z)"), x, {1}), (Numbers{0, 0, 1}));
  EXPECT_EQ(gradient(parsed("abs(z)"), x, {0}), (Numbers{0, 0, -1}));
  EXPECT_EQ(gradient(parsed("if(x <= y, x*z, y*z)"), x, {1}), (Numbers{-7, 0, 3}));
  EXPECT_EQ(gradient(parsed("if(x <= y, x*z, y*z)"), x, {0}), (Numbers{0, -7, 5}));
}

TEST(ExpressionBranches, GoForTheSwitchingFunctionsToo) {
  const Expression expression = parsed("max(abs(x), y)");
  EXPECT_EQ(switching(expression, {-3, 1, 0}), (Numbers{3, -2}));
  EXPECT_EQ(switching(expression, {-3, 1, 0}, {1, 1}), (Numbers{3, 4}));  // abs(x) is x
}

const char* const kinked[] = {
    "max(x*y, z) * abs(x - z)",
    "if(x < y, min(x, z, y^2), max(ramp(y), z))",
    "if(x*x < y and z > ramp(x) or y > 2, x*z, abs(y - z)*x)",
    "ramp(x + ramp(y)) - straight(z*x)",
    "if(x < 1, if(y < 1, x, y), if(z < 1, z, x*y)) * max(x, y, z)",
};

/// At random points, the branch that a point lies in gives the same result as no prescribed branch.
TEST(ExpressionBranches, AgreeWithTheSigns) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1, 5);
  for (const char* text : kinked) {
    const Expression expression = parsed(text);
    std::vector<bool> active(expression.kinks()), inactive(expression.kinks());
    for (int i = 0; i < 200; ++i) {
      const Numbers x = {number(random), number(random), number(random)};
      const Branches branches = branches_at(expression, x);
      EXPECT_EQ(expression.value(x, branches), expression.value(x));
      EXPECT_EQ(gradient(expression, x, branches), gradient(expression, x));
      EXPECT_EQ(switching(expression, x, branches), switching(expression, x));
      for (std::size_t kink = 0; kink < branches.size(); ++kink)
        (branches[kink] ? active : inactive)[kink] = true;
    }
    EXPECT_EQ(active, std::vector<bool>(expression.kinks(), true)) << text;
    EXPECT_EQ(inactive, std::vector<bool>(expression.kinks(), true)) << text;
  }
}

/// On a given branch the gradient is continuous, across borders too.
TEST(ExpressionBranches, AreSmoothAcrossBorders) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> number(-1, 5);
  int borders = 0;
  for (const char* text : kinked) {
    const Expression expression = parsed(text);
    for (int i = 0; i < 50; ++i) {
      Numbers x = {number(random), number(random), number(random)};
      const Branches branches = branches_at(expression, x);
      Numbers before = gradient(expression, x, branches);
      for (int step = 0; step < 200; ++step) {
        x[0] += 0.01;
        x[1] -= 0.01;
        x[2] += 0.005;
        const Numbers now = gradient(expression, x, branches);
        // Products of few variables, whose slopes change by less in a step than at a kink.
        for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(now[j], before[j], 0.4) << text;
        borders += branches_at(expression, x) != branches;
        before = now;
      }
    }
  }
  EXPECT_GT(borders, 1000);
}

/// Where a switching function changes its sign, the chosen part changes.
TEST(ExpressionSwitching, ChangesItsSignWhereTheValueHasAKink) {
  const Expression expression = parsed("max(x, 2) + abs(x - 3) + ramp(x)");  // at 2, 3, 1, 2, 4
  const Numbers places = {2, 3, 1, 2, 4};
  for (std::size_t kink = 0; kink < 5; ++kink) {
    const double left = switching(expression, {places[kink] - 1e-9, 0, 0})[kink];
    const double right = switching(expression, {places[kink] + 1e-9, 0, 0})[kink];
    EXPECT_LT(left * right, 0) << kink;
    EXPECT_EQ(switching(expression, {places[kink], 0, 0})[kink], 0);
    EXPECT_NE(gradient(expression, {places[kink] - 1e-9, 0, 0}),
              gradient(expression, {places[kink] + 1e-9, 0, 0}));
  }
}

TEST(ExpressionSwitching, IsFiniteInPartsThatAreNotTaken) {
  const Expression guarded = parsed("if(x > 0, max(log(x), -1), ramp(1/x))");
  EXPECT_EQ(guarded.kinks(), 5u);
  EXPECT_EQ(switching(guarded, {-1, 0, 0}), (Numbers{-1, 1, -2, -3, -5}));
  EXPECT_EQ(switching(guarded, {-1, 0, 0}, {1, 1, 1, 1, 1}), (Numbers{-1, -1, -2, -3, -5}));
  EXPECT_EQ(switching(guarded, {-1, 0, 0}, {1, 0, 1, 1, 1}), (Numbers{-1, 1, -2, -3, -5}));
  EXPECT_EQ(switching(guarded, {1, 0, 0}), (Numbers{1, -1, 0, -1, -3}));
  const Expression joined = parsed("if(x > 0 and log(x) < 1, 1, 2)");
  EXPECT_EQ(switching(joined, {-1, 0, 0}), (Numbers{-1, 1}));
  EXPECT_EQ(joined.value(Numbers{-1, 0, 0}), 2);
  const Expression either = parsed("if(x <= 0 or log(x) < 1, 1, 2)");
  EXPECT_EQ(switching(either, {-1, 0, 0}), (Numbers{-1, 1}));
  EXPECT_EQ(either.value(Numbers{-1, 0, 0}), 1);
}

TEST(ExpressionSwitching, DoesNotTrapInPartsThatAreNotTaken) {
  const Expression expression = parsed("if(x > 0, log(x), 1/(x - 1))");
  std::feclearexcept(FE_ALL_EXCEPT);
  EXPECT_EQ(switching(expression, {-1, 0, 0}), (Numbers{-1}));
  EXPECT_EQ(expression.value(Numbers{-1, 0, 0}), -0.5);
  EXPECT_EQ(gradient(expression, {-1, 0, 0}), (Numbers{-0.25, 0, 0}));
  EXPECT_EQ(std::fetestexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW), 0);
}

class UndefinedExpression : public testing::Test {
protected:
  UndefinedExpression() { std::feholdexcept(&before_); }  // GNOMON_TRAP
  ~UndefinedExpression() override { std::fesetenv(&before_); }

private:
  std::fenv_t before_;
};

TEST_F(UndefinedExpression, IsNotANumber) {
  const Numbers x = {-1, 2, 3};
  for (const char* text :
       {"log(x)", "max(log(x), y)", "max(y, log(x))", "min(y, sqrt(x))", "abs(log(x))",
        "ramp(log(x))", "level(log(x))", "if(log(x) < 1, y, z)", "if(log(x) >= 1, y, z)",
        "if(log(x) < 1 and y < 5, y, z)", "if(y < 5 and log(x) < 1, y, z)",
        "if(log(x) < 1 or y < 5, y, z)", "x^0.5"}) {
    EXPECT_TRUE(std::isnan(parsed(text).value(x))) << text;
    EXPECT_FALSE(std::isnan(parsed(text).value(Numbers{1, 2, 3}))) << text;
  }
}

TEST_F(UndefinedExpression, ShowsInTheSwitchingOfWhatIsTaken) {
  EXPECT_TRUE(std::isnan(switching(parsed("if(y < 5, max(log(x), z), z)"), {-1, 2, 3})[1]));
  EXPECT_EQ(switching(parsed("if(y > 5, max(log(x), z), z)"), {-1, 2, 3})[1], 1);
}

TEST_F(UndefinedExpression, HidesBehindAGivenBranch) {
  EXPECT_EQ(parsed("max(y, log(x))").value(Numbers{-1, 2, 3}, Branches{1}), 2);
  EXPECT_EQ(gradient(parsed("max(y, log(x))"), {-1, 2, 3}, {1}), (Numbers{0, 1, 0}));
}

TEST(PiecewiseLinearTable, GoesThroughItsPoints) {
  const Numbers x = {-2, 0, 0.5, 3}, y = {1, 4, 4, -1};
  const PiecewiseLinear table(x, y);
  const auto breakpoints = table.breakpoints();
  EXPECT_EQ(Numbers(breakpoints.begin(), breakpoints.end()), x);
  const auto value = [&](double at) { return table.value(table.piece_at(at), at); };
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_DOUBLE_EQ(value(x[i]), y[i]);
  EXPECT_DOUBLE_EQ(value(-1), 2.5);
  EXPECT_DOUBLE_EQ(value(0.25), 4);
  EXPECT_DOUBLE_EQ(value(1.75), 1.5);
  EXPECT_EQ(value(-100), 1);
  EXPECT_DOUBLE_EQ(value(100), -1);
  EXPECT_EQ(table.slope(1), 1.5);
  EXPECT_EQ(table.slope(4), 0);
}

// The first value holds up to the jump, the second beyond it; also where both sides have one slope,
// and at the ends.
TEST(PiecewiseLinearTable, JumpsWhereItHasTwoValues) {
  const PiecewiseLinear table({-1, -1, 0, 2, 2, 3, 3}, {7, 1, 1, 1, 4, 5, 6});
  const auto breakpoints = table.breakpoints();
  EXPECT_EQ(Numbers(breakpoints.begin(), breakpoints.end()), (Numbers{-1, 2, 3}));
  const auto value = [&](double at) { return table.value(table.piece_at(at), at); };
  EXPECT_EQ(value(-5), 7);
  EXPECT_EQ(value(-1), 7);
  EXPECT_EQ(value(-0.5), 1);
  EXPECT_EQ(value(2), 1);
  EXPECT_NEAR(value(2 + 1e-12), 4, 1e-11);
  EXPECT_DOUBLE_EQ(value(2.5), 4.5);
  EXPECT_EQ(value(3.5), 6);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(table.jumps_at(i));
  EXPECT_FALSE(PiecewiseLinear({0, 1}, {1, 3}).jumps_at(0));
}

TEST(KinksOfAnExpression, MayJumpAtComparisonsAndJumpsOfTablesOnly) {
  ExpressionNames own;
  own.variables = {"x"};
  own.tables.emplace("step", PiecewiseLinear({0, 1, 1, 2}, {0, 0, 5, 6}));
  const Expression expression("max(x, 0) + abs(x) + if(x < 3, 1, 2) + step(x)", own);
  ASSERT_EQ(expression.kinks(), 5);
  std::vector<bool> jumps;
  for (std::size_t i = 0; i < 5; ++i) jumps.push_back(expression.kink_may_jump(i));
  EXPECT_EQ(jumps, (std::vector<bool>{false, false, true, true, false}));
}

TEST(ExpressionLanguage, HasPi) {
  ExpressionNames own;
  own.variables = {"x"};
  EXPECT_DOUBLE_EQ(Expression("cos(pi * x)", own).value(Numbers{1}), -1);
}

}  // namespace
}  // namespace gnomon::expression_kink_test
