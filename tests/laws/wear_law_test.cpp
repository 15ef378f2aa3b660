#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/base/tensor.hpp>
#include <gnomon/wear_laws/wear_law_kind.hpp>
#include <limits>

#include "support/derivatives.hpp"

namespace gnomon::wear_law_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

WearLaw law_of(const std::string& rate, double end = 100, double speed = 1000) {
  ExpressionNames names;
  names.variables = wear_law_variables();
  return expression_wear_law(Expression(rate, names), end, speed);
}

WearInput input(double p, double v, double h = 0.2, double q = 40) {
  return {.pressure = p, .speed = v, .depth = h, .friction_power = q, .moment = {3, 3000, 3}};
}

void expect_derivatives(const WearLaw& law, const WearInput& at,
                        std::span<const char> branches = {}) {
  const WearRate rate = law.rate(at, branches);
  const auto difference = [&](double WearInput::*member) {
    const double h = 1e-6 * std::max(1.0, std::abs(at.*member));
    WearInput above = at, below = at;
    above.*member += h, below.*member -= h;
    return (law.rate(above, branches).value - law.rate(below, branches).value) / (2 * h);
  };
  Vector<5> actual, expected;
  actual << rate.by_pressure, rate.by_speed, rate.by_depth, rate.by_friction_power,
      rate.by_mean_friction_power;
  expected << difference(&WearInput::pressure), difference(&WearInput::speed),
      difference(&WearInput::depth), difference(&WearInput::friction_power),
      difference(&WearInput::mean_friction_power);
  expect_same_matrix(actual, expected, 1e-8);
}

TEST(WearLaw, RatesByHand) {
  EXPECT_DOUBLE_EQ(archard(1e-3).rate(input(20, 5)).value, 0.1);
  EXPECT_DOUBLE_EQ(law_of("1e-3 * q").rate(input(20, 5)).value, 0.04);
  EXPECT_DOUBLE_EQ(archard(1e-3).rate(input(-20, 5)).value, -0.1);  // as far as Archard goes
  EXPECT_EQ(WearLaw().rate(input(20, 5)).value, 0);
  expect_derivatives(archard(1e-3), input(20, 5));
  expect_derivatives(law_of("1e-3 * q"), input(-20, 5, 0.2, -40));
}

TEST(WearLaw, ExpressionsAreTheirFormulaAndItsDerivatives) {
  const WearLaw same = law_of("1e-3 * p * v"), archards = archard(1e-3);
  for (double p : {-7.0, 0.0, 7.0}) {
    EXPECT_DOUBLE_EQ(same.rate(input(p, 5)).value, archards.rate(input(p, 5)).value);
    EXPECT_DOUBLE_EQ(same.rate(input(p, 5)).by_speed, archards.rate(input(p, 5)).by_speed);
  }
  const WearLaw all = law_of("1e-3 * p^1.5 * v^1.2 * exp(-h / 0.3) + 2e-4 * q * (1 + h)");
  for (double p : {-7.0, 7.0}) expect_derivatives(all, input(p, 5, 0.2, 0.4 * p * 5));
  EXPECT_DOUBLE_EQ(all.rate(input(4, 1, 0, 10)).value, 0.01);
  EXPECT_DOUBLE_EQ(law_of("x0 + 10 * y0 + 100 * z0 + t + s")
                       .rate({.moment = {0.5, 0.25, 0}, .initial = {1, 2, 3}})
                       .value,
                   321.75);
}

// Below p = 0: twice the value at zero minus that of the opposite input, with the same value and
// slope at zero.
TEST(WearLaw, ContinuesBelowNoPressure) {
  const WearLaw law = law_of("1e-3 * p^1.5 * v");
  EXPECT_DOUBLE_EQ(law.rate(input(-4, 5)).value, -law.rate(input(4, 5)).value);
  const WearLaw steep = law_of("1e-3 * p * v * (1 + p)");
  EXPECT_NEAR(steep.rate(input(-1e-9, 5)).by_pressure, steep.rate(input(1e-9, 5)).by_pressure,
              1e-10);
  // An infinite slope is replaced by zero at p = 0, and only there.
  const WearLaw root = law_of("1e-3 * sqrt(p) * v");
  EXPECT_EQ(root.rate(input(0, 5)).by_pressure, 0);
  EXPECT_DOUBLE_EQ(root.rate(input(4, 5)).by_pressure, 1.25e-3);
  EXPECT_THROW(law_of("p / h").rate(input(1, 5, 0)), RecoverableError);
}

