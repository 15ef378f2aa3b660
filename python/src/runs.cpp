// Runs: whole ones with a callback per step, and step by step.

#include <fmt/format.h>
#include <pybind11/stl/filesystem.h>

#include <gnomon/base/error.hpp>
#include <gnomon/run/run.hpp>
#include <gnomon/run/run_steps.hpp>
#include <gnomon/run/summary.hpp>

#include "bindings.hpp"

namespace gnomon::python {

py::dict dict_of_rows(const std::vector<HistoryRow>& rows) {
  std::vector<double> t, step;
  std::vector<int> order;
  std::vector<long> newton;
  for (const HistoryRow& row : rows) {
    t.push_back(row.t);
    step.push_back(row.step.step);
    order.push_back(row.step.order);
    newton.push_back(row.step.newton_iterations);
  }
  py::dict result;
  result["t"] = array(std::move(t));
  result["step"] = array(std::move(step));
  result["order"] = array(std::move(order));
  result["newton_iterations"] = array(std::move(newton));
  for (std::size_t column = 0; !rows.empty() && column < rows.front().scalars.size(); ++column) {
    std::vector<double> values;
    for (const HistoryRow& row : rows) values.push_back(row.scalars[column].value);
    result[py::str(rows.front().scalars[column].name)] = array(std::move(values));
  }
  return result;
}

using Shared = std::shared_ptr<SharedModel>;
namespace fs = std::filesystem;

/// A step as its callback sees it.
struct StepView {
  Shared model;
  HistoryRow row;
  State state;
};

namespace {

/// The model of the start of its scene, where runs begin.
Shared at_start(const Shared& model) {
  if (&model->model() == model->setup().model.get()) return model;
  return std::make_shared<SharedModel>(*model, nullptr);
}

/// Lets other threads use the models of a run while its callback runs, which may wait for them.
/// Begins and ends without the interpreter's lock.
class TurnOfOthers {
public:
  explicit TurnOfOthers(std::shared_ptr<std::recursive_mutex> busy) : busy_(std::move(busy)) {
    busy_->unlock();
  }
  ~TurnOfOthers() { busy_->lock(); }
  TurnOfOthers(const TurnOfOthers&) = delete;

private:
  std::shared_ptr<std::recursive_mutex> busy_;
};

/// The hooks of one run; what a callback or a signal raises ends the run and is raised after it.
class Callbacks {
public:
  Callbacks(Shared model, py::object on_step)
      : model_(std::move(model)), on_step_(std::move(on_step)) {}

  /// States are copied only for a callback, which may keep them.
  RunHooks hooks() {
    RunHooks hooks{.on_step = [this](const HistoryRow& row) { step(row); },
                   .interrupted = [this] { return interrupted(); }};
    if (on_step_.is_none()) return hooks;
    hooks.on_state = [this](const State& state) { state_ = state; };
    hooks.on_epoch = [this](const std::shared_ptr<const Model>& later) {
      model_ = std::make_shared<SharedModel>(*model_, later);
    };
    return hooks;
  }
  void raise_if_raised() {
    if (raised_) throw *raised_;
  }
  const std::vector<HistoryRow>& rows() const { return rows_; }

private:
  void step(const HistoryRow& row) {
    rows_.push_back(row);
    if (on_step_.is_none()) return;
    const TurnOfOthers others(model_->busy);
    const py::gil_scoped_acquire interpreter;
    try {
      const py::object answer = on_step_(StepView{model_, row, state_});
      if (!answer.is_none() && answer.cast<bool>()) stop_ = true;
    } catch (const py::error_already_set& error) {
      raised_.emplace(error);
    } catch (const py::cast_error&) {
      raised_.emplace(type_error("on_step: expected True (stop), False or None as its result"));
    }
  }

  bool interrupted() {
    if (stop_ || raised_) return true;
    const py::gil_scoped_acquire interpreter;
    if (PyErr_CheckSignals() != 0) raised_.emplace();  // KeyboardInterrupt, for example
    return raised_.has_value();
  }

  static py::error_already_set type_error(const char* message) {
    PyErr_SetString(PyExc_TypeError, message);
    return {};
  }

