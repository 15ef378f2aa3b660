// Every kind of mistake in an expression, in its names and in its tables.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <gnomon/expressions/expression.hpp>
#include <limits>

namespace gnomon::expression_error_test {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const ExpressionNames names{.variables = {"p", "v", "slip"},
                            .constants = {{"k", 1e-3}, {"zero", 0}},
                            .tables = {{"hardness", PiecewiseLinear({0, 1}, {2, 1})}}};

template <class F>
std::string complaint(const F& f) {
  try {
    f();
  } catch (const ExpressionError& error) {
    return error.what();
  }
  return "no complaint";
}

std::string complaint_of_text(const std::string& text) {
  return complaint([&] { Expression(text, names); });
}

const std::string end_of_text = ", got the end of the text";
const std::string start = "expected a number, a name or \"(\", got ";
const std::string rest = "expected an operator or the end of the text, got ";
const std::string one_more_argument = "expected \")\" or \",\" in the arguments of ";
const std::string known_names =
    "there are the variables p, v, slip; constants k, zero; tables hardness; functions exp, log, "
    "sqrt, sin, cos, abs, pow, min, max, if";

struct Mistake {
  std::string text, message;
};

void PrintTo(const Mistake& mistake, std::ostream* stream) {
  *stream << mistake.text;
}

class BadExpression : public testing::TestWithParam<Mistake> {};

TEST_P(BadExpression, IsRefusedInOneLine) {
  const std::string message = complaint_of_text(GetParam().text);
  EXPECT_EQ(message, GetParam().message);
  EXPECT_EQ(message.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Ends, BadExpression,
    testing::Values(
        Mistake{"", "column 1: " + start + "the end of the text"},
        Mistake{"   ", "column 4: " + start + "the end of the text"},
        Mistake{"k * p *", "column 8: " + start + "the end of the text"},
        Mistake{"-", "column 2: " + start + "the end of the text"},
        Mistake{"p ^", "column 4: " + start + "the end of the text"},
        Mistake{"(p", "column 3: expected \")\" to close the parenthesis" + end_of_text},
        Mistake{"(p, v)", "column 3: expected \")\" to close the parenthesis, got \",\""},
        Mistake{"()", "column 2: " + start + "\")\""},
        Mistake{"p)",
                "column 2: \")\" closes nothing, expected an operator or the end of the text"},
        Mistake{"p, v", "column 2: " + rest + "\",\""},
        Mistake{"2 p", "column 3: " + rest + "\"p\" (a product is written a * b)"},
        Mistake{"p 2", "column 3: " + rest + "\"2\" (a product is written a * b)"},
        Mistake{"(p)(v)", "column 4: " + rest + "\"(\""},
        Mistake{"k * p v", "column 7: " + rest + "\"v\" (a product is written a * b)"},
        Mistake{"* p", "column 1: " + start + "\"*\""},
        Mistake{"p + + v", "column 5: " + start + "\"+\""},
        Mistake{"p and", "column 1: \"p\" is a number, expected a condition such as a < b"},
        Mistake{"and p", "column 1: " + start + "\"and\""}));

INSTANTIATE_TEST_SUITE_P(
    Symbols, BadExpression,
    testing::Values(
        Mistake{"p ** 2", "column 3: unknown symbol \"**\", expected ^ for a power"},
        Mistake{"if(p == 1, 1, 2)", "column 6: unknown symbol \"==\", expected <, <=, > or >="},
        Mistake{"if(p = 1, 1, 2)", "column 6: unknown symbol \"=\", expected <, <=, > or >="},
        Mistake{"if(p != 1, 1, 2)", "column 6: unknown symbol \"!=\", expected <, <=, > or >="},
        Mistake{"if(p < 1 && v < 1, 1, 2)", "column 10: unknown symbol \"&&\", expected and"},
        Mistake{"if(p < 1 || v < 1, 1, 2)", "column 10: unknown symbol \"||\", expected or"},
        Mistake{"k % p",
                "column 3: \"%\" has no meaning in an expression, expected a number, a "
                "name or one of + - * / ^ ( ) , < <= > >="},
        Mistake{"k * µ",
                "column 5: \"µ\" has no meaning in an expression, expected a number, a "
                "name or one of + - * / ^ ( ) , < <= > >="},
        Mistake{std::string("k\0", 2),
                "column 2: \"\\u0000\" has no meaning in an expression, expected a number, a name "
                "or one of + - * / ^ ( ) , < <= > >="}));

INSTANTIATE_TEST_SUITE_P(
    Numbers, BadExpression,
    testing::Values(
        Mistake{"1.5.2",
                "column 1: \"1.5.2\" is not a number, expected one such as 2, 0.5 or "
                "2e-9"},
        Mistake{"p * 2e", "column 5: \"2e\" is not a number, expected one such as 2, 0.5 or 2e-9"},
        Mistake{"2e-", "column 1: \"2e-\" is not a number, expected one such as 2, 0.5 or 2e-9"},
        Mistake{"2p", "column 1: \"2p\" is not a number, expected one such as 2, 0.5 or 2e-9"},
        Mistake{"0x10", "column 1: \"0x10\" is not a number, expected one such as 2, 0.5 or 2e-9"},
        Mistake{"1_000",
                "column 1: \"1_000\" is not a number, expected one such as 2, 0.5 or "
                "2e-9"},
        Mistake{".", "column 1: \".\" is not a number, expected one such as 2, 0.5 or 2e-9"},
        Mistake{"1e400 * p",
                "column 1: \"1e400\" is too large or too small, expected 1e-307 to 1e308 or 0"},
        Mistake{"p + 1e-400",
                "column 5: \"1e-400\" is too large or too small, expected 1e-307 to 1e308 or 0"},
        Mistake{"p + 1 / 0", "column 5: \"1 / 0\" is inf, expected a finite number"},
        Mistake{"p / log(zero)", "column 5: \"log(zero)\" is -inf, expected a finite number"},
        Mistake{"pow(0, -1)", "column 1: \"pow(0, -1)\" is inf, expected a finite number"},
        Mistake{"1e200 * 1e200", "column 1: \"1e200 * 1e200\" is inf, expected a finite number"},
        Mistake{"if(p < 1, p, exp(1000))",
                "column 14: \"exp(1000)\" is inf, expected a finite number"}));

INSTANTIATE_TEST_SUITE_P(
    Names, BadExpression,
    testing::Values(
        Mistake{"k * slp", "column 5: unknown name \"slp\", did you mean \"slip\"? " + known_names},
        Mistake{"hardnes(p)",
                "column 1: unknown name \"hardnes\", did you mean \"hardness\"? " + known_names},
        Mistake{"sqr(p)", "column 1: unknown name \"sqr\", did you mean \"sqrt\"? " + known_names},
        Mistake{"p * temperature", "column 5: unknown name \"temperature\", " + known_names},
        Mistake{"nan", "column 1: unknown name \"nan\", " + known_names},
        Mistake{"p(2)",
                "column 1: \"p\" is not a function or table, expected an operator after it, "
                "got \"(\" (a product is written a * b)"},
        Mistake{"k (p + v)",
                "column 1: \"k\" is not a function or table, expected an operator after it, got "
                "\"(\" (a product is written a * b)"},
        Mistake{"exp + 1", "column 5: expected \"(\" after \"exp\", got \"+\""},
        Mistake{"k / hardness", "column 13: expected \"(\" after \"hardness\"" + end_of_text},
        Mistake{"if", "column 3: expected \"(\" after \"if\"" + end_of_text}));

INSTANTIATE_TEST_SUITE_P(
    Arguments, BadExpression,
    testing::Values(
        Mistake{"exp()", "column 1: \"exp\" takes 1 argument, got 0"},
        Mistake{"p + exp(p, v)", "column 5: \"exp\" takes 1 argument, got 2"},
        Mistake{"pow(p)", "column 1: \"pow\" takes 2 arguments, got 1"},
        Mistake{"pow(p, 1, 2)", "column 1: \"pow\" takes 2 arguments, got 3"},
        Mistake{"max(p)", "column 1: \"max\" takes at least 2 arguments, got 1"},
        Mistake{"min()", "column 1: \"min\" takes at least 2 arguments, got 0"},
        Mistake{"hardness(p, v)", "column 1: \"hardness\" takes 1 argument, got 2"},
        Mistake{"max(p, )", "column 8: " + start + "\")\""},
        Mistake{"max(p v)", "column 7: " + one_more_argument + "\"max\", got \"v\""},
        Mistake{"max(p, v", "column 9: " + one_more_argument + "\"max\"" + end_of_text},
        Mistake{"if(p < 1, p)", "column 12: expected \",\" in if(condition, a, b), got \")\""},
        Mistake{"if(p < 1)", "column 9: expected \",\" in if(condition, a, b), got \")\""},
        Mistake{"if(p < 1, p, v, 1)",
                "column 15: expected \")\" in if(condition, a, b), got \",\""}));

INSTANTIATE_TEST_SUITE_P(
    Conditions, BadExpression,
    testing::Values(
        Mistake{"p < 1",
                "column 1: \"p < 1\" is a condition, expected a number (conditions occur in "
                "if(condition, a, b) only)"},
        Mistake{"2 * (p < 1)",
                "column 5: \"(p < 1)\" is a condition, expected a number (conditions occur in "
                "if(condition, a, b) only)"},
        Mistake{"(p < 1) * 2",
                "column 1: \"(p < 1)\" is a condition, expected a number (conditions occur in "
                "if(condition, a, b) only)"},
        Mistake{"-(p < 1)",
                "column 2: \"(p < 1)\" is a condition, expected a number (conditions occur in "
                "if(condition, a, b) only)"},
        Mistake{"exp(p < 1)",
                "column 5: \"p < 1\" is a condition, expected a number (conditions occur in "
                "if(condition, a, b) only)"},
        Mistake{"if(p, 1, 2)", "column 4: \"p\" is a number, expected a condition such as a < b"},
        Mistake{"if(p < 1 and v, 1, 2)",
                "column 14: \"v\" is a number, expected a condition such as a < b"},
        Mistake{"if(p < 1, v < 1, 2)",
                "column 11: \"v < 1\" is a condition, expected a number "
                "(conditions occur in if(condition, a, b) only)"},
        Mistake{"if(0 < p < 1, 1, 2)",
                "column 10: comparisons cannot be chained, expected \"and\" "
                "as in a < b and b < c, got \"<\""},
        Mistake{"if((p < 1) < v, 1, 2)",
                "column 4: \"(p < 1)\" is a condition, expected a number (conditions occur in "
                "if(condition, a, b) only)"},
        Mistake{"if(p < 1 or 2 or v < 1, 1, 2)",
                "column 13: \"2\" is a number, expected a condition such as a < b"}));

TEST(BadExpressionText, OfSeveralLinesNamesTheLine) {
  EXPECT_EQ(complaint_of_text("k\n  * p\n  * w"),
            "line 3, column 5: unknown name \"w\", " + known_names);
  EXPECT_THAT(complaint_of_text("k *\n"), StartsWith("line 2, column 1: expected"));
}

TEST(BadExpressionText, CountsCharactersNotBytes) {
  EXPECT_THAT(complaint_of_text("(\xc2\xb5)"), StartsWith("column 2: \"\xc2\xb5\" has no meaning"));
  EXPECT_THAT(complaint_of_text("k\xff + p"), StartsWith("column 2: "));
}

TEST(BadExpressionText, IsQuotedInPart) {
  const std::string message = complaint_of_text("1/0" + std::string(100, ' ') + "");
  EXPECT_THAT(message, HasSubstr("\"1/0\" is inf"));
  EXPECT_EQ(complaint_of_text("2 * " + std::string(60, '9') + "x"),
            "column 5: \"" + std::string(40, '9') +
                "\"... is not a number, expected one such as 2, 0.5 or 2e-9");
}

std::string repeated(const std::string& part, int count) {
  std::string text;
  for (int i = 0; i < count; ++i) text += part;
  return text;
}

struct Nest {
  const char* name;
  std::string open, inside, close;
  int most;  // largest accepted number of them
};

void PrintTo(const Nest& nest, std::ostream* stream) {
  *stream << nest.name;
}

class DeepExpression : public testing::TestWithParam<Nest> {
protected:
  static std::string text(int count) {
    const Nest& nest = GetParam();
    return repeated(nest.open, count) + nest.inside + repeated(nest.close, count);
  }
};

TEST_P(DeepExpression, IsTakenToTheLimit) {
  const Expression expression(text(GetParam().most), names);
  EXPECT_TRUE(std::isfinite(expression.value(std::vector<double>{0.5, 0.5, 0.5})));
  const std::string message = complaint_of_text(text(GetParam().most + 1));
  EXPECT_THAT(message, HasSubstr("nested more than 64 deep, expected at most 64"));
  EXPECT_THAT(complaint_of_text(repeated(GetParam().open, 100)), HasSubstr("nested more than 64"));
}

INSTANTIATE_TEST_SUITE_P(Kinds, DeepExpression,
                         testing::Values(Nest{"Parentheses", "(", "p", ")", 63},
                                         Nest{"Signs", "-", "p", "", 63},
                                         Nest{"Calls", "exp(-", "p", ")", 31},
                                         Nest{"Powers", "p^", "v", "", 63},
                                         Nest{"Tables", "hardness(", "p", ")", 63},
                                         Nest{"Conditions", "if(p<1,", "p", ",v)", 63}),
                         [](const auto& info) { return info.param.name; });

TEST(LongExpression, IsTakenToTheLimit) {
  const std::string longest = fmt::format("p{} ", repeated("-p", 499));
  ASSERT_EQ(longest.size(), Expression::max_length);
  const Expression expression(longest, names);
  std::vector<double> gradient(3);
  EXPECT_EQ(expression.value_and_gradient(std::vector<double>{1, 1, 1}, gradient), -498);
  EXPECT_EQ(gradient[0], -498);
  EXPECT_EQ(complaint_of_text(longest + " "),
            "an expression has 1001 bytes, expected at most 1000");
}

/// The texts with the most instructions per byte.
TEST(LongExpression, HasRoomForAllKindsOfParts) {
  for (const char* part : {"+if(p<v,p,v)", "*-p", "+abs(p)", "+max(p,v,p,v)",
                           "+if(p<v or(p<v)or(v<p),p,v)", "+if(p<v and(p<v)and(v<p),p,v)"}) {
    const int count = static_cast<int>((Expression::max_length - 1) / std::string(part).size());
    std::string text = repeated(part, count);
    text[0] = ' ';
    const Expression expression(text, names);
    std::vector<double> gradient(3), values(expression.kinks());
    expression.switching(std::vector<double>{0.5, 0.7, 0}, values);
    EXPECT_NE(expression.value_and_gradient(std::vector<double>{0.5, 0.7, 0}, gradient), 0) << part;
  }
}

std::string complaint_of_names(const ExpressionNames& bad) {
  return complaint([&] { Expression("1", bad); });
}

TEST(BadExpressionNames, AreRefused) {
  const PiecewiseLinear table({0}, {1});
  const double infinity = std::numeric_limits<double>::infinity();
  for (const char* name : {"", "2p", "p q", "a.b", "\xc2\xb5", "p-q"})
    EXPECT_THAT(complaint_of_names({{"v", name}, {}, {}}),
                HasSubstr("cannot stand in an expression"))
        << name;
  for (const char* name :
       {"exp", "log", "sqrt", "sin", "cos", "abs", "pow", "min", "max", "if", "and", "or"})
    EXPECT_THAT(complaint_of_names({{}, {{name, 1}}, {}}), HasSubstr("is reserved in expressions"));
  EXPECT_EQ(complaint_of_names({{"p", "v", "p"}, {}, {}}),
            "the name \"p\" is declared twice, expected distinct names");
  EXPECT_THAT(complaint_of_names({{"p"}, {{"p", 1}}, {}}), HasSubstr("twice"));
  EXPECT_THAT(complaint_of_names({{}, {{"h", 1}}, {{"h", table}}}), HasSubstr("twice"));
  EXPECT_EQ(complaint_of_names({{}, {{"k", infinity}}, {}}),
            "the constant \"k\" is inf, expected a finite number");
  EXPECT_THAT(complaint_of_names({{}, {{"k", std::nan("")}}, {}}), HasSubstr("is nan"));
  EXPECT_EQ(complaint_of_names({{"andy", "_if", "Exp", "x2"}, {}, {}}), "no complaint");
}

TEST(BadExpressionNames, AreAtMost64Variables) {
  ExpressionNames many;
  for (int i = 0; i < 64; ++i) many.variables.push_back(fmt::format("x{}", i));
  const Expression expression("x0 + 2*x63", many);
  std::vector<double> x(64), gradient(64);
  x[63] = 4;
  EXPECT_EQ(expression.value_and_gradient(x, gradient), 8);
  EXPECT_EQ(gradient[63], 2);
  EXPECT_TRUE(expression.depends_on(63));
  EXPECT_FALSE(expression.depends_on(62));
  many.variables.push_back("x64");
  EXPECT_EQ(complaint_of_names(many), "an expression has 65 variables, expected at most 64");
}

std::string complaint_of(const std::vector<double>& x, const std::vector<double>& y) {
  return complaint([&] { PiecewiseLinear(x, y); });
}

TEST(BadTable, IsRefused) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(complaint_of({}, {}), "a table has no points, expected at least one");
  EXPECT_EQ(complaint_of({0, 1}, {1}),
            "a table has 2 abscissae and 1 values, expected as many of both");
  EXPECT_EQ(complaint_of({0, 1, 1, 1}, {1, 2, 3, 4}),
            "abscissa 4 of a table is 1, expected more than 1, or the same once for a jump");
  EXPECT_EQ(complaint_of({0, 1, 0.5}, {1, 2, 3}),
            "abscissa 3 of a table is 0.5, expected more than 1, or the same once for a jump");
  EXPECT_EQ(complaint_of({0, infinity}, {1, 2}),
            "point 2 of a table is (inf, 2), expected finite numbers");
  EXPECT_EQ(complaint_of({0, 1}, {std::nan(""), 2}),
            "point 1 of a table is (0, nan), expected finite numbers");
  EXPECT_EQ(complaint_of({0, 1e-200, 1}, {0, 1e200, 2}),
            "a table is too wide or too steep between 0 and 1e-200");
  EXPECT_EQ(complaint_of({-1e308, 1e308}, {0, 1}),
            "a table is too wide or too steep between -1e+308 and 1e+308");
}

}  // namespace
}  // namespace gnomon::expression_error_test
