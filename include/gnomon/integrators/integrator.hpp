// An integrator is a value: its name, its properties, and how to make a stepper for a system.
#pragma once

#include <functional>
#include <gnomon/base/counters.hpp>
#include <gnomon/integrators/butcher_table.hpp>
#include <gnomon/scene/registry.hpp>
#include <gnomon/system/state.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon {

/// The `integrator.*` keys of a scene, as numbers.
struct IntegratorSettings {
  double step = 0;  ///< fixed step [time]; 0: chosen by the error estimate
  double rtol = 0;  ///< relative tolerance of the differential components, per step
  double atol = 0;  ///< absolute tolerance [unit of the differential components]
  /// Part of the tolerated error of a step, or of the error of a fixed step, that its Newton
  /// iterations may leave; 0: solved to rounding (NewtonOptions::tolerance).
  double nonlinear_fraction = 0;
  double max_step = 0;  ///< upper bound on an adaptive step [time]; 0: none
  double scale = 0;     ///< ModelFacts::differential_scale [unit of the differential components]
  bool locate_events = false;  ///< end steps on changes of the active set
  bool stop_unstable = false;  ///< end runs whose fixed steps do not damp
  double end = 0;              ///< time at which the run ends [time]
  /// Times, ascending, at which the algebraic components shall be accurate too: where a node has
  /// just closed, steps that follow the error end there with two short ones (Settling in
  /// stop_times.hpp). Only for integrators that settle (Integrator::settles).
  std::vector<double> settled{};
  /// The integrand of StepReport::integral, at a consistent point of the system including ydot [any
  /// unit]. Empty: nothing is integrated. It has a value wherever the residual has one; its
  /// exceptions pass through. It does not change the steps.
  std::function<double(const Point&)> integrand{};
  /// Abilities::behind_jump, or none.
  std::function<State(const State&)> behind_jump{};
  std::map<std::string, SceneValue> own{};  ///< what is given for Integrator::keys, by their names
  /// The value of one of these keys.
  SceneValue value(const Key& key) const {
    const auto given = own.find(key.name);
    return given == own.end() ? key.default_value.value() : given->second;
  }
};

/// Report on one accepted step.
struct StepReport {
  double step = 0;             ///< its size [time]
  int order = 0;               ///< order of the method that took it; 0: not known
  long newton_iterations = 0;  ///< spent on it, including rejected attempts; set by advance()
  bool restarted = false;      ///< attempts were rejected before it was accepted; set by advance()
  int switched = 0;            ///< contact nodes whose change of state was located at its end
  /// Integral of the integrand over the step, by the formula that the method applies to the rates
  /// of the differential components [unit of the integrand x time]. So if a component has the rate
  /// f, its change is equal to the integral of f up to the tolerance of the solves, for every step
  /// size.
  double integral = 0;
};

/// Advances a state. Made for one run; holds the method's memory.
class Stepper {
public:
  /// `counters`: those of the run. advance() counts the steps there; a method counts all other
  /// work: attempts that it rejects, Newton iterations.
  explicit Stepper(Counters& counters) : counted_(counters) {}
  virtual ~Stepper() = default;
  /// Takes one accepted step from `state`, ending at t_stop at the latest (exactly at t_stop if the
  /// step would pass it), and also on the breakpoints of the system (Structure). Updates `state`
  /// to a consistent state. Throws SolutionError when no step can be taken; `state` is then
  /// unchanged (the last good one).
  StepReport advance(State& state, double t_stop) {
    const Counters before = counted_;
    StepReport report = take_step(state, t_stop);
    ++counted_.steps;
    report.newton_iterations = counted_.newton_iterations - before.newton_iterations;
    report.restarted = counted_.rejected_steps > before.rejected_steps;
    return report;
  }

  /// The data of earlier steps, besides the state, that the next step uses, as numbers for a
  /// checkpoint; their count is always the same.
  virtual std::vector<double> memory() const { return {}; }
  /// Called before the first step: continues from a state that a stepper of the same method
  /// reached, with the memory that it had there.
  virtual void restore(const State&, std::span<const double> /*memory*/) {}
  /// Called before the first step, where a new epoch begins: goes on after `before`, a stepper of
  /// the same method, from `state`, its last one in the unknowns of this stepper's system. `same`:
  /// the unknowns are those of `before`. Returns false if the method restarts there at order one.
  virtual bool follow(Stepper& /*before*/, const State& /*state*/, bool /*same*/) { return false; }

private:
  /// What advance() does, besides counting.
  virtual StepReport take_step(State& state, double t_stop) = 0;

  Counters& counted_;
};

struct Integrator {
  std::string name;            ///< "backward-euler"
  std::string family;          ///< "explicit, decoupled", "implicit one-step", "multistep"
  std::string order;           ///< "1", "1-5"
  std::string error_estimate;  ///< order of the embedded method, or another source of the estimate
  std::string stability;       ///< "A, L, stiffly accurate", "conditional", ...
  std::string driver;          ///< "KINSOL", "IDA"
  std::string help;            ///< one line, with the source (equation or reference)
  bool fixed_steps = true;     ///< accepts integrator.step
  bool locates_events = true;  ///< accepts integrator.events = "locate"
  /// Its short steps damp errors of the algebraic components (IntegratorSettings::settled). An
  /// explicit method solves for them again in every step, so there is nothing to settle.
  bool settles = true;
  /// Keys of its own: integrator.*, with defaults, because they are in the tables of all scenes.
  std::vector<Key> keys = {};
  /// The coefficients, for Runge-Kutta methods (the Euler schemes and theta included).
  std::function<std::optional<ButcherTable>(const IntegratorSettings&)> table;
  std::function<std::unique_ptr<Stepper>(const System&, const IntegratorSettings&, Counters&)> make;

  /// By its table; a method without one is not.
  bool is_explicit() const {
    const std::optional<ButcherTable> coefficients = table({});
    return coefficients && gnomon::is_explicit(*coefficients);
  }

  /// What a registration needs and this value lacks (Registry). A method without a table says so:
  /// `table` returns nothing.
  std::string missing() const { return !table ? "table" : !make ? "make" : ""; }
};

using Integrators = Registry<Integrator>;

}  // namespace gnomon
