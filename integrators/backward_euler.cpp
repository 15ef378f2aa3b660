// backward-euler: the implicit scheme of eq. (18), one coupled solve by KINSOL a step.
//
//   F(t + h, y, (y - y_n)/h) = 0,   J = dF/dy + (1/h) dF/dydot

#include <gnomon/integration/fixed_step.hpp>
#include <gnomon/sundials/newton.hpp>

namespace gnomon {

namespace {

class BackwardEuler {
public:
  BackwardEuler(const System& system, Counters& counters)
      : system_(system), newton_(std::make_shared<NewtonSolver>(system.structure(), counters)) {}

  Attempt operator()(const State& state, double h, State& next) {
    next = state;
    next.t = state.t + h;
    if (!previous_.y.empty()) extrapolate(state, h, next.y);
    const auto& differential = system_.structure().differential;
    const auto difference = [&](std::span<const double> y) {
      for (std::size_t i = 0; i < y.size(); ++i)
        next.ydot[i] = differential[i] ? (y[i] - state.y[i]) / h : 0;
    };
    const NonlinearFunction function{
        [&](std::span<const double> y, std::span<double> G) {
          difference(y);
          system_.residual(next.t, y, next.ydot, G);
        },
        [&](std::span<const double> y, std::span<double> values) {
          difference(y);
          system_.jacobian(next.t, y, next.ydot, 1 / h, values);
        }};
    const NewtonReport report = newton_->solve(function, next.y);
    if (!report.converged) return {false, report.reason};
    difference(next.y);
    previous_ = state;
    return {true, {}};
  }

private:
  /// First guess: the line through the last two states. Only Newton's start depends on it.
  void extrapolate(const State& state, double h, std::vector<double>& y) const {
    const double ratio = h / (state.t - previous_.t);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += ratio * (state.y[i] - previous_.y[i]);
  }

  const System& system_;
  std::shared_ptr<NewtonSolver> newton_;
  State previous_;  // the state before the last accepted step
};

const Registration<Integrator> registration({
    .name = "backward-euler",
    .family = "implicit one-step",
    .order = "1",
    .stability = "A, L",
    .driver = "KINSOL",
    .step_control = "fixed",
    .help = "the paper's implicit scheme, eq. (18): deformation and wear in one Newton solve",
    .make = [](const Model& model, const IntegratorSettings& settings, Counters& counters)
        -> std::unique_ptr<Stepper> {
      return std::make_unique<FixedStepper>(1, settings, counters,
                                            BackwardEuler(model.system(), counters));
    },
});

}  // namespace

}  // namespace gnomon