/// Below zero, too, where iterates may come: the same value and slope at zero.
TEST(WearLaw, ReadsTheMeanOverTheContact) {
  const WearLaw law =
      law_of("1e-3 * (q * (1 + q_mean / 50)^1.5 + h * q_mean) * max(30 - q_mean, 1)");
  EXPECT_TRUE(law.reads_mean());
  EXPECT_FALSE(law_of("1e-3 * q").reads_mean());
  WearInput at = input(20, 5);
  at.mean_friction_power = 25;
  EXPECT_NEAR(law.rate(at).value, 1e-3 * (40 * std::pow(1.5, 1.5) + 5) * 5, 1e-12);
  std::array<double, 1> kink{};
  law.switching(at, kink);
  EXPECT_DOUBLE_EQ(std::abs(kink[0]), 4);
  const std::array<char, 1> here = {kink[0] <= 0};
  for (const double p : {20.0, -20.0})
    for (const double mean : {25.0, 40.0, -25.0}) {
      at = input(p, 5, 0.2, 2 * p);
      at.mean_friction_power = mean;
      expect_derivatives(law, at, here);
    }
  at = input(20, 5);
  at.mean_friction_power = -1e-9;
  const WearRate below = law.rate(at);
  at.mean_friction_power = 1e-9;
  EXPECT_NEAR(below.value, law.rate(at).value, 1e-10);
  EXPECT_NEAR(below.by_mean_friction_power, law.rate(at).by_mean_friction_power, 1e-10);
  at.mean_friction_power = -25;
  law.switching(at, kink, here);
  EXPECT_DOUBLE_EQ(std::abs(kink[0]), 54);
  const WearLaw root = law_of("1e-3 * q * sqrt(q_mean)");
  EXPECT_EQ(root.rate(input(20, 5)).by_mean_friction_power, 0);
}

/// Without pressure it wears by the share in contact alone: nothing where nothing touches.
TEST(WearLaw, ReadsTheShareInContact) {
  const auto rate = [](const std::string& law, double p, double share) {
    WearInput at = input(p, 5, 0.2, 2 * p);
    at.mean_friction_power = 25;
    at.contact_share = share;
    const WearLaw of = law_of(law);
    std::vector<double> kinks(of.kinks());
    of.switching(at, kinks);
    std::vector<char> here;
    for (const double kink : kinks) here.push_back(kink <= 0);
    return of.rate(at, here);
  };
  const std::string mixed = "1e-3 * (q + q_mean * v * (1 + h))";
  EXPECT_EQ(rate(mixed, 0, 0).value, 0);
  EXPECT_NEAR(rate(mixed, 20, 0.3).value, 1e-3 * (40 + 0.3 * 150), 1e-15);
  EXPECT_NEAR(rate(mixed, 20, 0.3).by_contact_share, 0.15, 1e-15);
  EXPECT_NEAR(rate(mixed, 20, 0.3).by_speed, 0.3 * 0.03, 1e-15);
  EXPECT_NEAR(rate(mixed, 20, 0.3).by_depth, 0.3 * 0.125, 1e-15);
  EXPECT_NEAR(rate(mixed, 20, 0.3).by_mean_friction_power, 0.3 * 0.006, 1e-15);
  for (const char* law : {"1e-3 * q * if(q_mean < 30, 1, 3)", "1e-3 * max(q - q_mean, 0)",
                          "1e-3 * p * v * (1 + 0 * q_mean)", "1e-3 * p * v"})
    EXPECT_EQ(rate(law, 20, 0.3).value, rate(law, 20, 1).value) << law;
}

