// A tiny model for tests of the run loop: y' = -y, y(0) = 1, integrated with its exact solution.
// The worn volume is 1 - y and its flux y, so that everything has a closed form.
#pragma once

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/model.hpp>
#include <gnomon/system/system.hpp>
#include <stdexcept>

namespace gnomon::test {

/// Has a structure, because the run loop needs it, but no equations, because the stepper is exact.
class NoSystem : public System {
public:
  const Structure& structure() const override { return structure_; }
  void residual(const Point&, std::span<double>) const override { refuse(); }
  void jacobian(const Point&, double, std::span<double>) const override { refuse(); }
  void switching(const Point&, std::span<double>) const override { refuse(); }
  std::vector<AlgebraicStage> algebraic_stages() const override { refuse(); }

private:
  [[noreturn]] static void refuse() { throw std::logic_error("not needed here"); }
  Structure structure_{.size = 1, .differential = {1}};
};

class Decay : public Model {
public:
  Decay() {
    blocks = {{"amount", "y", 1, "everywhere"}};
    differential_scale = 0.25;
    wear_flux = [](const Point& at) { return at.y[0]; };
    exact = [](double t) { return State{t, {std::exp(-t)}, {-std::exp(-t)}}; };
  }
  const System& system() const override { return system_; }
  State start(Counters& counters) const override {
    counters.newton_iterations += 3;
    if (!starts) throw SolutionError("no equilibrium");
    return {0, {1.0}, {-1.0}};
  }
  Observation observe(const State& state) const override {
    return {common("worn_volume", 1 - state.y[0]), common("wear_flux", state.y[0])};
  }
  std::vector<GridField> fields(const State&) const override { return {}; }
  std::optional<ContactSurface> contact(const State& state) const override {
    ContactSurface surface;
    surface.node = {0};
    surface.initial = {{0, 0, 0}};
    surface.worn = surface.current = {{0, 1 - state.y[0], 0}};
    surface.pressure = {state.y[0]};
    surface.wear_depth = {1 - state.y[0]};
    surface.active = {1};
    return surface;
  }

  bool starts = true;

private:
  NoSystem system_;
};

/// Exact steps of a given size, with exact integrals of functions that are linear in y; fails at
/// `fail_at`.
class ExactDecay : public Stepper {
public:
  ExactDecay(const IntegratorSettings& settings, Counters& counters, double fail_at)
      : Stepper(counters),
        step_(settings.step),
        integrand_(settings.integrand),
        counters_(counters),
        fail_at_(fail_at) {}

private:
  StepReport take_step(State& state, double t_stop) override {
    if (state.t >= fail_at_) throw SolutionError("inverted element 7");
    const bool lands = state.t + step_ >= t_stop * (1 - 1e-12);
    const double t = lands ? t_stop : state.t + step_;
    StepReport report{.step = t - state.t, .order = 1};
    const double mean = (std::exp(-state.t) - std::exp(-t)) / report.step;
    if (integrand_) report.integral = report.step * integrand_({.t = t, .y = {&mean, 1}});
    state = {t, {std::exp(-t)}, {-std::exp(-t)}};
    counters_.newton_iterations += 2;
    return report;
  }

  double step_;
  std::function<double(const Point&)> integrand_;
  Counters& counters_;
  double fail_at_;
};

inline Integrator exact_decay(double fail_at = INFINITY) {
  Integrator integrator;
  integrator.name = "exact-decay";
  integrator.make = [fail_at](const System&, const IntegratorSettings& settings,
                              Counters& counters) -> std::unique_ptr<Stepper> {
    return std::make_unique<ExactDecay>(settings, counters, fail_at);
  };
  return integrator;
}

}  // namespace gnomon::test
