// The worn pin under a varying load: wear, ends of steps, contact lost and regained.

#include <cmath>
#include <gnomon/run/run.hpp>

#include "support/pin.hpp"

namespace gnomon::load_history_test {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::HasSubstr;

constexpr double F = 20, k_v = 1e-4;

/// Down to a thousandth and up again, three times in 120 s.
const Overrides oscillating = {elements(10), "load.times=[0, 20, 40, 60, 80, 100, 120]",
                               "load.factors=[1, 1e-3, 1, 1e-3, 1, 1e-3, 1]"};
double breath(double t) {
  const double phase = std::fmod(t, 40) / 20;
  return phase < 1 ? 1 - 0.999 * phase : 0.001 + 0.999 * (phase - 1);
}

// Wear is k v F at every instant, and so its integral k v times that of F, without an error: the
// trapezoidal rule is exact, because steps end on the breakpoints.
TEST(LoadHistoryOfThePin, WearFollowsTheForceByEveryMethod) {
  for (const Integrator& integrator : Integrators::all())
    for (const bool locate : {false, true}) {
      if (locate && !integrator.locates_events) continue;
      SCOPED_TRACE(integrator.name + (locate ? ", events located" : ""));
      const PinRun run = run_pin(integrator.name, 0, 1e-2, 60, oscillating, locate, to_rounding);
      double integral = 0, flux = 0, t = 0;
      std::vector<double> times;
      for (const State& state : run.states) {
        const double now = observed(*run.model, state, "wear_flux");
        EXPECT_NEAR(now, k_v * F * breath(state.t), 1e-9 * k_v * F) << state.t;
        integral += (state.t - t) * (flux + now) / 2;
        flux = now, t = state.t;
        times.push_back(t);
      }
      for (const double breakpoint : {20.0, 40.0, 60.0}) EXPECT_THAT(times, Contains(breakpoint));
      EXPECT_NEAR(integral, k_v * F * 60 * 1.001 / 2, 1e-9);
    }
}

// Solves that end by the error of the step leave a part of the force that acts, not of the largest.
TEST(LoadHistoryOfThePin, ForcesBalanceUnderALightLoadToo) {
  for (const char* integrator : {"bdf", "esdirk-2", "esdirk-3", "esdirk-4"}) {
    const PinRun run = run_pin(integrator, 0, 1e-2, 60, oscillating);
    for (const State& state : run.states) {
      const double force = F * breath(state.t);
      EXPECT_NEAR(observed(*run.model, state, "contact_force"), force, 5e-3 * force)
          << integrator << ", t = " << state.t;
    }
  }
}

// One node carries the load and wears by k v F(t) / A, with A constant to 1e-6 at so little wear.
// The integral of a load that is linear within a step is exact for every method of order two or
// more, and adaptive methods integrate it within their tolerance, also if the load changes its
// slope at the end of a step and falls to a thousandth in the next.
TEST(LoadHistoryOfThePin, WornDepthFollowsALoadThatTurnsAndFalls) {
  const Overrides turning = {"mesh.elements=[4, 4]", "body.young_modulus=1e6",
                             "wear.coefficient=1e-11", "load.times=[0, 100, 101, 200]",
                             "load.factors=[1, 3, 1e-3, 0.1]"};
  const double loads = 200 + 1.5005 + 0.0505 * 99;  // integral of the factors
  const PinRun constant = run_pin("sdirk-2", 20, 0, 100, {turning.begin(), turning.begin() + 3});
  const double depth = constant.worn_depth() / 100 * loads;
  for (const Integrator& integrator : Integrators::all()) {
    SCOPED_TRACE(integrator.name);
    const bool fixed = integrator.name != "bdf";
    if (fixed && integrator.order == "1") continue;
    const PinRun run = run_pin(integrator.name, fixed ? 200 : 0, fixed ? 0 : 1e-5, 200, turning);
    EXPECT_EQ(run.observed("contact_nodes"), 1);
    EXPECT_NEAR(run.worn_depth(), depth, (fixed ? 1e-5 : 1e-3) * depth);
  }
}

// A difference of two shapes over so short a step is only rounding: the next step starts with the
// rates that follow from the pressures.
TEST(LoadHistoryOfThePin, AStepOfRoundingBehindACornerCostsNoAccuracy) {
  const Overrides turning = {elements(8), "wear.coefficient=2e-5", "load.times=[0, 0.3, 0.6]",
                             "load.factors=[1, 0.5, 1]", "time.end=1"};
  const auto model = pin_model(turning);
  const auto worn = [&](const Integrator& integrator, double between) {
    IntegratorSettings settings;
    settings.step = 0.1;
    settings.scale = model->differential_scale;
    settings.end = 1;
    Counters counters;
    State state = model->start(counters);
    const auto stepper = integrator.make(model->system(), settings, counters);
    for (const double stop : {0.3, between, 1.0})
      while (state.t < stop) stepper->advance(state, stop);
    return observed(*model, state, "max_pressure");
  };
  for (const Integrator& integrator : Integrators::all()) {
    if (!integrator.fixed_steps) continue;
    const double expected = worn(integrator, 0.3);
    for (const double beside : {0.30000000000000004, 0.3 + 1e-12, 0.3 + 1e-9})
      EXPECT_NEAR(worn(integrator, beside), expected, 1e-6 * expected)
          << integrator.name << " " << beside - 0.3;
  }
}

// Two factors at one time act as a short ramp around it does, by every method, with and without
// error control.
TEST(LoadHistoryOfThePin, AJumpActsFromItsTimeOn) {
  const Overrides jumping = {elements(10), "load.times=[0, 20, 20, 60]",
                             "load.factors=[1, 1, 2.5, 2.5]"};
  const Overrides rising = {jumping[0], "load.times=[0, 19.9, 20.1, 60]", jumping[2]};
  const double worn = run_pin("esdirk-4", 0, 1e-5, 60, rising).observed("worn_volume");
  for (const Integrator& integrator : Integrators::all())
    for (const double step : {0.0, 8.0}) {
      if (step > 0 && !integrator.fixed_steps) continue;
      SCOPED_TRACE(integrator.name + (step > 0 ? ", fixed steps" : ""));
      const PinRun run = run_pin(integrator.name, step, step > 0 ? 0 : 1e-4, 60, jumping);
      EXPECT_NEAR(run.observed("worn_volume"), worn, 2e-3 * worn);
      EXPECT_LT(run.states.size(), 120);
    }
}

TEST(LoadHistoryOfThePin, ItsTimesAreThoseToLandOnButForRounding) {
  const auto model = pin_model({"time.end=0.6000000000000001", "load.times=[0, 0.3, 0.6]",
                                "load.factors=[1, 2, 1]", "output.times=[0.30000000000000004]"});
  EXPECT_EQ(model->system().structure().breakpoints,
            (std::vector<double>{0, 0.30000000000000004, 0.6000000000000001}));
}

TEST(LoadHistoryOfThePin, FixedStepsReturnToTheirGrid) {
  for (const char* integrator : {"backward-euler", "forward-euler", "erk-2", "esdirk-3"}) {
    const PinRun run = run_pin(integrator, 15, 0, 60, oscillating);
    std::vector<double> times;
    for (const State& state : run.states) times.push_back(state.t);
    EXPECT_EQ(times, (std::vector<double>{0, 15, 20, 30, 40, 45, 60})) << integrator;
  }
}

// Most of the contact strip opens and closes in every cycle. Two families of methods agree on the
// worn shape.
TEST(LoadHistoryOfThePin, ContactIsLostAndRegained) {
  Overrides fine = oscillating;
  fine.front() = "mesh.elements=[30, 8]";
  const PinRun esdirk = run_pin("esdirk-4", 0, 1e-5, 120, fine, true);
  const PinRun bdf = run_pin("bdf", 0, 1e-5, 120, fine);
  const PinRun located = run_pin("bdf", 0, 1e-5, 120, fine, true);
  int losses = 0, gains = 0, before = 0;
  for (const State& state : esdirk.states) {
    const int nodes = int(observed(*esdirk.model, state, "contact_nodes"));
    losses += before > nodes;
    gains += before > 0 && nodes > before;
    before = nodes;
  }
  EXPECT_GE(losses, 2);
  EXPECT_GE(gains, 2);
  const Eigen::VectorXd X = esdirk.worn_surface();
  const double depth = esdirk.model->differential_scale;
  EXPECT_LT((bdf.worn_surface() - X).norm(), 100 * 1e-5 * depth);
  EXPECT_LT((located.worn_surface() - X).norm(), 100 * 1e-5 * depth);
  EXPECT_GE(esdirk.counters.events, 3);
}

// A run of an explicit method with fixed steps does not treat the oscillation of the load as an
// instability.
TEST(LoadHistoryOfThePin, LosingContactAtEveryTurnIsNoChattering) {
  const auto model = pin_model(oscillating);
  IntegratorSettings settings;
  settings.step = 1;
  settings.scale = model->differential_scale;
  settings.stop_unstable = true;
  settings.end = 120;
  const RunOutcome outcome =
      run(*model, Integrators::find("forward-euler", "integrator"), settings, {}, nullptr, {});
  EXPECT_EQ(outcome.text(), "finished");
  EXPECT_EQ(outcome.chattering_nodes, 0);
}

std::string refusal(const Overrides& overrides) {
  try {
    pin_model(overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(LoadHistoryOfThePin, RefusesWhatIsNoHistory) {
  EXPECT_THAT(refusal({"load.times=[0, 1]", "load.factors=[1]"}),
              HasSubstr("expected as many as load.times, 2, got 1"));
  EXPECT_THAT(refusal({"load.times=[0, 1, 1, 1]", "load.factors=[1, 2, 3, 4]"}),
              HasSubstr("got 1 after 1"));
  EXPECT_EQ(refusal({"load.times=[0, 1, 1]", "load.factors=[1, 2, 3]"}), "accepted");  // a jump
  EXPECT_THAT(refusal({"load.times=[0, 1]", "load.factors=[1, 0]"}),
              HasSubstr("expected 1e-06 or more, got 0: only a force keeps the bodies together"));
  EXPECT_THAT(refusal({"load.times=[0, 1]", "load.factors=[1, -1]"}), HasSubstr("got -1"));
  EXPECT_THAT(refusal({"load.times=[0, 1]", "load.factors=[1, 1e-6]", "load.force=1e-8"}),
              HasSubstr("strain the body by 1e-14 or more"));
  // Loads beyond the end of the run (1000 s) are never applied.
  EXPECT_EQ(refusal({"load.times=[0, 2000]", "load.factors=[1, 1e-6]", "load.force=2e-8"}),
            "accepted");
  EXPECT_THAT(refusal({"load.times=[-1, 1]", "load.factors=[1, 1]"}), HasSubstr("load.times"));
}

}  // namespace
}  // namespace gnomon::load_history_test