TEST(WearLaw, KinksOfAnExpressionSwitch) {
  const WearLaw law = law_of("1e-3 * v * max(p - 10, 0) * if(h < 0.5, 1, 0.2)");
  ASSERT_EQ(law.kinks(), 2);
  EXPECT_TRUE(law.breakpoints().empty());
  std::array<double, 2> values{};
  law.switching(input(25, 5), values);
  EXPECT_DOUBLE_EQ(std::abs(values[0]), 15);
  EXPECT_DOUBLE_EQ(std::abs(values[1]), 0.3);
  const std::array<char, 2> here = {values[0] <= 0, values[1] <= 0};
  EXPECT_DOUBLE_EQ(law.rate(input(25, 5)).value, 0.075);
  // The active branch above the threshold, below it, and below zero pressure.
  EXPECT_EQ(law.rate(input(4, 5)).value, 0);
  EXPECT_DOUBLE_EQ(law.rate(input(4, 5), here).value, -0.03);
  EXPECT_DOUBLE_EQ(law.rate(input(-4, 5), here).value, -0.07);
  for (double p : {25.0, 4.0, -4.0}) expect_derivatives(law, input(p, 5), here);
  std::array<double, 2> continued{};
  law.switching(input(-4, 5), continued, here);
  EXPECT_DOUBLE_EQ(std::abs(continued[0]), 14);
}

TEST(WearLaw, ConditionsOnTimeAreBreakpoints) {
  const WearLaw law = law_of("if(t < 10, 2e-3, 1e-3) * if(s >= 55000, 3, 1) * max(p - 1, 0) * v");
  EXPECT_EQ(law.breakpoints(), (std::vector<double>{10, 55}));
  EXPECT_EQ(law.kinks(), 1);
  const auto rate = [&](double t, double within) {
    WearInput at = input(2, 5);
    at.moment = {t, 1000 * t, within};
    return law.rate(at).value;
  };
  EXPECT_DOUBLE_EQ(rate(4, 4), 0.01);
  EXPECT_DOUBLE_EQ(rate(10, 4), 0.01);  // of a step that ends there
  EXPECT_DOUBLE_EQ(rate(10, 10), 0.005);
  EXPECT_DOUBLE_EQ(rate(12, 9.9), 0.01);
  EXPECT_DOUBLE_EQ(rate(55, 54), 0.005);
  EXPECT_DOUBLE_EQ(rate(1e3, 1e3), 0.015);

  ExpressionNames names;
  names.variables = wear_law_variables();
  names.tables.emplace("fade", PiecewiseLinear({0.1, 7, 7.01}, {1, 0.5, 0.2}));
  const WearLaw table = expression_wear_law(Expression("1e-3 * p * v * fade(t)", names), 30, 1);
  EXPECT_EQ(table.breakpoints(), (std::vector<double>{0.1, 7, 7.01}));
}

TEST(WearLaw, IsContinuedPastTheEndOfItsSmoothPart) {
  const WearLaw law = law_of("1e-3 * p * v * (1 + sqrt(max(50 - t, 0))) * log(150 - s / 1000)");
  EXPECT_EQ(law.breakpoints(), std::vector<double>{50});
  const auto rate = [&](double t, double within) {
    WearInput at = input(2, 5);
    at.moment = {t, 1000 * t, within};
    return law.rate(at).value;
  };
  EXPECT_DOUBLE_EQ(rate(50, 49), 0.01 * std::log(100));
  EXPECT_DOUBLE_EQ(rate(50.5, 49), rate(50, 49));
  EXPECT_DOUBLE_EQ(rate(50.5, 50.5), 0.01 * std::log(99.5));
  EXPECT_DOUBLE_EQ(rate(49, 49), 0.01 * 2 * std::log(101));
  EXPECT_DOUBLE_EQ(rate(100.5, 60), 0.01 * std::log(49.5));  // finite past the end of the run
  EXPECT_DOUBLE_EQ(rate(151, 60), 0.01 * std::log(50));
}

TEST(WearLaw, AddsMaterialByRoundingAtMost) {
  const WearLaw law = law_of("1e-3 * p * v * (1 - 5 * h)");
  EXPECT_LT(law.rate(input(20, 5, 0.2 * (1 + 1e-10))).value, 0);
  EXPECT_THROW(law.rate(input(20, 5, 0.2 * (1 + 1e-8))), RecoverableError);
  EXPECT_THROW(law_of("-1e-30 * p * v").rate(input(20, 5)), RecoverableError);
}

