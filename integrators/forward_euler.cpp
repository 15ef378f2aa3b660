// forward-euler: the explicit scheme of eq. (15). The rate is known at the start of the step; the new
// surface is then given, and mesh motion and contact are solved one after the other (Remark 1).
//
//   d_{n+1} = d_n + h ddot_n,   ddot_n = -Wdot_n N_n   on the contact surface

#include <gnomon/error.hpp>
#include <gnomon/integration/fixed_step.hpp>
#include <gnomon/integration/stage_solver.hpp>

namespace gnomon {

namespace {

class ForwardEuler {
public:
  ForwardEuler(const System& system, Counters& counters)
      : system_(system), stages_(std::make_shared<StageSolver>(system, counters)) {}

  Attempt operator()(const State& state, double h, State& next) {
    next = state;
    next.t = state.t + h;
    for (std::size_t i = 0; i < next.y.size(); ++i)
      if (system_.structure().differential[i]) next.y[i] += h * state.ydot[i];
    const std::string reason = stages_->solve(next.y);
    if (!reason.empty()) return {false, reason};
    set_rates(system_, next);
    return {true, {}};
  }

private:
  const System& system_;
  std::shared_ptr<StageSolver> stages_;
};

const Registration<Integrator> registration({
    .name = "forward-euler",
    .family = "explicit one-step, decoupled",
    .order = "1",
    .stability = "conditional, |1 + z| <= 1",
    .driver = "KINSOL (contact and mesh motion)",
    .step_control = "fixed",
    .help = "the paper's explicit scheme, eq. (15): one contact problem a step, unstable above a "
            "critical step",
    .make = [](const Model& model, const IntegratorSettings& settings, Counters& counters)
        -> std::unique_ptr<Stepper> {
      return std::make_unique<FixedStepper>(1, settings, counters,
                                            ForwardEuler(model.system(), counters));
    },
});

}  // namespace

}  // namespace gnomon
