// forward-euler: the explicit scheme of eq. (15). The rate is known at the start of the step; the
// new surface is then given, and mesh motion and contact are solved one after the other (Remark 1).
//
//   d_{n+1} = d_n + h ddot_n,   ddot_n = -Wdot_n N_n   on the contact surface

#include <gnomon/integrators/dense_output.hpp>
#include <gnomon/integrators/error_norm.hpp>
#include <gnomon/integrators/stepper.hpp>
#include <gnomon/integrators/stop_times.hpp>
#include <gnomon/newton/algebraic_solver.hpp>

namespace gnomon {

namespace {

class ForwardEuler : public OneStepMethod {
public:
  ForwardEuler(const System& system, const IntegratorSettings& settings, Counters& counters)
      : system_(system),
        norm_(system.structure(), settings),
        integrand_(settings.integrand),
        algebraic_(system, counters, settings.nonlinear_fraction) {}

  Attempt attempt(const State& from, double h, const AttemptOptions& options, State& to) override {
    to = from;
    to.t = from.t + h;
    dense_output_.evaluate(to.t, to.y);
    for (int i : system_.structure().remembered) to.y[i] = from.y[i];
    for (int i : norm_.components()) to.y[i] = from.y[i] + h * from.ydot[i];
    // The next step of this size integrates the error of the rates.
    const Distance distance = [&](std::span<const double> before, std::span<const double> y) {
      return h * distance_of_rates(system_, norm_, options.branch, to, before, y) / options.error;
    };
    std::string reason =
        algebraic_.solve(inside_step(system_.structure(), from.t, to.t), to.y, options.branch,
                         options.error > 0 ? distance : Distance{});
    if (!reason.empty()) return {.reason = std::move(reason)};
    set_rates(system_, options.branch, to, from.t);
    // The difference from Heun's method.
    error_.clear();
    for (int i : norm_.components()) error_.push_back(h / 2 * (to.ydot[i] - from.ydot[i]));
    // Behind an event the rates are those of its other side.
    const ActiveSet* const branch = options.branch ? options.branch : from.own_branch();
    const double integral = integrand_ ? h * integrand_({from.t, from.y, from.ydot, branch}) : 0;
    return {.success = true, .error = norm_(error_, to.y), .integral = integral};
  }

  void accept(const State& state, bool kink) override {
    if (kink) dense_output_.clear();
    dense_output_.add(state.t, state.y);
  }
  void interpolate(double t, std::span<double> y) const override { dense_output_.evaluate(t, y); }

private:
  const System& system_;
  ErrorNorm norm_;
  std::function<double(const Point&)> integrand_;
  AlgebraicSolver algebraic_;
  DenseOutput dense_output_;
  std::vector<double> error_;
};

const Registration<Integrator> registration({
    .name = "forward-euler",
    .family = "explicit one-step, decoupled",
    .order = "1",
    .error_estimate = "difference from Heun",
    .stability = "conditional, |1 + z| <= 1",
    .driver = "KINSOL (contact and mesh motion)",
    .help = "the paper's explicit scheme, eq. (15): one contact problem per step, unstable above a "
            "critical step",
    .settles = false,
    .table =
        [](const IntegratorSettings&) {
          return ButcherTable{"eq. (15)", 1, Eigen::MatrixXd{{0.0}}, Eigen::VectorXd{{1.0}},
                              Eigen::VectorXd{{0.0}}};
        },
    .make = [](const System& system, const IntegratorSettings& settings,
               Counters& counters) -> std::unique_ptr<Stepper> {
      return std::make_unique<OneStepStepper>(
          system, settings, counters, std::make_unique<ForwardEuler>(system, settings, counters), 1,
          1);
    },
});

}  // namespace

}  // namespace gnomon
