// StepReport::integral: the integral of a function of the state by the method's own weights.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <gnomon/system/system.hpp>

#include "support/problem_run.hpp"
#include "support/switching_ode.hpp"

namespace gnomon::integral_test {
namespace {

using namespace testing;

class Integral : public ::testing::TestWithParam<std::string> {
protected:
  const Integrator& integrator() const { return Integrators::find(GetParam(), "integrator"); }
};

struct Integrated {
  Counters counters;
  std::vector<State> states;  // the start first
  double integral = 0;
  long restarted = 0;
};

Integrated integrate(const System& system, State state, const std::string& name,
                     IntegratorSettings settings) {
  Integrated run;
  run.states.push_back(state);
  const auto stepper = Integrators::find(name, "integrator").make(system, settings, run.counters);
  while (state.t < settings.end) {
    const StepReport report = stepper->advance(state, settings.end);
    run.integral += report.integral;
    run.states.push_back(state);
  }
  return run;
}

IntegratorSettings settings_of(double step, double rtol, double end) {
  IntegratorSettings settings;
  settings.step = step;
  settings.rtol = settings.atol = rtol;
  settings.scale = 1;
  settings.end = end;
  return settings;
}

/// A smooth function along the solution of a smooth problem, integrated to t = 2.
struct Smooth {
  std::unique_ptr<Model> model = model_of("dahlquist/nonlinear.toml");
  int component = 0;

  Smooth() {
    while (!model->system().structure().differential[component]) ++component;
  }
  double operator()(double t, std::span<const double> y) const {
    return std::cos(t) + y[component] * y[component];
  }
  double error(const std::string& name, double step, double rtol) const {
    IntegratorSettings settings = settings_of(step, rtol, 2);
    settings.integrand = [this](const Point& at) { return (*this)(at.t, at.y); };
    Counters counters;
    return std::abs(integrate(model->system(), model->start(counters), name, settings).integral -
                    exact());
  }
  /// By Simpson's rule on the exact solution.
  double exact() const {
    constexpr int n = 2000;
    double sum = 0;
    for (int k = 0; k <= n; ++k) {
      const double t = 2.0 * k / n, weight = k == 0 || k == n ? 1 : k % 2 ? 4 : 2;
      sum += weight * (*this)(t, model->exact(t).value().y);
    }
    return sum * 2.0 / n / 3;
  }
};

TEST_P(Integral, ConvergesWithTheOrderOfTheMethod) {
  const Smooth smooth;
  if (!integrator().fixed_steps) {
    const double loose = smooth.error(GetParam(), 0, 1e-4),
                 tight = smooth.error(GetParam(), 0, 1e-8);
    EXPECT_LT(loose, 0.1);
    EXPECT_LT(tight, 1e-3 * loose);
    return;
  }
  const int order = integrator().table(IntegratorSettings{})->order;
  const double step = order >= 4 ? 0.1 : 0.02;
  const double coarse = smooth.error(GetParam(), step, 1e-4);
  const double fine = smooth.error(GetParam(), step / 2, 1e-4);
  EXPECT_GT(fine, 1e-11);
  EXPECT_NEAR(std::log2(coarse / fine), order, 0.35);
}

/// Two springs that wear their points, one touched on the way, and a load with a breakpoint.
SprungPoints springs() {
  return SprungPoints({.borders = {-0.2, 0.313}, .wear = 2, .breakpoints = {0.7}});
}

/// The wear rate of point j: what its depth integrates.
std::function<double(const Point&)> wear_rate(const SprungPoints& system, int j) {
  return [&system, j](const Point& at) { return system.options().wear * at.y[system.pressure(j)]; };
}

// Worn depth and integrated wear rate are the same number, independent of the error of the method.
TEST_P(Integral, OfTheRateOfAComponentIsItsChange) {
  const SprungPoints system = springs();
  for (const double step : {0.0, 0.15})
    for (const bool locate : {false, true}) {
      if ((step > 0 && !integrator().fixed_steps) || (locate && !integrator().locates_events))
        continue;
      SCOPED_TRACE(::testing::Message() << "step " << step << ", located " << locate);
      IntegratorSettings settings = settings_of(step, 1e-3, 1);
      settings.locate_events = locate;
      for (const int j : {0, 1}) {
        settings.integrand = wear_rate(system, j);
        const Integrated run = integrate(system, system.start(), GetParam(), settings);
        const double change = run.states.back().y[SprungPoints::depth(j)] -
                              run.states.front().y[SprungPoints::depth(j)];
        EXPECT_GT(change, 0.1);
        EXPECT_NEAR(run.integral, change, 1e-10);
        EXPECT_EQ(run.counters.events > 0, locate);
      }
    }
}

TEST_P(Integral, ChangesNoStep) {
  const SprungPoints system = springs();
  IntegratorSettings settings = settings_of(0, 1e-4, 1);
  settings.locate_events = integrator().locates_events;
  const Integrated without = integrate(system, system.start(), GetParam(), settings);
  settings.integrand = wear_rate(system, 1);
  const Integrated with = integrate(system, system.start(), GetParam(), settings);
  EXPECT_EQ(without.integral, 0);
  EXPECT_EQ(with.counters.newton_iterations, without.counters.newton_iterations);
  EXPECT_EQ(with.counters.rejected_steps, without.counters.rejected_steps);
  ASSERT_EQ(with.states.size(), without.states.size());
  // ERKStep measures errors with an additional component of weight zero: the same up to rounding.
  for (std::size_t k = 0; k < with.states.size(); ++k) {
    EXPECT_NEAR(with.states[k].t, without.states[k].t, 1e-12);
    for (std::size_t i = 0; i < with.states[k].y.size(); ++i)
      EXPECT_NEAR(with.states[k].y[i], without.states[k].y[i], 1e-12);
  }
}

TEST_P(Integral, GoesOnAfterAResume) {
  const SprungPoints system = springs();
  IntegratorSettings settings = settings_of(0, 1e-4, 1);
  settings.integrand = wear_rate(system, 0);
  Counters counters;
  const auto first = integrator().make(system, settings, counters);
  State state = system.start();
  const double depth = state.y[SprungPoints::depth(0)];
  double integral = 0;
  while (state.t < 0.5) integral += first->advance(state, 0.5).integral;
  const auto second = integrator().make(system, settings, counters);
  second->restore(state, first->memory());
  while (state.t < settings.end) integral += second->advance(state, settings.end).integral;
  EXPECT_NEAR(integral, state.y[SprungPoints::depth(0)] - depth, 1e-10);
}

/// The run ends where a rate has no value: errors of the integrand are treated like those of a
/// residual.
TEST_P(Integral, LetsErrorsOfTheIntegrandThrough) {
  const SprungPoints system = springs();
  IntegratorSettings settings = settings_of(0, 1e-4, 1);
  settings.integrand = [](const Point&) -> double { throw InputError("no such quantity"); };
  EXPECT_THROW(integrate(system, system.start(), GetParam(), settings), InputError);
}

INSTANTIATE_TEST_SUITE_P(All, Integral, ::testing::ValuesIn(Integrators::names()),
                         [](const auto& info) {
                           std::string name = info.param;
                           for (char& c : name)
                             if (c == '-') c = '_';
                           return name;
                         });

}  // namespace
}  // namespace gnomon::integral_test
