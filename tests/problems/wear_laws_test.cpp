// Wear laws other than Archard's, by every integrator: against closed forms on springs, an
// independent integration there, and a method of another family on the elastic pin.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <gnomon/base/error.hpp>
#include <gnomon/model/wear_scene.hpp>
#include <gnomon/newton/newton.hpp>
#include <gnomon/run/run.hpp>

#include "support/problem_run.hpp"

namespace gnomon::wear_laws_test {
namespace {

using namespace testing;

constexpr double F = 20, R = 5, k = 1e-7, v = 1000, modulus = 70.33, width = 10, end = 200;
constexpr int points = 41;

/// The pin on springs with a law.
std::unique_ptr<Model> springs(const std::string& rate, Overrides more = {}) {
  more.push_back("foundation.points=" + std::to_string(points));
  more.push_back("wear.rate=\"" + rate + "\"");
  return model_of("winkler/pin.toml", more);
}

std::vector<double> depths(const std::vector<double>& y) {
  std::vector<double> d;
  for (int i = 0; i < points; ++i) d.push_back(y[2 * i]);
  return d;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

/// An independent implementation of the springs: depths after `end` by the classical Runge-Kutta
/// method.
class IndependentSprings {
public:
  using Law = std::function<double(double p, double h, double t)>;
  explicit IndependentSprings(Law law) : law_(std::move(law)) {}

  std::vector<double> worn(int steps) const {
    std::vector<double> d(points, 0.0);
    const double h = end / steps;
    for (int n = 0; n < steps; ++n) {
      const double t = n * h;
      const auto k1 = rates(d, t), k2 = rates(moved(d, k1, h / 2), t + h / 2),
                 k3 = rates(moved(d, k2, h / 2), t + h / 2), k4 = rates(moved(d, k3, h), t + h);
      for (int i = 0; i < points; ++i) d[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
    return d;
  }

private:
  static double x(int i) { return width * (double(i) / (points - 1) - 0.5); }
  static double area(int i) { return (i == 0 || i == points - 1 ? 0.5 : 1) * width / (points - 1); }
  static std::vector<double> moved(std::vector<double> d, const std::vector<double>& k, double h) {
    for (int i = 0; i < points; ++i) d[i] += h * k[i];
    return d;
  }
  /// Pressures by bisection for the approach that carries the force.
  static std::vector<double> pressures(const std::vector<double>& d) {
    const auto at = [&](double delta) {
      std::vector<double> p;
      for (int i = 0; i < points; ++i)
        p.push_back(std::max(0.0, modulus * (delta - x(i) * x(i) / (2 * R) - d[i])));
      return p;
    };
    double low = 0, high = 100;
    for (int k = 0; k < 200; ++k) {
      const double middle = (low + high) / 2;
      const auto p = at(middle);
      double force = 0;
      for (int i = 0; i < points; ++i) force += area(i) * p[i];
      (force < F ? low : high) = middle;
    }
    return at(low);
  }
  std::vector<double> rates(const std::vector<double>& d, double t) const {
    const auto p = pressures(d);
    std::vector<double> rate;
    for (int i = 0; i < points; ++i) rate.push_back(p[i] > 0 ? law_(p[i], d[i], t) : 0);
    return rate;
  }
  Law law_;
};

struct Case {
  std::string name, rate;
  Overrides constants;
  IndependentSprings::Law law;
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"PowerOfThePressure",
       "k * (p / p0)^1.5 * p0 * v",
       {"wear.constants.p0=2"},
       [](double p, double, double) { return k * std::pow(p / 2, 1.5) * 2 * v; }},
      {"Threshold",
       "k * max(p - p0, 0) * v",
       {"wear.constants.p0=1"},
       [](double p, double, double) { return k * std::max(p - 1, 0.0) * v; }},
      {"RunningInByTime",
       "k * (1 + a * exp(-t / t0)) * p * v",
       {"wear.constants.a=3", "wear.constants.t0=40"},
       [](double p, double, double t) { return k * (1 + 3 * std::exp(-t / 40)) * p * v; }},
      {"RunningInByDistance",
       "k * (1 + a * exp(-s / s0)) * p * v",
       {"wear.constants.a=3", "wear.constants.s0=40e3"},
       [](double p, double, double t) { return k * (1 + 3 * std::exp(-t / 40)) * p * v; }},
      {"HardeningWithDepth",
       "k * p * v / (1 + h / h0)",
       {"wear.constants.h0=0.05"},
       [](double p, double h, double) { return k * p * v / (1 + h / 0.05); }},
      {"TableOfTime",
       "k * factor(t) * p * v",
       {"tables.factor.x=[0, 50, 100]", "tables.factor.y=[3, 1, 2]"},
       [](double p, double, double t) {
         const double factor = t < 50 ? 3 - 2 * t / 50 : t < 100 ? 1 + (t - 50) / 50 : 2;
         return k * factor * p * v;
       }}};
  return all;
}

/// Required error of each integrator, relative to the largest depth; fixed steps if it has no
/// estimate.
struct Setting {
  double step, rtol, allowed;
};
Setting setting_of(const Integrator& integrator) {
  if (integrator.name == "forward-euler" || integrator.name == "backward-euler")
    return {0.25, 0, 2e-2};
  if (integrator.name == "theta") return {2, 0, 5e-3};
  return {0, 1e-5, 1e-3};
}

class LawByEveryIntegrator : public ::testing::TestWithParam<std::size_t> {};

// With the switching of points ignored, as integrators do by default.
TEST_P(LawByEveryIntegrator, AgreesWithAnIndependentIntegration) {
  const Case& law = cases()[GetParam()];
  const auto model = springs(law.rate, law.constants);
  const std::vector<double> reference = IndependentSprings(law.law).worn(4000);
  const double largest = *std::max_element(reference.begin(), reference.end());
  ASSERT_GT(largest, 1e-3);
  for (const Integrator& integrator : Integrators::all()) {
    const Setting s = setting_of(integrator);
    const State last = run_model(*model, integrator.name, s.step, s.rtol, end).last();
    EXPECT_LT(distance(depths(last.y), reference), s.allowed * largest) << integrator.name;
  }
}

INSTANTIATE_TEST_SUITE_P(WearLaw, LawByEveryIntegrator,
                         ::testing::Range<std::size_t>(0, cases().size()),
                         [](const auto& info) { return cases()[info.param].name; });

// k(t) only stretches time: the state of the springs after t is that with constant k after the
// integral of k(t)/k. So Archard's closed form holds at that time.
TEST(WearLaw, AFactorOfTimeStretchesTimeInTheClosedForm) {
  const Overrides fine = {"wear.constants.a=3", "wear.constants.t0=40"};
  const auto varying = springs("k * (1 + a * exp(-t / t0)) * p * v", fine);
  const auto by_distance = springs("k * (1 + a * exp(-s / (t0 * 1000))) * p * v", fine);
  const auto constant = springs("k * p * v");
  ASSERT_FALSE(varying->exact);
  const double stretched = end + 3 * 40 * (1 - std::exp(-end / 40));
  const State closed = constant->exact(stretched).value();
  const State tight = run_model(*constant, "esdirk-4", 0, 1e-8, stretched).last();
  const double mesh = distance(depths(tight.y), depths(closed.y));  // of the points, not of time
  for (const auto& model : {varying.get(), by_distance.get()}) {
    const State last = run_model(*model, "esdirk-4", 0, 1e-8, end).last();
    EXPECT_LT(distance(depths(last.y), depths(tight.y)), 1e-7);
    EXPECT_LT(distance(depths(last.y), depths(closed.y)), mesh + 1e-7);
  }
}

// The breakpoints of a table in time are breakpoints of the system, on which steps end; a threshold
// switches nodes, and located steps end there. The method keeps order 4 in both cases.
TEST(WearLaw, StepsEndOnItsKinks) {
  const auto table = springs("k * factor(t) * p * v",
                             {"tables.factor.x=[0, 50, 100]", "tables.factor.y=[3, 1, 2]"});
  EXPECT_EQ(table->system().structure().breakpoints, (std::vector<double>{50, 100}));
  const auto threshold = springs("k * max(p - p0, 0) * v", {"wear.constants.p0=1"});
  EXPECT_EQ(threshold->system().structure().switch_node.size(), 2 * points);
  const auto final_depths = [&](double step, bool locate) {
    return depths(run_model(*threshold, "esdirk-4", step, 0, end, locate).last().y);
  };
  const std::vector<double> exact = final_depths(0.625, true);
  const double coarse = distance(final_depths(20, true), exact),
               fine = distance(final_depths(5, true), exact);
  std::printf("threshold, located: %.2e at 20 s, %.2e at 5 s; ignored: %.2e\n", coarse, fine,
              distance(final_depths(5, false), exact));
  EXPECT_GT(std::log2(coarse / fine) / 2, 3);
  EXPECT_LT(fine, 0.2 * distance(final_depths(5, false), exact));
}

TEST(WearLaw, JacobiansOnSpringsEqualCentralDifferences) {
  for (const Case& law : cases()) {
    SCOPED_TRACE(law.name);
    const auto model = springs(law.rate, law.constants);
    Counters counters;
    State state = model->start(counters);
    for (int i = 0; i < points; ++i) state.y[2 * i] = 1e-3 * (i % 7);
    check_jacobian(model->system(), 30, state.y, 0.2);
  }
}

/// The coarse elastic pin.
std::unique_ptr<Model> pin(Overrides more) {
  more.push_back("mesh.elements=[10, 10]");
  return model_of("pin_on_flat/small_deformation.toml", more);
}

TEST(WearLaw, MethodsOfTwoFamiliesAgreeOnTheElasticPin) {
  const std::vector<Overrides> laws = {
      {"wear.rate=k * (p / p0)^1.5 * p0 * v", "wear.constants.p0=2"},
      {"wear.rate=\"k * max(p - p0, 0) * v\"", "wear.constants.p0=1"},
      {"wear.rate=k * (1 + a * exp(-s / s0)) * p * v", "wear.constants.a=3",
       "wear.constants.s0=1e5"},
      {"wear.rate=k * q", "friction.coefficient=0.3"},
      {"wear.rate=k * p * v / (1 + h / h0)", "wear.constants.h0=0.1", "wear.normal=conservative"}};
  for (const Overrides& law : laws) {
    SCOPED_TRACE(law.front());
    const auto model = pin(law);
    const auto worn = [&](const char* integrator) {
      return observed(*model, run_model(*model, integrator, 0, 1e-6, 200).last(), "worn_volume");
    };
    const double runge_kutta = worn("esdirk-4"), multistep = worn("bdf");
    EXPECT_GT(runge_kutta, 0.02);
    EXPECT_NEAR(runge_kutta / multistep, 1, 2e-4);
  }
}

// Newton sees exact derivatives: a full step squares the residual.
TEST(WearLaw, NewtonStaysQuadratic) {
  const auto model = pin({"wear.rate=k * (p / p0)^1.5 * p0 * v / (1 + h / h0)",
                          "wear.constants.p0=2", "wear.constants.h0=0.1"});
  const System& system = model->system();
  Counters counters;
  const State start = model->start(counters);
  std::vector<double> y = start.y, ydot(y.size());
  const double h = 20;
  const Structure& structure = system.structure();
  const ActiveSet branch = active_set(system, 0, y);
  NonlinearFunction step;
  const auto rates = [&](std::span<const double> at) {
    for (std::size_t i = 0; i < ydot.size(); ++i)
      ydot[i] = structure.differential[i] ? (at[i] - start.y[i]) / h : 0;
  };
  step.residual = [&](std::span<const double> at, std::span<double> G) {
    rates(at);
    system.residual({h, at, ydot, &branch}, G);
  };
  step.jacobian = [&](std::span<const double> at, std::span<double> values) {
    rates(at);
    system.jacobian({h, at, ydot, &branch}, 1 / h, values);
  };
  const NewtonReport report = NewtonSolver(structure, counters).solve(step, y);
  ASSERT_TRUE(report.converged) << report.reason;
  int quadratic = 0;
  for (std::size_t n = 1; n + 1 < report.norms.size(); ++n) {
    const double before = report.norms[n], after = report.norms[n + 1];
    if (before > 1e-1 || before < 1e-7) continue;
    EXPECT_LT(after, 1e3 * before * before + 1e-11) << "iteration " << n;
    ++quadratic;
  }
  EXPECT_GE(quadratic, 1) << "no iterate in the quadratic range";
}

TEST(WearLaw, NamesThatTheRateDoesNotUseAreKnown) {
  const Scene scene = load_scene(
      GNOMON_SOURCE_DIR "/problems/pin_on_flat/small_deformation.toml",
      {"wear.rate=k * p * v * g(h) * (1 + a2)", "wear.constants.a=1", "wear.constants.a2=1",
       "tables.g.x=[0]", "tables.g.y=[1]", "tables.h2.x=[0]", "tables.h2.y=[1]"},
      key_table);
  EXPECT_EQ(unused_wear_names(scene), (std::vector<std::string>{"wear.constants.a", "tables.h2"}));
}

TEST(WearLaw, WrongExpressionsAreRefusedInOneLine) {
  const auto message = [](Overrides overrides) -> std::string {
    try {
      pin(std::move(overrides));
      return "nothing was refused";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  using ::testing::AllOf;
  using ::testing::HasSubstr;
  using ::testing::Not;
  const auto refuses = [&](const Overrides& overrides, const char* what) {
    const std::string text = message(overrides);
    EXPECT_THAT(text, AllOf(HasSubstr(what), Not(HasSubstr("\n"))));
  };
  refuses({"wear.rate=k * pressure * v"}, "pressure");
  refuses({"wear.rate=k * p * "}, "column");
  refuses({"wear.rate=k * p * v - 1"}, "wear.rate");
  refuses({"wear.rate=-k * p * v"}, "zero or more");
  refuses({"wear.rate=k * p * v / (t - t)"}, "wear.rate");
  refuses({"wear.rate=k * (p + 1) * v"}, "without pressure");
  refuses({"wear.rate=k * f(p) * v", "tables.f.x=[0, 1]"}, "tables.f");
  refuses({"wear.rate=k * f(p) * v", "tables.f.x=[1, 0]", "tables.f.y=[1, 2]"}, "tables.f.x");
  refuses({"wear.constants.k=1"}, "wear.constants.k");
  refuses({"wear.constants.p=1"},
          "--set wear.constants.p: expected another name, there are already the variables p, v, ");
  refuses({"wear.constants.exp=1"}, "--set wear.constants.exp: expected another name");
  refuses({"tables.t.x=[0, 1]", "tables.t.y=[0, 1]"}, "--set tables.t.x: expected another name");
  refuses({"wear.constants.2x=1"},
          "--set wear.constants.2x: expected letters, digits and underscores, no digit first, in "
          "the place of * in `wear.constants.*`");
  refuses({"tables.f2.z=[0, 1]"}, "did you mean `tables.f2.x`?");
  refuses({"wear.rate=k * max(p, 0) * v"}, "'wear.rate=\"k * max(p, 0) * v\"'");
  std::string many = "0";
  for (int i = 1; i <= 1000; ++i) many += fmt::format(", {}", i);
  refuses({"wear.rate=k * p * v * g(h)", "tables.g.x=[" + many + "]", "tables.g.y=[" + many + "]"},
          "--set tables.g.x: expected at most 1000 points of a table in a wear rate, got 1001");
  refuses({"wear.law=archar"}, "archard");
  refuses({"wear.constants.pi=3"}, "--set wear.constants.pi: expected another name");
}

TEST(WearLaw, ThatWearsNothingIsRemarkedOn) {
  using ::testing::Contains;
  using ::testing::HasSubstr;
  EXPECT_THAT(pin({"wear.rate=k * q"})->remarks, Contains(HasSubstr("friction.coefficient is 0")));
  EXPECT_THAT(pin({"wear.rate=\"k * v * max(p - pi * 10, 0)\""})->remarks,
              Contains(HasSubstr("the wear law is 0 at pressures up to 20 MPa")));
  EXPECT_TRUE(pin({})->remarks.empty());
}

TEST(WearLaw, NeedsACoefficientOnlyIfItReadsIt) {
  std::ifstream file(GNOMON_SOURCE_DIR "/problems/winkler/pin.toml");
  std::string text, line;
  while (std::getline(file, line))
    if (!line.starts_with("coefficient")) text += line + "\n";
  const auto make = [&](const std::string& rate) {
    return Problems::find("winkler", "problem")
        .make(parse_scene(text, "pin.toml", {"wear.rate=" + rate}, key_table));
  };
  EXPECT_NE(make("1e-7 * p * v"), nullptr);
  EXPECT_THROW(make("k * p * v"), InputError);
}

// The springs carry F at every instant, so that a factor c(t) of Archard's law wears k v F times
// the integral of c, to rounding, by every method and step: also where the factor jumps within the
// run.
TEST(WearLawThatJumpsInTime, WearsByTheIntegralOfItsFactor) {
  const auto model = springs("k * p * v * if(t < 43.7, 1, 3)");
  const double worn = k * v * F * (43.7 + 3 * (end - 43.7));
  for (const Integrator& integrator : Integrators::all()) {
    SCOPED_TRACE(integrator.name);
    const bool bdf = integrator.name == "bdf";
    const ModelRun run = run_model(*model, integrator.name, bdf ? 0 : 9, 1e-6, end);
    EXPECT_NEAR(observed(*model, run.last(), "worn_volume") / worn, 1, bdf ? 1e-6 : 1e-10);
  }
}

// By error control, too, where the last stage of a step lies on the jump.
TEST(WearLawThatJumpsInTime, DoesNotSpoilErrorControl) {
  const auto model = springs("k * p * v * if(t < 43.7, 1, 3)");
  const double worn = k * v * F * (43.7 + 3 * (end - 43.7));
  for (const char* integrator : {"esdirk-2", "esdirk-3", "esdirk-4", "erk-2", "erk-4", "theta"}) {
    const ModelRun run = run_model(*model, integrator, 0, 1e-3, end);
    EXPECT_NEAR(observed(*model, run.last(), "worn_volume") / worn, 1, 1e-9) << integrator;
  }
}

// A jump of the rate where a node has worn by a depth: the step after the event begins with the
// rate after it, so that methods agree to their order.
TEST(WearLawThatJumpsInDepth, KeepsItsOrderWithLocatedEvents) {
  const auto model = springs("k * p * v * if(h > 0.1, 0.3, 1)");
  const auto worn = [&](const char* integrator, double step) {
    return depths(run_model(*model, integrator, step, 1e-4, end, true).last().y);
  };
  const std::vector<double> fine = worn("sdirk-4", 1.25);
  for (const char* integrator : {"esdirk-4", "esdirk-3", "theta"}) {
    const double error = distance(worn(integrator, 5), fine);
    std::printf("%s, steps of 5 s: error %.1e mm\n", integrator, error);
    EXPECT_LT(error, std::string(integrator) == "theta" ? 1e-4 : 1e-6) << integrator;
  }
}

// Windows that are short against the run are found, whatever the condition is.
TEST(WearLawOfAShortWindow, IsFound) {
  for (const char* factor : {"if((t - 20)^2 < 1e-4, 4000, 0)", "if(abs(t - 20) < 0.01, 4000, 0)",
                             "if(t > 19.99 and t < 20.01, 4000, 0)"}) {
    SCOPED_TRACE(factor);
    const auto model = springs(std::string("k * p * v * (1 + ") + factor + ")");
    const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-4, end);
    EXPECT_NEAR(observed(*model, run.last(), "worn_volume") / (k * v * F * (end + 80)), 1, 1e-9);
  }
  const auto pulse = springs("k * p * v * (1 + 2000 * max(1 - (t - 20.25)^2 / 0.04, 0))");
  const ModelRun run = run_model(*pulse, "esdirk-4", 0, 1e-4, end);
  const double integral = 2000 * 4.0 / 3 * 0.2;
  EXPECT_NEAR(observed(*pulse, run.last(), "worn_volume") / (k * v * F * (end + integral)), 1,
              1e-4);
}

// Its mean over time is what wears, and no steps find it.
TEST(WearLawOfAnOscillation, IsRefusedUnlessFixedStepsFollowIt) {
  const std::string rate = "k * p * v * (1 + sin(2*pi*1000*t))";
  EXPECT_THAT([&] { springs(rate); }, ::testing::ThrowsMessage<InputError>(::testing::HasSubstr(
                                          "expected changes with time that steps can follow")));
  EXPECT_THAT(springs(rate, {"integrator.step=1e-4"})->remarks,
              ::testing::Not(::testing::Contains(::testing::HasSubstr("time"))));
}

// A smooth pulse after a long quiet time: no method steps over it at any tolerance.
TEST(WearLawOfAPulse, IsSeenByEveryMethodThatFollowsTheError) {
  const double at = 100.0 / 3, lasts = 0.1, integral = 1000 * lasts * std::sqrt(M_PI);
  for (const double tolerance : {1e-2, 1e-4}) {
    const auto model =
        springs(fmt::format("k * p * v * (1 + 1000 * exp(-((t - {}) / {})^2))", at, lasts),
                {fmt::format("integrator.rtol={}", tolerance)});
    EXPECT_THAT(model->remarks,
                ::testing::Contains(::testing::HasSubstr("changes with time by itself")));
    for (const Integrator& integrator : Integrators::all()) {
      const ModelRun run = run_model(*model, integrator.name, 0, tolerance, end);
      const double worn = observed(*model, run.last(), "worn_volume") / (k * v * F);
      EXPECT_NEAR(worn / (end + integral), 1, 10 * tolerance) << integrator.name;
    }
  }
}

/// The springs under a flat that is as good as plane: all wear alike, v k F / width.
std::unique_ptr<Model> flat_springs(const std::string& rate, const Overrides& more = {}) {
  Overrides all = {"pin.radius=1e9", fmt::format("time.end={}", end)};
  all.insert(all.end(), more.begin(), more.end());
  return springs(rate, all);
}

// All springs reach the depth of a jump at once. The step across it is as short as the tolerance
// asks for.
TEST(WearLawThatJumpsInDepth, IsFollowedByErrorControl) {
  const double slow = k * v * F / width, at = 0.37 * end;
  const std::string rate = fmt::format("k * p * v * if(h < {}, 1, 5)", slow * at);
  const double worn = slow * width * (at + 5 * (end - at));
  const auto model = flat_springs(rate);
  for (const double tolerance : {1e-2, 1e-3, 1e-4})
    for (const Integrator& integrator : Integrators::all()) {
      if (integrator.order == "1" && tolerance < 1e-3) continue;
      const ModelRun run = run_model(*model, integrator.name, 0, tolerance, end);
      EXPECT_NEAR(observed(*model, run.last(), "worn_volume") / worn, 1, 3 * tolerance)
          << integrator.name << " at " << tolerance;
      EXPECT_LT(run.states.size(), tolerance < 1e-3 ? 150 : 80) << integrator.name;
    }
}

// Behind the event nothing wears, and the integral of the rates knows it.
TEST(WearLawThatJumpsInDepth, HasTheIntegralOfItsOtherSideWithLocatedEvents) {
  const auto model =
      flat_springs(fmt::format("k * p * v * if(h < {}, 5, 0)", k * v * F / width * end));
  for (const char* integrator : {"forward-euler", "erk-3", "esdirk-3"}) {
    IntegratorSettings settings = controlled_settings(*model, 1e-4, end);
    settings.locate_events = true;
    const RunOutcome outcome =
        run(*model, Integrators::find(integrator, "integrator"), settings, {}, nullptr, {});
    ASSERT_EQ(outcome.status, RunOutcome::Status::finished) << integrator;
    EXPECT_NEAR(*value_of(outcome.last->scalars, "wear_integral") /
                    *value_of(outcome.last->scalars, "worn_volume"),
                1, 1e-3)
        << integrator;
  }
}

// Behind the layer the law is what it was before, and steps are as long as the way to it.
TEST(WearLawOfALayer, IsNotSteppedOver) {
  const double rate = k * v * F / width, from = 0.5 * rate * end, thick = 0.002 * rate * end;
  const auto model =
      flat_springs(fmt::format("k * p * v * if(h > {} and h < {}, 0.01, 1)", from, from + thick));
  const double depth = from + thick + 0.3 * rate * end;
  for (const char* integrator : {"esdirk-3", "esdirk-5", "erk-3", "erk-4"}) {
    const ModelRun run = run_model(*model, integrator, 0, 1e-4, end);
    EXPECT_NEAR(observed(*model, run.last(), "worn_volume") / (depth * width), 1, 3e-3)
        << integrator;
  }
}

// Conditions that change at t = 0 and rates that end at zero there, within rounding.
TEST(WearLawOfAWave, IsTakenByEveryMethod) {
  const std::map<std::string, double> means = {{"if(sin(2*pi*t/20) > 0, 2, 1)", 1.5},
                                               {"if(sin(2*pi*t/20) < 0, 2, 1)", 1.5},
                                               {"max(sin(2*pi*t/20), 0)", 1 / M_PI},
                                               {"abs(sin(2*pi*t/20))", 2 / M_PI}};
  ASSERT_EQ(std::fmod(end, 20), 0);
  for (const auto& [factor, mean] : means) {
    const auto model = springs("k * p * v * " + factor);
    for (const Integrator& integrator : Integrators::all()) {
      const ModelRun run = run_model(*model, integrator.name, 0, 1e-5, end);
      EXPECT_NEAR(observed(*model, run.last(), "worn_volume") / (k * v * F * end * mean), 1, 1e-2)
          << integrator.name << ", " << factor;
    }
  }
}

// Where every spring has a time of its own, the steps between are as long as the tolerance allows,
// and not one for each spring.
TEST(WearLawThatJumpsInDepth, CostsNoEventForEveryNode) {
  const auto model = springs("k * p * v * if(h > 0.1, 0.3, 1)");
  const std::vector<double> fine =
      depths(run_model(*model, "sdirk-4", 1.25, 1e-4, end, true).last().y);
  const double largest = *std::max_element(fine.begin(), fine.end());
  for (const double tolerance : {1e-2, 1e-3}) {
    const ModelRun run = run_model(*model, "esdirk-3", 0, tolerance, end);
    EXPECT_LT(distance(depths(run.last().y), fine), 3 * tolerance * largest);
    std::printf("rtol %g: %zu steps, %ld rejected, error %.1e\n", tolerance, run.states.size() - 1,
                run.counters.rejected_steps, distance(depths(run.last().y), fine) / largest);
  }
}

// Jumps close to each other, and steps so short that times differ by little more than rounding.
TEST(WearLawThatJumpsOften, IsTakenByExplicitMethods) {
  const auto model =
      springs("k * p * v * (1 + if(t * 0.7 < 70, 0, 1) * 0.5 + if(t * 0.1 < 10, 0, 1) * 0.5)");
  for (const char* integrator : {"erk-2", "erk-3", "erk-4"}) {
    const ModelRun run = run_model(*model, integrator, 0, 1e-6, end);
    EXPECT_NEAR(observed(*model, run.last(), "worn_volume") / (k * v * F * 300), 1, 1e-9)
        << integrator;
  }
}

}  // namespace
}  // namespace gnomon::wear_laws_test
