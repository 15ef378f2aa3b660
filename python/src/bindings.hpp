// The Python module gnomon._gnomon. Each file of this folder adds one part of it. Only public
// headers of gnomon are used (docs/library.md).
//
// Rules of all parts. Arrays that are given out own their data, so they may outlive everything.
// Functions that compute release the global interpreter lock; calls back into Python take it.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <gnomon/base/counters.hpp>
#include <gnomon/model/model.hpp>
#include <gnomon/results/results.hpp>
#include <gnomon/run/setup.hpp>
#include <gnomon/system/system.hpp>
#include <memory>
#include <mutex>
#include <string>
#include <type_traits>
#include <vector>

namespace gnomon::python {

namespace py = pybind11;

/// Exceptions of base/error.hpp as classes of the module, in both directions.
void add_errors(py::module_& module);
void add_scene(py::module_& module);
void add_model(py::module_& module);
/// Called by add_model(), which adds the states before.
void add_system(py::module_& module);
void add_runs(py::module_& module);
void add_results(py::module_& module);
void add_extensions(py::module_& module);
void add_arrays(py::module_& module);
void add_budget(py::module_& module);

/// A scene and its model, which Python objects share; the calls of all models of a scene take
/// turns.
class SharedModel {
public:
  explicit SharedModel(Setup made) : setup_(std::make_shared<const Setup>(std::move(made))) {}
  /// That of a later epoch; null: the first one again.
  SharedModel(const SharedModel& first, std::shared_ptr<const Model> later)
      : busy(first.busy), setup_(first.setup_), later_(std::move(later)) {}

  const Model& model() const { return later_ ? *later_ : *setup_->model; }
  const Setup& setup() const { return *setup_; }  ///< with the model of the first epoch

  Counters counters;  // of what is asked of its system
  /// A callback of a run may ask its model.
  std::shared_ptr<std::recursive_mutex> busy = std::make_shared<std::recursive_mutex>();

private:
  std::shared_ptr<const Setup> setup_;
  std::shared_ptr<const Model> later_;
};

/// As the exception of C++ that has the same meaning, or unchanged if there is none.
[[noreturn]] void throw_as_own(const py::error_already_set& error);

/// Does something with a model, without the interpreter's lock, while no other thread uses it.
template <class Action>
auto with_model(SharedModel& model, Action&& action) {
  const py::gil_scoped_release without_interpreter;
  const std::scoped_lock alone(*model.busy);
  return action();
}

/// A system as Python sees it: that of a model, which it keeps; that of a run, until the run ends;
/// or that of an algebraic stage of one of these.
class SystemHandle {
public:
  explicit SystemHandle(std::shared_ptr<SharedModel> owner) : owner_(std::move(owner)) {}
  SystemHandle(const System& system, Counters& counters) : system_(&system), counters_(&counters) {}
  SystemHandle(std::shared_ptr<const SystemHandle> parent, std::shared_ptr<AlgebraicStage> stage)
      : parent_(std::move(parent)), stage_(std::move(stage)) {}
  /// While a step from this time is taken: it ends before what jumps at its end.
  std::optional<double> step_from{};
  /// The run has ended.
  void end() {
    system_ = nullptr;
    counters_ = nullptr;
  }
  /// Throws Error after that.
  const System& system() const;
  const Structure& structure() const { return system().structure(); }
  /// Those of the model or of the run. Throws as system().
  Counters& counters() const {
    system();
    return parent_ ? parent_->counters() : owner_ ? owner_->counters : *counters_;
  }
  /// with_model() for the owner, if there is one.
  template <class Action>
  auto compute(Action&& action) const {
    const System& system = this->system();
    const SystemHandle* root = this;
    while (root->parent_) root = root->parent_.get();
    if (root->owner_) return with_model(*root->owner_, [&] { return action(system); });
    const py::gil_scoped_release without_interpreter;
    return action(system);
  }

private:
  std::shared_ptr<SharedModel> owner_;
  const System* system_ = nullptr;
  Counters* counters_ = nullptr;
  std::shared_ptr<const SystemHandle> parent_;
  std::shared_ptr<AlgebraicStage> stage_;
};

/// An algebraic stage as Python sees it.
struct StageView {
  std::shared_ptr<const SystemHandle> parent;
  std::shared_ptr<AlgebraicStage> stage;
};

/// An array that owns the values.
template <class T>
py::array_t<T> array(std::vector<T> values, std::vector<py::ssize_t> shape = {}) {
  if (shape.empty()) shape = {static_cast<py::ssize_t>(values.size())};
  auto owned = std::make_unique<std::vector<T>>(std::move(values));
  const T* data = owned->data();
  const py::capsule owner(owned.release(), [](void* p) { delete static_cast<std::vector<T>*>(p); });
  return py::array_t<T>(shape, data, owner);
}

using Reals = py::array_t<double, py::array::c_style | py::array::forcecast>;
/// What is given as real numbers; null where it is something else.
Reals real_numbers(const py::object& given);

/// Vectors as rows of an array [n, 3].
py::array_t<double> array_of_points(const std::vector<std::array<double, 3>>& points);

py::dict dict_of(const Counters& counters);
py::dict dict_of(const std::vector<Scalar>& scalars);
py::dict dict_of(const ContactSurface& surface);
/// None without a grid.
py::object dict_of(const std::optional<Grid>& grid);
/// One array per column.
py::dict dict_of_rows(const std::vector<HistoryRow>& rows);

class Steps;
struct StepView;

/// The classes that Python sees. Their objects are held by shared pointers.
template <class T>
inline constexpr bool is_bound =
    std::is_same_v<T, Scene> || std::is_same_v<T, State> || std::is_same_v<T, SharedModel> ||
    std::is_same_v<T, SystemHandle> || std::is_same_v<T, StageView> ||
    std::is_same_v<T, StepView> || std::is_same_v<T, Steps> || std::is_same_v<T, ResultReader>;

template <class A, class T = std::remove_cvref_t<A>>
using Parameter = std::conditional_t<is_bound<T>, const std::shared_ptr<T>&, A>;

template <class A>
A argument(std::remove_reference_t<Parameter<A>>& parameter) {
  if constexpr (is_bound<std::remove_cvref_t<A>>) {
    if (!parameter) throw py::type_error("expected an object of gnomon, got None");
    return *parameter;
  } else {
    return static_cast<A&&>(parameter);
  }
}

/// The function with shared pointers in place of references to bound classes. pybind11 refuses an
/// object without a constructed pointer (made by __new__ alone), but would read one by reference.
template <class Return, class... A>
auto held(Return (*function)(A...)) {
  return [function](Parameter<A>... parameters) -> Return {
    return function(argument<A>(parameters)...);
  };
}
template <class Return, class T, class... A>
auto held(Return (T::*member)(A...) const) {
  return [member](const std::shared_ptr<T>& self, A... parameters) -> Return {
    return ((*self).*member)(std::forward<A>(parameters)...);
  };
}
template <class Return, class T, class... A>
auto held(Return (T::*member)(A...)) {
  return [member](const std::shared_ptr<T>& self, A... parameters) -> Return {
    return ((*self).*member)(std::forward<A>(parameters)...);
  };
}
/// Of a lambda without captures.
template <class Lambda>
auto held(Lambda lambda) {
  return held(+lambda);
}

/// `size` numbers; `what` names them in the message of an InputError.
std::vector<double> numbers(const py::object& given, long size, const std::string& what);

}  // namespace gnomon::python
