// Integrators and wear laws written in Python: slow, but for research.

#include <pybind11/stl.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/integrators/jumps.hpp>
#include <gnomon/integrators/stop_times.hpp>
#include <gnomon/wear_laws/wear_law_kind.hpp>
#include <map>
#include <set>

#include "bindings.hpp"

namespace gnomon::python {

namespace {

/// Calls a Python function; exceptions that have a meaning in C++ get it.
template <class Action>
auto in_python(Action&& action) {
  const py::gil_scoped_acquire interpreter;
  try {
    return action();
  } catch (const py::error_already_set& error) {
    throw_as_own(error);
  }
}

/// What is registered of Python. What was made of an earlier registration shares that one.
using Registered = std::shared_ptr<const py::object>;

/// It may be the last to go without the interpreter's lock, or after the interpreter's end.
Registered registered(py::object object) {
  return {new py::object(std::move(object)), [](py::object* last) {
            if (!Py_IsInitialized()) return;
            const py::gil_scoped_acquire interpreter;
            delete last;
          }};
}

/// The number that a text begins with; 0 without one, or of a range ("1-5").
int order_of(const std::string& text) {
  int order = 0;
  const char* const end = text.data() + text.size();
  const auto [behind, error] = std::from_chars(text.data(), end, order);
  return error == std::errc() && behind == end ? order : 0;
}

/// An object of Python with advance(state, until), which returns the next State.
class PythonStepper : public Stepper {
public:
  /// `make` is its own: while it makes the object, its name may be registered again.
  PythonStepper(const Registered make, int order, const System& system,
                const IntegratorSettings& settings, Counters& counters)
      : Stepper(counters),
        order_(order),
        system_(system),
        settings_(settings),
        counters_(counters) {
    in_python([&] {
      using namespace py::literals;
      handle_ = std::make_shared<SystemHandle>(system, counters);
      const py::dict given("step"_a = settings.step, "rtol"_a = settings.rtol,
                           "atol"_a = settings.atol, "end"_a = settings.end,
                           "scale"_a = settings.scale, "max_step"_a = settings.max_step);
      object_ = (*make)(handle_, given);
    });
  }
  ~PythonStepper() override {
    const py::gil_scoped_acquire interpreter;
    handle_->end();
    object_ = {};
  }

private:
  StepReport take_step(State& state, double t_stop) override {
    int order = order_;
    if (is_breakpoint(system_.structure(), state.t))
      pass_breakpoint(system_, settings_, counters_, nullptr, state);
    t_stop = end_of_smooth_part(system_.structure(), state.t, t_stop);
    if (settings_.step == 0) t_stop = end_at_stop(system_.structure(), state.t, t_stop);
    handle_->step_from = state.t;
    State next = in_python([&] {
      State result = next_state(state, t_stop);
      // A method of variable order says of every step by which it was taken.
      const py::object own = py::getattr(object_, "order", py::int_(order));
      if (!py::isinstance<py::int_>(own))
        throw py::type_error("the order of an integrator in Python: expected a whole number");
      order = own.cast<int>();
      return result;
    });
    StepReport report{.step = next.t - state.t, .order = order};
    if (settings_.integrand)
      report.integral = report.step / 2 *
                        (settings_.integrand({state.t, state.y, state.ydot}) +
                         settings_.integrand({next.t, next.y, next.ydot}));
    state = std::move(next);
    return report;
  }

  State next_state(const State& state, double t_stop) const {
    const py::object result = object_.attr("advance")(state, t_stop);
    if (!py::isinstance<State>(result))
      throw py::type_error("advance: expected a gnomon.State as its result, got " +
                           std::string(py::str(result.get_type().attr("__name__"))));
    State next = result.cast<State>();
    if (next.y.size() != state.y.size() || next.ydot.size() != state.y.size())
      throw py::value_error("advance: the state has another number of unknowns");
    if (!(next.t > state.t && next.t <= t_stop))
      throw py::value_error("advance: expected a time after " + std::to_string(state.t) +
                            " and not after " + std::to_string(t_stop) + ", got " +
                            std::to_string(next.t));
    for (const std::vector<double>& values : {next.y, next.ydot})
      if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); }))
        throw SolutionError("advance: the state has an infinite value or NaN");
    return next;
  }

  const int order_;
  const System& system_;
  IntegratorSettings settings_;
  Counters& counters_;
  std::shared_ptr<SystemHandle> handle_;
  py::object object_;
};

/// What was registered in Python may be registered again, as when a cell of a notebook runs again.
template <class Entry>
void add_or_replace(Entry entry) {
  static auto& names = *new std::set<std::string>;
  const std::string name = entry.name;
  if (names.contains(name))
    Registry<Entry>::put(std::move(entry));
  else
    Registry<Entry>::add(std::move(entry));
  names.insert(name);
}