  Shared model_;
  py::object on_step_;
  std::vector<HistoryRow> rows_;
  State state_;
  bool stop_ = false;
  std::optional<py::error_already_set> raised_;
};

py::dict run_model(const Shared& model, const std::optional<fs::path>& result, bool force,
                   const py::object& on_step) {
  using namespace py::literals;
  const Setup& setup = model->setup();
  const RunHeader header = run_header(setup);
  const IntegratorSettings settings = integrator_settings(setup.scene, *setup.model);
  Callbacks callbacks(at_start(model), on_step);
  const RunOutcome outcome = with_model(*model, [&] {
    std::optional<ResultWriter> writer;
    if (result)
      writer.emplace(*result, header, setup.model->grid,
                     force ? Earlier::replaced : Earlier::refused);
    return run(*setup.model, chosen_integrator(setup.scene), settings, store_policy(setup.scene),
               writer ? &*writer : nullptr, callbacks.hooks());
  });
  callbacks.raise_if_raised();
  const auto last = std::make_shared<SharedModel>(*model, outcome.successor);
  const std::optional<ContactSurface> surface = with_model(
      *model, [&] { return outcome.state ? last->model().contact(*outcome.state) : std::nullopt; });
  const std::string summary =
      summary_json(setup.scene, header, settings, outcome, setup.model->remarks);
  return py::dict("status"_a = outcome.text().substr(0, outcome.text().find(':')),
                  "diagnosis"_a = outcome.diagnosis, "warnings"_a = outcome.warnings,
                  "counters"_a = dict_of(outcome.counters), "wall_seconds"_a = outcome.wall_seconds,
                  "summary"_a = summary, "history"_a = dict_of_rows(callbacks.rows()),
                  "state"_a = outcome.state, "model"_a = last,
                  "surface"_a = surface ? py::object(dict_of(*surface)) : py::object(py::none()));
}

}  // namespace

/// A run that the caller drives.
class Steps {
public:
  explicit Steps(const Shared& model) : first_(at_start(model)), model_(first_) {
    const Setup& setup = first_->setup();
    const IntegratorSettings settings = integrator_settings(setup.scene, *setup.model);
    end_ = settings.end;
    with_model(*first_, [&] {
      steps_ = std::make_unique<RunSteps>(*setup.model, chosen_integrator(setup.scene), settings,
                                          store_policy(setup.scene).until);
    });
  }
  ~Steps() {
    const py::gil_scoped_release without_interpreter;
    const std::scoped_lock alone(*first_->busy);
    steps_.reset();
  }

  py::dict advance(std::optional<double> until) {
    using namespace py::literals;
    const double t_stop = until.value_or(end_);
    // Another thread may have taken a step until the turn of this one comes.
    const StepReport report = with_model(*first_, [&] {
      if (!steps_->ended() && !(t_stop > steps_->state().t && t_stop <= end_))
        throw InputError(fmt::format("until = {}: expected a time after {} and not after time.end",
                                     t_stop, steps_->state().t));
      return steps_->advance(t_stop);
    });
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    return py::dict("step"_a = report.step, "order"_a = report.order,
                    "newton_iterations"_a = report.newton_iterations,
                    "restarted"_a = report.restarted, "switched"_a = report.switched,
                    "wear"_a = report.integral);
  }
  bool ended() const {
    return with_model(*first_, [&] { return steps_->ended(); });
  }
  State state() const {
    return with_model(*first_, [&] { return steps_->state(); });
  }
  Counters counters() const {
    return with_model(*first_, [&] { return steps_->counters(); });
  }
  /// Of the state, in its epoch.
  Shared model() {
    const auto later = with_model(*first_, [&] { return steps_->successor(); });
    if (later && later.get() != &model_->model())
      model_ = std::make_shared<SharedModel>(*first_, later);
    return model_;
  }

private:
  Shared first_;  // whose turns the calls take
  Shared model_;
  double end_ = 0;
  std::unique_ptr<RunSteps> steps_;
};

void add_runs(py::module_& module) {
  py::class_<StepView, std::shared_ptr<StepView>>(module, "Step",
                                                  "A step that a run has taken, for its callback.")
      .def_property_readonly("t", held([](const StepView& step) { return step.row.t; }),
                             "Time at its end.")
      .def_property_readonly("size", held([](const StepView& step) { return step.row.step.step; }),
                             "Its length.")
      .def_property_readonly("order",
                             held([](const StepView& step) { return step.row.step.order; }),
                             "Order of the method in it.")
      .def_property_readonly("scalars",
                             held([](const StepView& step) { return dict_of(step.row.scalars); }),
                             "What the problem observes at its end, by name.")
      .def_property_readonly("counters",
                             held([](const StepView& step) { return dict_of(step.row.counters); }),
                             "Work of the run so far.")
      .def_property_readonly("state", held([](const StepView& step) { return step.state; }),
                             "The State at its end.")
      .def_property_readonly("surface", held([](const StepView& step) -> py::object {
                               const auto surface = with_model(*step.model, [&] {
                                 return step.model->model().contact(step.state);
                               });
                               if (!surface) return py::none();
                               return dict_of(*surface);
                             }),
                             "The contact surface as arrays, or None.");
  module.def("_run", held(run_model), py::arg("model"), py::arg("result"), py::arg("force"),
             py::arg("on_step"));
  py::class_<Steps, std::shared_ptr<Steps>>(module, "Stepper",
                                            "A run that the caller drives, step by step.")
      .def(py::init<Shared>(), py::arg("model"))
      .def("advance", held(&Steps::advance), py::arg("until") = py::none(),
           "Takes one accepted step, which ends at `until` (default: time.end) at the latest.")
      .def_property_readonly("ended", held([](const Steps& steps) { return steps.ended(); }),
                             "Whether time.end, or time.until, is reached.")
      .def_property_readonly("state", held([](const Steps& steps) { return steps.state(); }),
                             "The State at the end of the last step.")
      .def_property_readonly("model", held(&Steps::model),
                             "The Model of its state, another one where contact has grown.")
      .def_property_readonly("counters",
                             held([](const Steps& steps) { return dict_of(steps.counters()); }),
                             "Work so far, by name.");
}

}  // namespace gnomon::python
