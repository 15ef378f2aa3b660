// The step size at which actual, nonlinear steps become unstable, compared with the prediction of
// the spectrum.

#include <cmath>
#include <gnomon/stability/stability.hpp>

#include "support/pin.hpp"

namespace gnomon::onset_test {
namespace {

using namespace testing;

/// Onset over prediction.
double agreement(const Model& model, const Integrator& integrator, const State& state) {
  const std::vector<Mode> modes = all_modes(ReducedJacobian(model.system(), state).dense());
  const CriticalStep critical = critical_step(integrator.table({}).value(), modes);
  EXPECT_GE(critical.mode, 0);
  // From a poor guess, so that the result does not depend on the prediction.
  const double onset = empirical_onset(model, integrator, state, modes[critical.mode].direction,
                                       0.6 * critical.step);
  ::testing::Test::RecordProperty("onset_over_prediction " + integrator.name,
                                  std::to_string(onset / critical.step));
  return onset / critical.step;
}

TEST(Onset, OfForwardEulerIsTheCriticalStep) {
  for (const char* young : {"320", "640"}) {
    const auto model = pin_model({elements(20), std::string("body.young_modulus=") + young});
    Counters counters;
    const std::vector<double> times = {0, 100};
    const Integrator& euler = Integrators::find("forward-euler", "integrator");
    for (const State& state : accurate_states(*model, times, counters))
      EXPECT_NEAR(agreement(*model, euler, state), 1, 0.05) << young << " " << state.t;
  }
}

TEST(Onset, OfHigherOrdersIsTheirCriticalStep) {
  const auto model = pin_model({elements(10)});
  Counters counters;
  const std::vector<double> times = {200};
  const State state = accurate_states(*model, times, counters).front();
  for (const char* name : {"erk-2", "erk-3", "erk-4"})
    EXPECT_NEAR(agreement(*model, Integrators::find(name, "integrator"), state), 1, 0.05) << name;
}

TEST(AccurateStates, AreConsistentAndOnTime) {
  const auto model = pin_model({elements(10)});
  Counters counters;
  const std::vector<double> times = {0, 30, 100};
  const std::vector<State> states = accurate_states(*model, times, counters);
  ASSERT_EQ(states.size(), 3u);
  const double flux = observed(*model, states[0], "wear_flux");
  ASSERT_GT(flux, 0);
  for (int k : {0, 1, 2}) {
    EXPECT_EQ(states[k].t, times[k]);
    EXPECT_NEAR(observed(*model, states[k], "wear_flux"), flux, 1e-8 * flux);
    EXPECT_NEAR(observed(*model, states[k], "worn_volume"), flux * times[k], 0.01 * flux * 100);
  }
}

}  // namespace
}  // namespace gnomon::onset_test
