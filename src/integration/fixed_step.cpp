#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include <gnomon/error.hpp>
#include <gnomon/integration/fixed_step.hpp>

namespace gnomon {

FixedStepper::FixedStepper(int order, const IntegratorSettings& settings, Counters& counters,
                           Try attempt)
    : order_(order),
      step_(settings.step),
      substep_(settings.step),
      counters_(counters),
      attempt_(std::move(attempt)) {}

StepReport FixedStepper::advance(State& state, double t_stop) {
  constexpr int max_halvings = 30;
  const long newton_before = counters_.newton_iterations;
  // The next point of the grid, by count rather than by adding up, so that it does not drift.
  const double next_grid = step_ * (std::floor(state.t / step_ * (1 + 1e-12) + 1e-9) + 1);
  const double target = std::min(next_grid, t_stop);
  StepReport report;
  std::string reason;
  for (int halvings = 0; halvings <= max_halvings; ++halvings) {
    const bool lands = substep_ >= (target - state.t) * (1 - 1e-9);
    const double h = lands ? target - state.t : substep_;
    const Attempt attempt = attempt_(state, h, next_);
    if (attempt.success) {
      std::swap(state, next_);
      state.t = lands ? target : state.t;
      substep_ = std::min(step_, 2 * std::max(h, substep_));
      ++counters_.steps;
      report.step = h;
      report.order = order_;
      report.newton_iterations = counters_.newton_iterations - newton_before;
      return report;
    }
    reason = attempt.reason;
    report.restarted = true;
    ++counters_.rejected_steps;
    substep_ = h / 2;
  }
  throw SolutionError(fmt::format("no step from t = {:.6g} succeeds, down to {:.3g}: {}", state.t,
                                  substep_, reason));
}

void set_rates(const System& system, State& state) {
  std::vector<double> F(state.y.size());
  state.ydot.assign(state.y.size(), 0.0);
  system.residual(state.t, state.y, state.ydot, F);
  const std::vector<char>& differential = system.structure().differential;
  for (std::size_t i = 0; i < F.size(); ++i)
    if (differential[i]) state.ydot[i] = -F[i];
}

}  // namespace gnomon
