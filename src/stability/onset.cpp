#include <fmt/format.h>

#include <cmath>
#include <gnomon/error.hpp>
#include <gnomon/integration/stage_solver.hpp>
#include <gnomon/integration/stepper.hpp>
#include <gnomon/stability.hpp>
#include <limits>

namespace gnomon {

namespace {

class OnsetSearch {
public:
  OnsetSearch(const Model& model, const Integrator& integrator, const State& state,
              const Eigen::VectorXcd& direction, const OnsetOptions& options)
      : model_(model), integrator_(integrator), options_(options), state_(state) {
    const std::vector<char>& differential = model.system().structure().differential;
    for (int i = 0; i < static_cast<int>(differential.size()); ++i)
      if (differential[i]) components_.push_back(i);
    perturb(direction);
  }

  /// Does the perturbation grow over steps of this size?
  bool grows(double step) const { return growth(step) > 1; }

private:
  void perturb(const Eigen::VectorXcd& direction);
  double growth(double step) const;
  bool take(State& state, double step) const;
  double distance(const State& a, const State& b) const;

  const Model& model_;
  const Integrator& integrator_;
  OnsetOptions options_;
  State state_, perturbed_;
  std::vector<int> components_;
};

/// The real part of the direction, as long as asked for in its largest entry.
void OnsetSearch::perturb(const Eigen::VectorXcd& direction) {
  const Eigen::VectorXd real = direction.real();
  const double length = options_.perturbation * model_.differential_scale();
  const double factor = length / real.cwiseAbs().maxCoeff();
  perturbed_ = state_;
  for (std::size_t k = 0; k < components_.size(); ++k)
    perturbed_.y[components_[k]] += factor * real[static_cast<Eigen::Index>(k)];
  Counters counters;
  StageSolver stages(model_.system(), counters);
  for (State* state : {&state_, &perturbed_}) {
    if (const std::string reason = stages.solve(state->y); !reason.empty())
      throw SolutionError("the perturbed state cannot be made consistent: " + reason);
    set_rates(model_.system(), nullptr, *state);
  }
}

double OnsetSearch::distance(const State& a, const State& b) const {
  double sum = 0;
  for (int i : components_) sum += (a.y[i] - b.y[i]) * (a.y[i] - b.y[i]);
  return std::sqrt(sum);
}

/// Steps of exactly this size; false when one of them had to be cut. Fixed steps end on the
/// multiples of their size, so time is shifted onto one, by half a step at most.
bool OnsetSearch::take(State& state, double step) const {
  const double first = std::round(state.t / step);
  IntegratorSettings settings;
  settings.step = step;
  settings.rtol = 1;
  settings.scale = settings.atol = model_.differential_scale();
  settings.end = (first + options_.steps) * step;
  Counters counters;
  const auto stepper = integrator_.make(model_, settings, counters);
  state.t = first * step;
  for (int k = 1; k <= options_.steps; ++k) {
    const StepReport report = stepper->advance(state, (first + k) * step);
    if (report.restarted) return false;
  }
  return true;
}

/// Of the perturbation over the steps, as a factor. What cannot be stepped over is unstable.
double OnsetSearch::growth(double step) const {
  State plain = state_, perturbed = perturbed_;
  try {
    if (!take(plain, step) || !take(perturbed, step))
      return std::numeric_limits<double>::infinity();
  } catch (const SolutionError&) {
    return std::numeric_limits<double>::infinity();
  }
  return distance(plain, perturbed) / distance(state_, perturbed_);
}

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
