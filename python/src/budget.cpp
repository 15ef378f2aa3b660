#include <gnomon/budget/plan.hpp>

#include "bindings.hpp"

namespace gnomon::python {

namespace {

/// Calls `find` without the interpreter; Ctrl-C ends it with KeyboardInterrupt.
template <class Find>
auto interruptible(Find find) {
  const BudgetHooks hooks{.interrupted = [] {
    const py::gil_scoped_acquire interpreter;
    return PyErr_Occurred() != nullptr || PyErr_CheckSignals() != 0;
  }};
  try {
    const py::gil_scoped_release without_interpreter;
    return find(hooks);
  } catch (const Error&) {
    if (PyErr_Occurred()) throw py::error_already_set();
    throw;
  }
}

}  // namespace

void add_budget(py::module_& module) {
  module.def("_budget", held([](const Scene& scene) {
               return budget_json(interruptible(
                   [&](const BudgetHooks& hooks) { return find_budget(scene, hooks); }));
             }));
  module.def("_plan", held([](const Scene& scene) {
               Plan plan =
                   interruptible([&](const BudgetHooks& hooks) { return plan_of(scene, hooks); });
               std::string text = plan_text(plan);
               return std::pair(std::make_shared<Scene>(std::move(plan.scene)), std::move(text));
             }));
}

}  // namespace gnomon::python