std::string refusal(const std::string& rate) {
  const WearRange range{
      .pressure = 30, .speed = 1000, .depth = 0.5, .duration = 100, .friction = 0.3};
  try {
    check_wear_law(law_of(rate), range, "scene.toml:3: key `wear.rate`");
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(WearLaw, IsCheckedOnAGridOfInputs) {
  EXPECT_EQ(refusal("1e-9 * p * v"), "");
  EXPECT_EQ(refusal("1e-9 * p^0.8 * v * exp(-h)"), "");
  EXPECT_EQ(refusal("1e-9 * q * sqrt(1e-3 + max(h, 0))"), "");
  EXPECT_EQ(refusal("1e-9 * q * q_mean^0.5"), "");
  EXPECT_EQ(refusal("1e-9 * q_mean"), "");  // open nodes do not wear by it
  EXPECT_THAT(refusal("1e-9 * q * (1 - q_mean / 20000)"), HasSubstr("adds material"));
  const std::string key = "scene.toml:3: key `wear.rate`: ";
  const std::string idle = refusal("1e-9 * (p + 1) * v");
  EXPECT_THAT(idle,
              HasSubstr(key + "expected no wear without pressure, got the rate 5e-07 at p = 0,"));
  EXPECT_THAT(refusal("1e-9 * p * v + 1e-9 * h"), HasSubstr("expected no wear without pressure"));
  // How deep it wears depends on the law: not beyond 0.01 here.
  EXPECT_EQ(refusal("1e-9 * p * v * (1 - 100 * h)"), "");
  EXPECT_EQ(refusal("1e-9 * p * v * log(1.01 - h)"), "");
  EXPECT_THAT(
      refusal("1e-9 * p * v * (1 - 0.02 * p)"),
      HasSubstr(key + "expected a finite wear rate of zero or more, with finite derivatives: "
                      "the wear law adds material: its rate is -"));
  EXPECT_THAT(
      refusal("1e-9 * p * v * sqrt(h)"),
      HasSubstr(key + "expected a finite wear rate of zero or more, with finite derivatives: "
                      "the wear law has no finite rate"));
  for (const std::string& text : {idle}) EXPECT_EQ(text.find('\n'), std::string::npos);
}

TEST(WearLaw, IsMadeOfASceneByItsName) {
  EXPECT_THAT(Registry<WearLawKind>::names(), ::testing::IsSupersetOf({"archard", "expression"}));
  const auto make = [](const std::string& name, const std::string& text) {
    const WearLawKind& kind = Registry<WearLawKind>::find(name, "wear law");
    std::vector<Key> keys = run_keys();
    keys.push_back({.name = "wear.velocity"});
    keys.push_back({.name = "wear.coefficient"});
    keys.push_back({.name = "wear.rate", .kind = KeyKind::text, .default_value = "k * p * v"});
    keys.insert(keys.end(), kind.keys.begin(), kind.keys.end());
    return kind.make(
        parse_scene("problem = \"any\"\ntime.end = 20.0\nintegrator.name = \"any\"\n"
                    "wear.velocity = 1000.0\nwear.coefficient = 1e-3\n" +
                        text,
                    "scene.toml", {}, [&](const std::string&) { return keys; }));
  };
  EXPECT_DOUBLE_EQ(make("archard", "").rate(input(20, 5)).value, 0.1);
  EXPECT_DOUBLE_EQ(make("expression", "").rate(input(20, 5)).value, 0.1);
  const WearLaw law = make("expression", "wear.rate = \"1e-3 * p * v * if(t < 10, 1, 2)\"");
  EXPECT_DOUBLE_EQ(law.rate(input(20, 5)).value, 0.1);
  EXPECT_EQ(law.breakpoints(), std::vector<double>{10});
  try {
    make("expression", "wear.rate = \"1e-3 * r\"");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("scene.toml:6: key `wear.rate`: column 8"));
  }
}

TEST(WearLaw, OfWhatIsNoNumberSwitchingIsNone) {
  const WearLaw law({.rate = [](const WearInput&, std::span<const char>) { return WearRate{}; },
                     .kinks = 1,
                     .switching = [](const WearInput& at, std::span<const char>,
                                     std::span<double> values) { values[0] = at.pressure - 1; }});
  std::array<double, 1> value{};
  law.switching({.pressure = std::numeric_limits<double>::quiet_NaN()}, value);
  EXPECT_TRUE(std::isnan(value[0]));
}

}  // namespace
}  // namespace gnomon::wear_law_test
