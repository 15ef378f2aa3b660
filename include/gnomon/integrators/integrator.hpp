// An integrator is a value: its name, its properties, and how to make a stepper for a system.
#pragma once

#include <functional>
#include <gnomon/base/counters.hpp>
#include <gnomon/integrators/butcher_table.hpp>
#include <gnomon/scene/registry.hpp>
#include <gnomon/system/state.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace gnomon {

/// The `integrator.*` keys of a scene, as numbers.
struct IntegratorSettings {
  double step = 0;      ///< fixed step [time]; 0: chosen by the error estimate
  double rtol = 0;      ///< relative tolerance of the differential components, per step
  double atol = 0;      ///< absolute tolerance [unit of the differential components]
  double max_step = 0;  ///< upper bound on an adaptive step [time]; 0: none
  double scale = 0;     ///< Model::differential_scale() [unit of the differential components]
  double alpha = 0.5;   ///< of the theta method, eq. (21)
  bool locate_events = false;  ///< end steps on changes of the active set
  bool stop_unstable = false;  ///< end runs whose fixed steps do not damp
  int max_order = 5;           ///< upper bound on the order of a variable-order method
  double end = 0;              ///< time at which the run ends [time]
  /// What StepReport::integral integrates, at a consistent point of the system, ydot included [any
  /// unit]. Empty: nothing. It has a value wherever the residual has one; its exceptions pass
  /// through. Changes no step.
  std::function<double(const Point&)> integrand{};
};

/// What one accepted step was.
struct StepReport {
  double step = 0;             ///< its size [time]
  int order = 0;               ///< order of the method that took it
  long newton_iterations = 0;  ///< spent on it, rejected attempts included
  bool restarted = false;      ///< a step or more was rejected before this one was accepted
  int switched = 0;            ///< contact nodes whose change of state was located at its end
  /// Of the integrand over the step, by the formula that the method applies to the rates of the
  /// differential components [unit of the integrand x time]. So where a component has the rate f,
  /// its change is the integral of f up to the tolerance of the solves, whatever the step.
  double integral = 0;
};

/// Advances a state. Made for one run; holds the method's memory.
class Stepper {
public:
  virtual ~Stepper() = default;
  /// Takes one accepted step from `state`, ending at t_stop at the latest (exactly at t_stop when
  /// the step would pass it), and so on the breakpoints of the system (Structure). Updates `state`
  /// to a consistent state. Throws SolutionError when no step can be taken; `state` is then
  /// unchanged (the last good one).
  virtual StepReport advance(State& state, double t_stop) = 0;

  /// What the next step takes over from earlier ones beside the state, where it is to be kept:
  /// always equally many numbers.
  virtual std::vector<double> memory() const { return {}; }
  /// Before the first step: goes on from a state that a stepper of the same method reached, with
  /// the memory it had there.
  virtual void restore(const State&, std::span<const double> /*memory*/) {}
};

struct Integrator {
  std::string name;            ///< "backward-euler"
  std::string family;          ///< "explicit, decoupled", "implicit one-step", "multistep"
  std::string order;           ///< "1", "1-5"
  std::string error_estimate;  ///< order of the embedded method, or what else estimates the error
  std::string stability;       ///< "A, L, stiffly accurate", "conditional", ...
  std::string driver;          ///< "KINSOL", "IDA"
  std::string help;            ///< one line, with the source (equation or reference)
  bool fixed_steps = true;     ///< takes integrator.step
  bool locates_events = true;  ///< takes integrator.events = "locate"
  /// A new stepper, restored, goes on as well as the old one; else it begins at order one.
  bool one_step = true;
  /// The coefficients, for Runge-Kutta methods (the Euler schemes and theta included).
  std::function<std::optional<ButcherTable>(const IntegratorSettings&)> table;
  std::function<std::unique_ptr<Stepper>(const System&, const IntegratorSettings&, Counters&)> make;
};

using Integrators = Registry<Integrator>;

}  // namespace gnomon