void register_integrator(const std::string& name, py::object make, const std::string& help,
                         const std::string& order, bool fixed_steps) {
  const Registered kept = registered(std::move(make));
  add_or_replace<Integrator>({.name = name,
                              .family = "Python",
                              .order = order,
                              .error_estimate = "its own",
                              .stability = "not known",
                              .driver = "Python",
                              .help = help,
                              .fixed_steps = fixed_steps,
                              .locates_events = false,
                              .table = [](const IntegratorSettings&) { return std::nullopt; },
                              .make = [kept, number = order_of(order)](
                                          const System& system, const IntegratorSettings& settings,
                                          Counters& counters) -> std::unique_ptr<Stepper> {
                                return std::make_unique<PythonStepper>(kept, number, system,
                                                                       settings, counters);
                              }});
}

/// The function's rate at p v h q.
double rate_of(const py::handle& rate, const WearInput& at, double p, double v, double h, double q,
               const std::map<std::string, double>& constants) {
  py::dict more;
  for (const auto& [name, value] : constants) more[py::str(name)] = value;
  const py::object value =
      rate(p, v, h, q, at.moment.time, at.moment.slid,
           py::make_tuple(at.initial[0], at.initial[1], at.initial[2]), **more);
  const double number = PyFloat_AsDouble(value.ptr());
  if (!PyErr_Occurred()) return number;
  PyErr_Clear();
  throw py::type_error("a wear law in Python: expected a number as its result, got " +
                       std::string(py::repr(value)));
}

/// Derivatives by central differences, exact for laws that are linear in each variable.
WearRate wear_rate(const py::handle& rate, const WearInput& at,
                   const std::map<std::string, double>& constants) {
  const double x[] = {at.pressure, at.speed, at.depth, at.friction_power};
  const auto value = [&](int varied, double by) {
    double z[] = {x[0], x[1], x[2], x[3]};
    if (varied >= 0) z[varied] += by;
    return rate_of(rate, at, z[0], z[1], z[2], z[3], constants);
  };
  double slope[4];
  for (int i = 0; i < 4; ++i) {
    const double h = 1e-6 * std::max(std::abs(x[i]), 1e-9);
    // A law need not have a value below zero.
    const double below = x[i] >= h ? h : 0;
    slope[i] = (value(i, h) - value(i, -below)) / (h + below);
  }
  return {.value = value(-1, 0),
          .by_pressure = slope[0],
          .by_speed = slope[1],
          .by_depth = slope[2],
          .by_friction_power = slope[3]};
}

std::vector<Key> keys_of(const std::map<std::string, double>& constants) {
  std::vector<Key> keys;
  for (const auto& [name, unused] : constants)
    keys.push_back({.name = "wear." + name,
                    .absent_meaning = "the value that the law was registered with",
                    .help = "constant of a wear law in Python"});
  return keys;
}

void register_wear_law(const std::string& name, py::object rate,
                       const std::map<std::string, double>& constants, const std::string& help) {
  const Registered kept = registered(std::move(rate));
  add_or_replace<WearLawKind>(
      {.name = name,
       .help = help,
       .keys = keys_of(constants),
       .make =
           [=](const Scene& scene) {
             std::map<std::string, double> values;
             for (const auto& [constant, own] : constants) {
               const std::string key = "wear." + constant;
               if (!scene.knows(key))
                 throw InputError(
                     scene.where("wear.law") + ": the law \"" + name +
                     "\" was registered again, with the constant " + constant +
                     ", after this scene was read; expected a scene that is read again");
               values[constant] = scene.real_if(key).value_or(own);
             }
             return WearLaw({.rate = [kept, values](const WearInput& at, std::span<const char>) {
               return in_python([&] { return wear_rate(*kept, at, values); });
             }});
           },
       .reads_coefficient = false});
}

}  // namespace

void add_extensions(py::module_& module) {
  module.def("register_integrator", register_integrator, py::arg("name"), py::arg("make"),
             py::arg("help") = "an integrator in Python", py::arg("order") = "not known",
             py::arg("fixed_steps") = true,
             "make(system, settings) returns an object with advance(state, until) -> State.");
  module.def("register_wear_law", register_wear_law, py::arg("name"), py::arg("rate"),
             py::arg("constants") = std::map<std::string, double>{},
             py::arg("help") = "a wear law in Python",
             "rate(p, v, h, q, t, s, x, **constants) returns the wear rate; scenes choose it by "
             "wear.law and may set wear.CONSTANT.");
}

}  // namespace gnomon::python
