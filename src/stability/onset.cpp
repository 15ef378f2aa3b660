#include <fmt/format.h>

#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/stepper.hpp>
#include <gnomon/model/controlled_settings.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <gnomon/stability/stability.hpp>

#include "stability/resting_model.hpp"

namespace gnomon {

namespace {

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
              const Eigen::VectorXcd& direction, const OnsetOptions& options)
      : integrator_(integrator),
        options_(options),
        model_(model, consistent(model.system(), state)) {
    const std::vector<char>& differential = model.system().structure().differential;
    for (int i = 0; i < static_cast<int>(differential.size()); ++i)
      if (differential[i]) components_.push_back(i);
    Counters counters;
    rest_ = model_.start(counters);
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
    const double length = options_.perturbation * model_.differential_scale;
    const double factor = length / real.cwiseAbs().maxCoeff();
    perturbed_ = rest_;
    for (std::size_t k = 0; k < components_.size(); ++k)
      perturbed_.y[components_[k]] += factor * real[static_cast<Eigen::Index>(k)];
    perturbed_ = consistent(model_.system(), perturbed_);
  }

  /// Takes steps of exactly this size; returns false if one of them had to be shortened. Fixed
  /// steps end on the multiples of their size, so time is shifted to such a multiple, by at most
  /// half a step.
  bool take(State& state, double step) const {
    const double first = std::round(state.t / step);
    IntegratorSettings settings = controlled_settings(model_, 1, (first + options_.steps) * step);
    settings.step = step;
    Counters counters;
    const auto stepper = integrator_.make(model_.system(), settings, counters);
    state.t = first * step;
    for (int k = 1; k <= options_.steps; ++k)
      if (stepper->advance(state, (first + k) * step).restarted) return false;
    return true;
  }

  double distance(const State& state) const {
    double sum = 0;
    for (int i : components_) sum += (state.y[i] - rest_.y[i]) * (state.y[i] - rest_.y[i]);
    return std::sqrt(sum);
  }

  const Integrator& integrator_;
  OnsetOptions options_;
  RestingModel model_;
  State rest_, perturbed_;
  std::vector<int> components_;
};

}  // namespace

double empirical_onset(const Model& model, const Integrator& integrator, const State& state,
                       const Eigen::VectorXcd& direction, double guess,
                       const OnsetOptions& options) {
  const OnsetSearch search(model, integrator, state, direction, options);
  double stable = guess, unstable = guess;
  while (search.grows(stable) && stable > guess / 10) stable /= 1.25;
  while (!search.grows(unstable) && unstable < guess * 10) unstable *= 1.25;
  if (search.grows(stable) || !search.grows(unstable))
    throw SolutionError(
        fmt::format("{}: no onset of instability between steps of {:.3g} and {:.3g}",
                    integrator.name, stable, unstable));
  while (unstable - stable > options.accuracy * stable) {
    const double middle = (stable + unstable) / 2;
    (search.grows(middle) ? unstable : stable) = middle;
  }
  return (stable + unstable) / 2;
}

}  // namespace gnomon
