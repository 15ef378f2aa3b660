// The step at which real, nonlinear steps become unstable against the one that the spectrum
// predicts.

#include <cmath>
#include <gnomon/integration/error_norm.hpp>
#include <gnomon/integration/stage_solver.hpp>
#include <gnomon/integration/stepper.hpp>
#include <gnomon/stability.hpp>
#include <gnomon/sundials/arkode_table.hpp>

#include "support/pin.hpp"

namespace gnomon {
namespace {

using namespace testing;

/// Any explicit table on the reduced ODE, without an error estimate.
class Explicit : public OneStepMethod {
public:
  Explicit(const System& system, const IntegratorSettings& settings, Counters& counters,
           ButcherTable table)
      : system_(system),
        components_(ErrorNorm(system.structure(), settings).components()),
        stages_(system, counters),
        table_(std::move(table)) {}

  Attempt attempt(const State& from, double h, const AttemptOptions& options, State& to) override {
    std::vector<std::vector<double>> rates;
    to = from;
    for (int i = 0; i < table_.stages(); ++i) {
      advance(from, h, table_.A.row(i).transpose(), rates, to);
      if (const Attempt stage = project(to, options); !stage.success) return stage;
      rates.push_back(to.ydot);
    }
    advance(from, h, table_.b, rates, to);
    to.t = from.t + h;
    return project(to, options);
  }
  Attempt project(State& state, const AttemptOptions& options) override {
    std::string reason = stages_.solve(state.y, options.piece);
    if (!reason.empty()) return {.reason = std::move(reason)};
    set_rates(system_, options.piece, state);
    return {.success = true};
  }
  void accept(const State&, bool) override {}
  const Trace& trace() const override { return trace_; }

private:
  void advance(const State& from, double h, const Eigen::VectorXd& weights,
               const std::vector<std::vector<double>>& rates, State& to) const {
    for (int i : components_) {
      to.y[i] = from.y[i];
      for (std::size_t j = 0; j < rates.size(); ++j) to.y[i] += h * weights[j] * rates[j][i];
    }
  }

  const System& system_;
  std::vector<int> components_;
  StageSolver stages_;
  ButcherTable table_;
  Trace trace_;
};

Integrator explicit_method(const std::string& table) {
  Integrator integrator;
  integrator.name = table;
  integrator.table = [table](const IntegratorSettings&) { return arkode_table(table); };
  integrator.make = [table](const Model& model, const IntegratorSettings& settings,
                            Counters& counters) -> std::unique_ptr<Stepper> {
    return std::make_unique<OneStepStepper>(
        model.system(), settings, counters,
        std::make_unique<Explicit>(model.system(), settings, counters, arkode_table(table)), 1, 1);
  };
  return integrator;
}

/// Onset over prediction.
double agreement(const Model& model, const Integrator& integrator, const State& state) {
  const std::vector<Mode> modes = all_modes(ReducedJacobian(model.system(), state).dense());
  const CriticalStep critical = critical_step(integrator.table({}).value(), modes);
  EXPECT_GE(critical.mode, 0);
  // From a poor guess, so that the search is the test's and not the prediction's.
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
  for (const char* table :
       {"ARKODE_HEUN_EULER_2_1_2", "ARKODE_BOGACKI_SHAMPINE_4_2_3", "ARKODE_ZONNEVELD_5_3_4"})
    EXPECT_NEAR(agreement(*model, explicit_method(table), state), 1, 0.1) << table;
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
}  // namespace gnomon
