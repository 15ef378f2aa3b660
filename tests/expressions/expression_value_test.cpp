// Values and gradients of expressions, against the same formulas in C++.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <functional>
#include <gnomon/expressions/expression.hpp>
#include <thread>

namespace gnomon::expression_value_test {
namespace {

using Complex = std::complex<double>;

const ExpressionNames names{.variables = {"p", "v", "s", "t"},
                            .constants = {{"k", 1e-3}, {"p0", 2.5}, {"a", 0.3}, {"s0", 7.0}},
                            .tables = {{"hardness", PiecewiseLinear({0, 1, 3}, {4, 2, 1})},
                                       {"level", PiecewiseLinear({0.5}, {6})}}};
constexpr double k = 1e-3, p0 = 2.5, a = 0.3, s0 = 7;

// Of the real part, so that the formulas can be differentiated by a complex step.
double real(double x) {
  return x;
}
double real(const Complex& x) {
  return x.real();
}
template <class T>
T largest(T x, T y) {
  return real(x) > real(y) ? x : y;
}
template <class T>
T smallest(T x, T y) {
  return real(x) < real(y) ? x : y;
}
template <class T>
T magnitude(T x) {
  return real(x) < 0 ? -x : x;
}
template <class T>
T hardness(T x) {
  if (real(x) < 0) return 4;
  if (real(x) < 1) return 4. - 2. * x;
  if (real(x) < 3) return 2. - 0.5 * (x - 1.);
  return 1;
}

struct Formula {
  std::string name, text, variables;  // variables that occur
  std::function<double(double, double, double, double)> real;
  std::function<Complex(Complex, Complex, Complex, Complex)> complex;
};

template <class F>
Formula formula(const char* name, const char* text, const char* variables, F f) {
  return {name, text, variables, f, f};
}

void PrintTo(const Formula& formula, std::ostream* stream) {
  *stream << formula.text;
}

class ExpressionFormula : public testing::TestWithParam<Formula> {
protected:
  const Expression expression_{GetParam().text, names};
  // Away from kinks, on both sides of most.
  const std::vector<std::vector<double>> points_ = {
      {1.7, 0.9, 2.3, 0.4}, {3.1, 1.6, 0.7, 1.8}, {0.6, 2.2, 5.9, 2.7}, {2.9, 0.3, 11., 0.85}};
};

TEST_P(ExpressionFormula, HasTheValue) {
  for (const auto& x : points_) {
    const double expected = GetParam().real(x[0], x[1], x[2], x[3]);
    EXPECT_NE(expected, 0);
    EXPECT_NEAR(expression_.value(x), expected, 4e-15 * std::abs(expected));
  }
}

TEST_P(ExpressionFormula, HasTheDerivativesOfAComplexStep) {
  for (const auto& x : points_) {
    std::vector<double> gradient(4, 99);
    EXPECT_EQ(expression_.value_and_gradient(x, gradient), expression_.value(x));
    for (std::size_t i = 0; i < 4; ++i) {
      std::vector<Complex> z(x.begin(), x.end());
      z[i] += Complex(0, 1e-40);
      const double expected = GetParam().complex(z[0], z[1], z[2], z[3]).imag() / 1e-40;
      EXPECT_NEAR(gradient[i], expected, 2e-14 * std::abs(expected)) << "by " << i;
    }
  }
}

TEST_P(ExpressionFormula, HasTheDerivativesOfDifferences) {
  std::vector<double> largest_derivative(4);
  for (const auto& x : points_) {
    std::vector<double> gradient(4);
    expression_.value_and_gradient(x, gradient);
    for (std::size_t i = 0; i < 4; ++i) {
      auto ahead = x, behind = x;
      ahead[i] += 1e-5;
      behind[i] -= 1e-5;
      const double difference = (expression_.value(ahead) - expression_.value(behind)) / 2e-5;
      EXPECT_NEAR(gradient[i], difference, 1e-7 * std::max(1e-3, std::abs(difference)));
      largest_derivative[i] = std::max(largest_derivative[i], std::abs(gradient[i]));
    }
  }
  for (std::size_t i = 0; i < 4; ++i) {
    const bool occurs = GetParam().variables.find("pvst"[i]) != std::string::npos;
    EXPECT_EQ(expression_.depends_on(i), occurs);
    EXPECT_EQ(largest_derivative[i] > 1e-6, occurs) << "by " << i;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, ExpressionFormula,
    testing::Values(
        formula("Archard", "k * p * v", "pv", [](auto p, auto v, auto, auto) { return k * p * v; }),
        formula("RunningIn", "k * (p/p0)^1.5 * (1 + a*exp(-s/s0)) * v", "pvs",
                [](auto p, auto v, auto s, auto) {
                  return k * std::pow(p / p0, 1.5) * (1. + a * std::exp(-s / s0)) * v;
                }),
        formula("Threshold", "k * max(p - 1, 0.1*p) * v", "pv",
                [](auto p, auto v, auto, auto) { return k * largest(p - 1., 0.1 * p) * v; }),
        formula("Table", "k*p*v/hardness(t)", "pvt",
                [](auto p, auto v, auto, auto t) { return k * p * v / hardness(t); }),
        formula("TableOfAFormula", "hardness(t*p/2)^2", "pt",
                [](auto p, auto, auto, auto t) { return std::pow(hardness(t * p / 2.), 2.); }),
        formula("Conditional", "if(p < 2 or v > 2 and s > 6, p*v, s/p)", "pvs",
                [](auto p, auto v, auto s, auto) {
                  return real(p) < 2 || (real(v) > 2 && real(s) > 6) ? p * v : s / p;
                }),
        formula("ConditionsInParentheses", "if((p < 2 or v > 2) and (s > 5), p*v, s/p)", "pvs",
                [](auto p, auto v, auto s, auto) {
                  return (real(p) < 2 || real(v) > 2) && real(s) > 5 ? p * v : s / p;
                }),
        formula("NestedConditionals", "if(p >= 2, if(v <= 1, p, p^2), if(s > 3, v*s, v*t))", "pvst",
                [](auto p, auto v, auto s, auto t) {
                  if (real(p) >= 2) return real(v) <= 1 ? p : p * p;
                  return real(s) > 3 ? v * s : v * t;
                }),
        formula("AllFunctions",
                "exp(-p) + log(1 + v) + sqrt(s) + sin(s) * cos(t) + pow(t, p) + abs(p - v)", "pvst",
                [](auto p, auto v, auto s, auto t) {
                  return std::exp(-p) + std::log(1. + v) + std::sqrt(s) +
                         std::sin(s) * std::cos(t) + std::pow(t, p) + magnitude(p - v);
                }),
        formula("ManyArguments", "min(p, v, s, t/2) * max(p, v, s, t)", "pvst",
                [](auto p, auto v, auto s, auto t) {
                  return smallest(smallest(p, v), smallest(s, t / 2.)) *
                         largest(largest(p, v), largest(s, t));
                }),
        formula("PowerOfTwoVariables", "p^v * 2^-s", "pvs",
                [](auto p, auto v, auto s, auto) {
                  return std::pow(p, v) * std::pow(decltype(s)(2), -s);
                }),
        formula("NegativeBase", "(-p)^3 - (p - 9)^2", "p",
                [](auto p, auto, auto, auto) { return -p * p * p - (p - 9.) * (p - 9.); }),
        formula("Quotients", "p/v/s - t/(p/v)", "pvst",
                [](auto p, auto v, auto s, auto t) { return p / (v * s) - t * v / p; }),
        formula("RepeatedVariables", "p*p*p + p - p*v + v/p - -p", "pv",
                [](auto p, auto v, auto, auto) { return p * p * p + 2. * p - p * v + v / p; }),
        formula("OneVariable", "t", "t", [](auto, auto, auto, auto t) { return t; }),
        formula("OneConstant", " 2e-9 ", "",
                [](auto p, auto, auto, auto) { return 2e-9 * (1. + p - p); })),
    [](const auto& info) { return info.param.name; });

struct Arithmetic {
  std::string text;
  double value;
};

void PrintTo(const Arithmetic& arithmetic, std::ostream* stream) {
  *stream << arithmetic.text;
}

class ExpressionPrecedence : public testing::TestWithParam<Arithmetic> {};

TEST_P(ExpressionPrecedence, OfConstants) {
  const Expression expression(GetParam().text, names);
  EXPECT_DOUBLE_EQ(expression.value(std::vector<double>(4)), GetParam().value);
  EXPECT_EQ(expression.kinks(), 0u);  // evaluated already
}

/// The same with each different number replaced by a variable.
TEST_P(ExpressionPrecedence, OfVariables) {
  std::string text = GetParam().text;
  for (char& c : text)
    if (c >= '2' && c <= '5') c = "pvst"[c - '2'];
  const Expression expression(text, names);
  EXPECT_DOUBLE_EQ(expression.value(std::vector<double>{2, 3, 4, 5}), GetParam().value);
}

INSTANTIATE_TEST_SUITE_P(
    All, ExpressionPrecedence,
    testing::Values(
        Arithmetic{"2 + 3 * 4", 14}, Arithmetic{"(2 + 3) * 4", 20}, Arithmetic{"2 - 3 - 4", -5},
        Arithmetic{"2 - (3 - 4)", 3}, Arithmetic{"2 / 4 / 5", 0.1}, Arithmetic{"2 / 4 * 5", 2.5},
        Arithmetic{"2 * 3 ^ 4", 162}, Arithmetic{"2 ^ 3 ^ 2", 512}, Arithmetic{"(2 ^ 3) ^ 2", 64},
        Arithmetic{"-2 ^ 4", -16}, Arithmetic{"(-2) ^ 4", 16}, Arithmetic{"2 ^ -3", 0.125},
        Arithmetic{"2 ^ -3 ^ 2", std::pow(2, -9)}, Arithmetic{"-2 * 3", -6},
        Arithmetic{"2 * -3 + 4", -2}, Arithmetic{"2 - -3", 5}, Arithmetic{"--2", 2},
        Arithmetic{"2--3^2", 11}, Arithmetic{"4/-2", -2}, Arithmetic{"if(2 + 3 < 2 * 3, 4, 5)", 4},
        Arithmetic{"if(2 < 3 or 2 > 3 and 4 > 5, 4, 5)", 4},
        Arithmetic{"if((2 < 3 or 2 > 3) and 4 > 5, 4, 5)", 5},
        Arithmetic{"if(2 > 3 and 3 > 2 or 4 < 5, 2, 3)", 2}, Arithmetic{"if(3 <= 3, 2, 4)", 2},
        Arithmetic{"if(3 < 3, 2, 4)", 4}, Arithmetic{"if(3 >= 3, 2, 4)", 2},
        Arithmetic{"if(3 > 3, 2, 4)", 4}, Arithmetic{"max(2, 5, 3) - min(4, 2, 3)", 3},
        Arithmetic{"pow(2, 3) + abs(-4) + sqrt(4)", 14}, Arithmetic{"abs(3 - 5) * max(-2, -3)", -4},
        Arithmetic{"hardness(2) + hardness(5) + level(3)", 8.5}));

TEST(Expression, ReadsNumbers) {
  for (const auto& [text, value] : std::vector<std::pair<std::string, double>>{
           {"1", 1},
           {"1.5", 1.5},
           {".5", 0.5},
           {"5.", 5},
           {"2e-9", 2e-9},
           {"2E+3", 2000},
           {"1e3", 1000},
           {"0", 0},
           {"007", 7},
           {"1.7976931348623157e308", 1.7976931348623157e308}})
    EXPECT_EQ(Expression(text, names).value(std::vector<double>(4)), value) << text;
}

TEST(Expression, TakesSpacesAndLines) {
  const std::vector<double> x = {2, 3, 4, 5};
  EXPECT_EQ(Expression("\t p\n  *\r\n v ", names).value(x), 6);
  EXPECT_EQ(Expression("p*v", names).value(x), 6);
}

TEST(Expression, KeepsItsTextWhenCopied) {
  const auto first = std::make_unique<Expression>("k * p*v", names);
  const Expression copy = *first;
  EXPECT_EQ(copy.text(), "k * p*v");
  EXPECT_EQ(copy.variables(), 4u);
  EXPECT_DOUBLE_EQ(copy.value(std::vector<double>{2, 3, 4, 5}), 6e-3);
}

TEST(Expression, OutlivesItsNames) {
  auto own = std::make_unique<ExpressionNames>(names);
  const Expression expression("k * hardness(t)", *own);
  own.reset();
  EXPECT_DOUBLE_EQ(expression.value(std::vector<double>{0, 0, 0, 2}), 1.5e-3);
}

TEST(Expression, DependsOnWhatStandsInConditionsOnly) {
  const Expression expression("if(v < 1, p, 2*p)", names);
  std::vector<double> gradient(4, 99);
  EXPECT_EQ(expression.value_and_gradient(std::vector<double>{3, 2, 1, 1}, gradient), 6);
  EXPECT_EQ(gradient, (std::vector<double>{2, 0, 0, 0}));
  EXPECT_TRUE(expression.depends_on(1));
  EXPECT_FALSE(expression.depends_on(2));
}

TEST(Expression, DoesNotDependOnWhatIsNeverTaken) {
  const Expression expression("if(k < 1, p, v) + if(k < 0 and v < 1 or s < 1, t, 2*t)", names);
  EXPECT_TRUE(expression.depends_on(0));
  EXPECT_FALSE(expression.depends_on(1));
  EXPECT_TRUE(expression.depends_on(2));
  EXPECT_EQ(expression.kinks(), 1u);
  EXPECT_EQ(expression.value(std::vector<double>{2, 7, 3, 5}), 12);
  EXPECT_EQ(expression.value(std::vector<double>{2, 7, 0, 5}), 7);
}

TEST(Expression, PowersOfZeroHaveTheirLimits) {
  const auto derivatives = [](const char* text) {
    std::vector<double> gradient(4);
    Expression(text, names).value_and_gradient(std::vector<double>{0, 2, 1, 1}, gradient);
    return std::vector<double>(gradient.begin(), gradient.begin() + 2);
  };
  EXPECT_EQ(derivatives("p^1.5"), (std::vector<double>{0, 0}));
  EXPECT_EQ(derivatives("p^1"), (std::vector<double>{1, 0}));
  EXPECT_EQ(derivatives("p^0"), (std::vector<double>{0, 0}));
  EXPECT_EQ(derivatives("p^v"), (std::vector<double>{0, 0}));
}

TEST(Expression, WhatHasNoInfluenceMayHaveNoSlope) {
  std::vector<double> gradient(4);
  const Expression expression("max(p, sqrt(p))", names);
  EXPECT_EQ(expression.value_and_gradient(std::vector<double>{0, 0, 0, 0}, gradient), 0);
  EXPECT_EQ(gradient[0], 1);
}

TEST(Expression, IsSharedByThreads) {
  const Expression expression("k * max(p, v)^1.5 * if(s < 100, hardness(t), s)", names);
  const auto sum = [&] {
    double result = 0;
    std::vector<double> gradient(4);
    for (int i = 0; i < 20000; ++i)
      result += expression.value_and_gradient(std::vector<double>{1, 0.01 * i, 0.02 * i, 1e-4 * i},
                                              gradient) +
                gradient[1];
    return result;
  };
  const double expected = sum();
  std::vector<double> sums(4);
  std::vector<std::thread> threads;
  for (double& result : sums) threads.emplace_back([&] { result = sum(); });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(sums, std::vector<double>(4, expected));
}

// A call on a number is replaced by its value, and what stands before it stays.
TEST(ExpressionValues, FunctionsOfNumbersLeaveWhatIsBeforeThem) {
  ExpressionNames names;
  names.variables = {"x"};
  const std::pair<const char*, double (*)(double)> functions[] = {
      {"exp", std::exp}, {"log", std::log}, {"sqrt", std::sqrt},
      {"sin", std::sin}, {"cos", std::cos}, {"abs", std::fabs}};
  for (const auto& [name, function] : functions) {
    const Expression rate(std::string("2 * ") + name + "(3) * x", names);
    const double x[] = {5};
    EXPECT_DOUBLE_EQ(rate.value(x), 2 * function(3) * 5) << name;
  }
}

}  // namespace
}  // namespace gnomon::expression_value_test
