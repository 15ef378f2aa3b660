#include <fmt/format.h>

#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/stepper.hpp>
#include <gnomon/model/controlled_settings.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <gnomon/stability/stability.hpp>
#include <utility>

namespace gnomon {

namespace {

constexpr double perturbation = 1e-6;       // in units of ModelFacts::differential_scale
constexpr double accuracy_of_onset = 0.01;  // relative

/// Differential rows ydot + f(t_0, y) - f(t_0, y_0); all other rows are unchanged.
class RestingSystem : public System {
public:
  /// `state`: with its rates. Both must outlive the object.
  RestingSystem(const System& system, const State& state)
      : system_(system), state_(state), structure_(system.structure()) {
    structure_.breakpoints.clear();
    structure_.stops.clear();
  }

  const Structure& structure() const override { return structure_; }
  void residual(const Point& at, std::span<double> F) const override {
    system_.residual({state_.t, at.y, at.ydot, at.branch}, F);
    for (std::size_t i = 0; i < F.size(); ++i)
      if (structure().differential[i]) F[i] += state_.ydot[i];
  }
  void jacobian(const Point& at, double alpha, std::span<double> values) const override {
    system_.jacobian({state_.t, at.y, at.ydot, at.branch}, alpha, values);
  }
  void switching(const Point& at, std::span<double> values) const override {
    system_.switching({.t = state_.t, .y = at.y}, values);
  }
  std::vector<AlgebraicStage> algebraic_stages() const override {
    std::vector<AlgebraicStage> stages = system_.algebraic_stages();
    for (AlgebraicStage& stage : stages)
      stage.freeze = [freeze = std::move(stage.freeze), t = state_.t](
                         double, std::span<const double> y) { freeze(t, y); };
    return stages;
  }

private:
  const System& system_;
  const State& state_;
  Structure structure_;
};

/// The state, made consistent within the tolerance of the steppers' own solves, with its rates.
State consistent(const System& system, State state) {
  Counters counters;
  AlgebraicSolver stages(system, counters);
  if (const std::string reason = stages.solve(state.t, state.y); !reason.empty())
    throw SolutionError("a perturbed state cannot be made consistent: " + reason);
  set_rates(system, nullptr, state);
  return state;
}

class OnsetSearch {
public:
  OnsetSearch(const Model& model, const Integrator& integrator, const State& state,
              const Eigen::VectorXcd& direction)
      : model_(model),
        integrator_(integrator),
        origin_(consistent(model.system(), state)),
        system_(model.system(), origin_),
        rest_(origin_) {
    const std::vector<char>& differential = system_.structure().differential;
    for (int i = 0; i < static_cast<int>(differential.size()); ++i)
      if (differential[i]) components_.push_back(i);
    rest_.ydot.assign(rest_.y.size(), 0.0);
    perturb(direction);
  }

  /// Whether the perturbation grows over steps of this size. If a step cannot be taken, it does.
  bool grows(double step) const {
    State state = perturbed_;
    try {
      return !take(state, step) || distance(state) > distance(perturbed_);
    } catch (const SolutionError&) {
      return true;
    }
  }

private:
  /// Perturbs by the real part of the direction; its largest entry has the prescribed size.
  void perturb(const Eigen::VectorXcd& direction) {
    const Eigen::VectorXd real = direction.real();
    const double length = perturbation * model_.differential_scale;
    const double factor = length / real.cwiseAbs().maxCoeff();
    perturbed_ = rest_;
    for (std::size_t k = 0; k < components_.size(); ++k)
      perturbed_.y[components_[k]] += factor * real[static_cast<Eigen::Index>(k)];
    perturbed_ = consistent(system_, perturbed_);
  }

  /// Takes steps of exactly this size; returns false if one of them had to be shortened. Fixed
  /// steps end on the multiples of their size, so time is shifted to such a multiple, by at most
  /// half a step.
  bool take(State& state, double step) const {
    const double first = std::round(state.t / step);
    IntegratorSettings settings = controlled_settings(model_, 1, (first + onset_steps) * step);
    settings.step = step;
    Counters counters;
    const auto stepper = integrator_.make(system_, settings, counters);
    state.t = first * step;
    for (int k = 1; k <= onset_steps; ++k)
      if (stepper->advance(state, (first + k) * step).restarted) return false;
    return true;
  }

  double distance(const State& state) const {
    double sum = 0;
    for (int i : components_) sum += (state.y[i] - rest_.y[i]) * (state.y[i] - rest_.y[i]);
    return std::sqrt(sum);
  }

  const Model& model_;
  const Integrator& integrator_;
  State origin_;  // with its rates
  RestingSystem system_;
  State rest_, perturbed_;
  std::vector<int> components_;
};

}  // namespace

double empirical_onset(const Model& model, const Integrator& integrator, const State& state,
                       const Eigen::VectorXcd& direction, double guess) {
  const OnsetSearch search(model, integrator, state, direction);
  double stable = guess, unstable = guess;
  while (search.grows(stable) && stable > guess / 10) stable /= 1.25;
  while (!search.grows(unstable) && unstable < guess * 10) unstable *= 1.25;
  if (search.grows(stable) || !search.grows(unstable))
    throw SolutionError(
        fmt::format("{}: no onset of instability between steps of {:.3g} and {:.3g}",
                    integrator.name, stable, unstable));
  while (unstable - stable > accuracy_of_onset * stable) {
    const double middle = (stable + unstable) / 2;
    (search.grows(middle) ? unstable : stable) = middle;
  }
  return (stable + unstable) / 2;
}

std::vector<State> accurate_states(const Model& model, std::span<const double> times,
                                   Counters& counters, double rtol) {
  std::vector<State> states;
  if (times.empty()) return states;
  State state = model.start(counters);
  const auto require_one_epoch = [&] {
    if (model.overdue && model.overdue(state))
      throw SolutionError(fmt::format(
          "at t = {:.4g} s the contact has come to other facets or boundary, of which critical "
          "steps are not known",
          state.t));
  };
  require_one_epoch();
  const auto stepper =
      Integrators::find("esdirk-4", "integrator")
          .make(model.system(), controlled_settings(model, rtol, times.back()), counters);
  for (double time : times) {
    while (state.t < time) stepper->advance(state, time);
    require_one_epoch();
    states.push_back(state);
  }
  return states;
}

}  // namespace gnomon
