// Cycles of the pin on springs: closed forms of the averaged problem, and runs through every cycle.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <gnomon/base/error.hpp>
#include <numbers>

#include "winkler_pin.hpp"

namespace gnomon::winkler_cycle_test {
namespace {

using namespace testing;
using namespace winkler_pin;
using ::testing::HasSubstr;

std::string refusal(const std::string& cycle, const Overrides& overrides = {}) {
  try {
    pin(cycle, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Steps end where springs touch or lose contact in a phase.
State averaged(const Model& model, double end) {
  return run_model(model, "esdirk-5", 0, 1e-9, end, true, to_rounding).last();
}

double difference(const Depths& a, const Depths& b) {
  double worst = 0;
  for (int i = 0; i < n; ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst;
}

// All springs are compressed all the time: delta is F/(K_w L) and the mean m of e = d + x^2/(2R),
// so that m grows with the mean of v F, and e - m decays with that of v.
TEST(WinklerCycle, FullContactFollowsItsExponential) {
  const double cycles = 1e5, amplitude = 0.05, force = 40;
  const auto model = pin(fmt::format(
      "phases = 24\nx = \"{} * sin(2*pi*tau)\"\nforce = \"{} * (1 + 0.5*cos(4*pi*tau))\"",
      amplitude, force));
  const double mean_speed = 4 * amplitude;
  // The mean of |cos a| cos 2a is a third of that of |cos a|.
  const double worn_area = k * cycles * mean_speed * force * (1 + 0.5 / 3);
  double m_0 = 0;
  for (int i = 0; i < n; ++i) m_0 += area(i) * profile(i) / L;
  const double decay = std::exp(-k * modulus * mean_speed * cycles);
  Depths exact;
  for (int i = 0; i < n; ++i)
    exact.push_back(m_0 + worn_area / L + (profile(i) - m_0) * decay - profile(i));
  EXPECT_LT(difference(depths_of(*model, averaged(*model, cycles)), exact), 1e-9 * exact[n / 2]);
  EXPECT_GT(std::abs(exact[0] - exact[n / 2]), 0.01 * exact[n / 2]);
}

/// d of one point below a flat that is held at `a[q]` above it for equal parts of each cycle: d' =
/// rate times the mean of max(0, a_q - d), an exponential from one loss of contact to the next.
double held_depth(std::vector<double> a, double rate, double t) {
  const double phases = double(a.size());
  std::sort(a.begin(), a.end(), std::greater<>());
  while (!a.empty() && a.back() <= 0) a.pop_back();
  double d = 0;
  while (!a.empty()) {
    double mean = 0;
    for (const double height : a) mean += height / double(a.size());
    const double speed = rate * double(a.size()) / phases;
    const double next = mean > a.back() ? std::log((d - mean) / (a.back() - mean)) / speed : t;
    if (next >= t) return mean + (d - mean) * std::exp(-speed * t);
    d = a.back(), t -= next;
    a.pop_back();
  }
  return d;
}

// The flat is held at four heights, one of them out of reach: points touch in some phases, and in
// fewer of them while they wear.
TEST(WinklerCycle, AHeldFlatWearsByExponentialsUntilPhasesLoseContact) {
  const double cycles = 1e5;
  const auto model =
      pin("phases = [0.0, 0.25, 0.5, 0.75]\nx = \"0.2 * tau\"\n"
          "y = \"if(tau < 0.2, 0.1, if(tau < 0.4, 0.06, if(tau < 0.6, -0.5, 0.09)))\"");
  Depths exact;
  for (int i = 0; i < n; ++i)
    exact.push_back(held_depth({0.1 - profile(i), 0.06 - profile(i), -0.5, 0.09 - profile(i)},
                               k * modulus * 0.2, cycles));
  EXPECT_EQ(exact[0], 0);
  EXPECT_GT(exact[n / 2], 0.06);  // it has lost the second phase
  EXPECT_LT(difference(depths_of(*model, averaged(*model, cycles)), exact), 1e-8 * exact[n / 2]);
}

/// Every cycle as ordinary time: the explicit midpoint rule, `steps` a cycle, none of which looks
/// beyond its end.
Depths through_every_cycle(const std::function<double(double)>& force,
                           const std::function<double(double)>& speed, double period, int cycles,
                           int steps) {
  Depths d(n, 0.0);
  const double h = period / steps;
  const auto step_from = [&](const Depths& from, const Depths& rate_at, double tau, double length) {
    const std::vector<double> p = pressures(rate_at, force(tau));
    Depths to = from;
    for (int i = 0; i < n; ++i) to[i] += length * k * speed(tau) * p[i];
    return to;
  };
  for (int cycle = 0; cycle < cycles; ++cycle)
    for (int s = 0; s < steps; ++s) {
      const double tau = double(s) / steps, rounding = 1e-9;
      const Depths middle = step_from(d, d, tau + rounding, h / 2);
      d = step_from(d, middle, tau + 0.5 / steps, h);
    }
  return d;
}

/// Four phases of different force, under which different springs touch.
constexpr const char* four_phases =
    "phases = [0.0, 0.25, 0.5, 0.75]\nx = \"0.2 * tau\"\n"
    "force = \"if(tau < 0.2, 4, if(tau < 0.4, 1, if(tau < 0.6, 0.3, 2)))\"";
double four_forces(double tau) {
  return tau < 0.25 ? 4 : tau < 0.5 ? 1 : tau < 0.75 ? 0.3 : 2;
}

// The mean of the pressures of the phases is an ODE for the depths alone.
TEST(WinklerCycle, ChangingContactAgreesWithAnIndependentIntegration) {
  const double cycles = 1e5;
  const auto model = pin(four_phases);
  const auto rate = [](const Depths& d) {
    Depths sum(n, 0.0);
    for (const double force : {4.0, 1.0, 0.3, 2.0}) {
      const std::vector<double> p = pressures(d, force);
      for (int i = 0; i < n; ++i) sum[i] += 0.25 * k * 0.2 * p[i];
    }
    return sum;
  };
  const auto moved = [](const Depths& d, double h, const Depths& by) {
    Depths result = d;
    for (int i = 0; i < n; ++i) result[i] += h * by[i];
    return result;
  };
  Depths d(n, 0.0);
  const int steps = 5000;
  const double h = cycles / steps;
  for (int s = 0; s < steps; ++s) {  // Kutta's method
    const Depths a = rate(d), b = rate(moved(d, h / 2, a)), c = rate(moved(d, h / 2, b)),
                 e = rate(moved(d, h, c));
    for (int i = 0; i < n; ++i) d[i] += h / 6 * (a[i] + 2 * b[i] + 2 * c[i] + e[i]);
  }
  const State last = averaged(*model, cycles);
  EXPECT_LT(difference(depths_of(*model, last), d), 1e-7 * d[n / 2]);
  const double worn_area = k * 0.2 * cycles * (4 + 1 + 0.3 + 2) / 4;
  EXPECT_NEAR(observed(*model, last, "worn_volume") / worn_area, 1, 1e-9);
  EXPECT_NEAR(observed(*model, last, "contact_force"), (4 + 1 + 0.3 + 2) / 4, 1e-8);
}

/// Difference between the mean and every cycle, divided by the largest depth.
double difference_from(const Depths& mean, const std::function<double(double)>& force,
                       const std::function<double(double)>& speed, int cycles, int steps) {
  const Depths truth = through_every_cycle(force, speed, 2e4 / cycles, cycles, steps);
  const double result = difference(mean, truth) / *std::ranges::max_element(truth);
  std::printf("%d cycles: %.2e of the depth\n", cycles, result);
  return result;
}
Depths mean_of(const Model& model) {
  return depths_of(model, run_model(model, "esdirk-4", 0, 1e-7, 2e4).last());
}

// The same wear in 25, 50, 100 and 200 cycles.
TEST(WinklerCycle, DiffersFromEveryCycleByTheWearOfOneInTheFirstOrder) {
  const Depths mean = mean_of(*pin(four_phases));
  const auto at = [&mean](int cycles) {
    return difference_from(
        mean, four_forces, [](double) { return 0.2; }, cycles, 64);
  };
  const double first = at(25), second = at(50), third = at(100), fourth = at(200);
  EXPECT_NEAR(std::log2(first / second), 1, 0.03);
  EXPECT_NEAR(std::log2(second / third), 1, 0.03);
  EXPECT_NEAR(std::log2(third / fourth), 1, 0.03);
  EXPECT_LT(fourth, 0.05 / 200);  // of the wear of one cycle
}

// Motion and load that change all the time.
TEST(WinklerCycle, SmoothMotionDiffersInTheFirstOrder) {
  const auto force = [](double tau) { return 2 + 1.5 * std::sin(2 * pi * tau + 0.3); };
  const Depths mean = mean_of(
      *pin("phases = 80\nx = \"0.05 * sin(2*pi*tau)\"\nforce = \"2 + 1.5 * sin(2*pi*tau + 0.3)\""));
  const double first = difference_from(mean, force, speed_of_sine, 5, 2000),
               last = difference_from(mean, force, speed_of_sine, 40, 2000);
  EXPECT_NEAR(std::log2(first / last) / 3, 1, 0.05);
}

// While all springs touch, what a force and a speed change is the same in any order: the mean is
// exact at the end of every cycle, up to the quadrature of the midpoint rule, (2 pi h)^2 / 24.
TEST(WinklerCycle, FullContactIsExactAtTheEndOfEveryCycle) {
  const Depths mean = mean_of(
      *pin("phases = 24\nx = \"0.05 * sin(2*pi*tau)\"\nforce = \"40 + 15 * sin(2*pi*tau + 0.3)\""));
  EXPECT_LT(difference_from(
                mean, [](double tau) { return 40 + 15 * std::sin(2 * pi * tau + 0.3); },
                speed_of_sine, 25, 1000),
            2e-6);
}

TEST(WinklerCycle, OnePhaseIsSteadySliding) {
  const auto steady = model_of("winkler/pin.toml", {"foundation.points=41"});
  const auto cycle = make_model(parse_scene(R"(problem = "winkler"
pin = { radius = 5.0, width = 10.0 }
foundation = { modulus = 70.33, points = 41 }
wear.coefficient = 1e-7
time.end = 1000.0
integrator = { name = "esdirk-4", rtol = 1e-4 }
cycle = { period = 2.0, phases = 1, x = "2000 * tau", force = "20" }
)",
                                            "pin.toml", {}, key_table));
  const State a = run_model(*steady, "esdirk-4", 0, 1e-4, 300).last(),
              b = run_model(*cycle, "esdirk-4", 0, 1e-4, 300).last();
  ASSERT_EQ(a.y.size(), b.y.size());
  for (std::size_t i = 0; i < a.y.size(); ++i) EXPECT_DOUBLE_EQ(a.y[i], b.y[i]) << i;
}

TEST(WinklerCycle, JacobiansEqualCentralDifferences) {
  for (const char* press : {"force = \"4 + 3*sin(2*pi*tau)\"", "y = \"0.03 + 0.04*tau\""}) {
    const auto model =
        pin(std::string("phases = [0.1, 0.4, 0.9]\nx = \"0.05*cos(2*pi*tau)\"\n") + press,
            {"wear.rate=\"k * p^1.5 * v / (1 + 3*h)\"", "foundation.points=9"});
    Counters counters;
    const State start = model->start(counters);
    std::vector<double> y = start.y;
    const Structure& structure = model->system().structure();
    for (std::size_t i = 0; i < y.size(); ++i)
      y[i] += 0.02 * structure.unknown_scale[i] * std::sin(1.0 + 7.0 * double(i));
    check_jacobian(model->system(), 0, y, 0.2);
    for (const AlgebraicStage& stage : model->system().algebraic_stages()) {
      stage.freeze(0, y);
      std::vector<double> part;
      for (const int unknown : stage.unknowns) part.push_back(y[unknown]);
      check_jacobian(*stage.system, 0, part, 0);
    }
  }
}

TEST(WinklerCycle, RefusesWhatContradictsItself) {
  const std::string x = "phases = 4\nx = \"0.05 * sin(2*pi*tau)\"\n", force = "force = \"4\"\n";
  EXPECT_EQ(refusal(x + force), "");
  EXPECT_THAT(refusal(x), HasSubstr("missing key `load.force` (with a cycle instead also "
                                    "cycle.force or cycle.y)"));
  EXPECT_THAT(refusal(x + force, {"load.force=3.0"}),
              HasSubstr("expected either load.force or cycle.force, got both"));
  EXPECT_THAT(refusal(x + force, {"wear.velocity=3.0"}),
              HasSubstr("expected either wear.velocity or cycle.x, got both"));
  EXPECT_THAT(refusal(x + "force = \"sin(2*pi*tau)\"\n"), HasSubstr("expected a force above zero"));
  EXPECT_THAT(refusal(x + "y = \"-1 - tau\"\n"), HasSubstr("expected a flat that presses the pin"));
  EXPECT_THAT(refusal("phases = 4\nx = \"2\"\n" + force), HasSubstr("slides in some phase"));
  EXPECT_THAT(refusal(x + force + "rotation = \"tau\"\n"), HasSubstr("cycle.rotation"));
}

}  // namespace
}  // namespace gnomon::winkler_cycle_test
