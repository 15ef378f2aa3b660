// Systems: the contract of include/gnomon/system/system.hpp.

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/fields/block.hpp>
#include <gnomon/integrators/rates.hpp>
#include <gnomon/integrators/stop_times.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <map>

#include "bindings.hpp"

namespace gnomon::python {

const System& SystemHandle::system() const {
  if (parent_) {
    parent_->system();  // its run may have ended
    return *stage_->system;
  }
  if (owner_) return owner_->model().system();
  if (!system_) throw Error("the run that this system belongs to has ended");
  return *system_;
}

namespace {

/// Throws InputError for what is no time, or a time `within` that is later.
void require_time(double t, std::optional<double> within) {
  const std::string at = "t = " + std::string(py::str(py::float_(t)));
  if (!std::isfinite(t)) throw InputError(at + ": expected a finite time");
  if (within && !(*within <= t))
    throw InputError(at + ": expected a time `within` that is not later");
}

/// The arguments of System::residual and others, as a Point that refers to them.
struct PointArguments {
  std::vector<double> y, ydot;
  ActiveSet branch;
  Point point;

  PointArguments(const Structure& structure, double t, const py::object& at,
                 const py::object& rates, const py::object& on, const py::object& within)
      : y(numbers(at, structure.size, "y")) {
    require_time(t, within.is_none() ? std::nullopt : std::optional(within.cast<double>()));
    if (!rates.is_none())
      ydot = numbers(rates, structure.size, "ydot");
    else if (std::ranges::count(structure.differential, 1) > 0)
      throw InputError("ydot: expected " + std::to_string(structure.size) +
                       " numbers, because some unknowns are differential, got None");
    point = {.t = t, .y = y, .ydot = ydot};
    if (!within.is_none()) point.within = within.cast<double>();
    if (on.is_none()) return;
    const auto count = static_cast<long>(structure.switch_node.size());
    for (const double flag : numbers(on, count, "branch")) {
      if (flag != 0 && flag != 1)
        throw InputError("branch: expected ones, where active, and zeros, got " +
                         std::string(py::str(py::float_(flag))));
      branch.push_back(flag != 0);
    }
    point.branch = &branch;
  }
  PointArguments(const PointArguments&) = delete;
};

py::array_t<double> residual(const SystemHandle& handle, double t, const py::object& y,
                             const py::object& ydot, const py::object& branch,
                             const py::object& within) {
  const PointArguments at(handle.structure(), t, y, ydot, branch, within);
  std::vector<double> F(at.y.size());
  ++handle.counters().residual_evaluations;
  handle.compute([&](const System& system) { system.residual(at.point, F); });
  return array(std::move(F));
}

/// The parts of a sparse matrix by columns: values, rows, starts of columns.
py::tuple jacobian(const SystemHandle& handle, double t, const py::object& y,
                   const py::object& ydot, double alpha, const py::object& branch,
                   const py::object& within) {
  const Structure& structure = handle.structure();
  const PointArguments at(structure, t, y, ydot, branch, within);
  std::vector<double> values(structure.pattern.row_index.size());
  ++handle.counters().jacobian_evaluations;
  handle.compute([&](const System& system) { system.jacobian(at.point, alpha, values); });
  return py::make_tuple(array(std::move(values)), array(structure.pattern.row_index),
                        array(structure.pattern.column_start));
}

py::array_t<double> switching(const SystemHandle& handle, double t, const py::object& y,
                              const py::object& branch, const py::object& within) {
  const std::vector<double> none(static_cast<std::size_t>(handle.structure().size));
  const PointArguments at(handle.structure(), t, y, array(none), branch, within);
  std::vector<double> values(handle.structure().switch_node.size());
  handle.compute([&](const System& system) { system.switching(at.point, values); });
  return array(std::move(values));
}

/// Positions in y of the unknowns of each block; blocks of one name (phases) together.
py::dict indices(const SystemHandle& handle) {
  const Structure& structure = handle.structure();
  std::map<std::string, std::vector<long>> found;
  for (std::size_t i = 0; i < structure.block.size(); ++i)
    found[structure.block_of(i).name].push_back(static_cast<long>(i));
  py::dict result;
  for (auto& [name, places] : found) result[py::str(name)] = array(std::move(places));
  return result;
}

py::list stages(const std::shared_ptr<SystemHandle>& handle) {
  py::list result;
  std::vector<AlgebraicStage> stages =
      handle->compute([](const System& system) { return system.algebraic_stages(); });
  for (AlgebraicStage& stage : stages)
    result.append(StageView{handle, std::make_shared<AlgebraicStage>(std::move(stage))});
  return result;
}

/// Solves the algebraic rows for the differential components of y; the result is consistent, with
/// its rates.
State consistent(const SystemHandle& handle, double t, const py::object& y,
                 std::optional<double> within) {
  if (!within) within = handle.step_from;
  State state{t, numbers(y, handle.structure().size, "y"), {}};
  const std::string at = "t = " + std::string(py::str(py::float_(t)));
  require_time(t, within);
  for (std::size_t i = 0; i < state.y.size(); ++i)
    if (!std::isfinite(state.y[i]))  // as a method arrives at that is not stable
      throw SolutionError("no equilibrium at " + at + ": y[" + std::to_string(i) +
                          "] is not a finite number");
  handle.compute([&](const System& system) {
    const double at_end = within ? inside_step(system.structure(), *within, t) : t;
    const std::string reason = AlgebraicSolver(system, handle.counters()).solve(at_end, state.y);
    if (!reason.empty()) throw SolutionError("no equilibrium at " + at + ": " + reason);
    set_rates(system, nullptr, state, within);
  });
  return state;
}

void add_stage(py::module_& module) {
  py::class_<StageView, std::shared_ptr<StageView>>(
      module, "Stage", "A system for some unknowns of another one, with the others frozen.")
      .def_property_readonly("unknowns", held([](const StageView& self) {
                               return array(std::vector<int>(self.stage->unknowns));
                             }),
                             "Positions of its unknowns in y of the whole system.")
      .def_property_readonly("system", held([](const StageView& self) {
                               return std::make_shared<SystemHandle>(self.parent, self.stage);
                             }),
                             "Its equations, a purely algebraic System; t is the frozen one.")
      .def("freeze", held([](const StageView& self, double t, const py::object& y) {
             const std::vector<double> at = numbers(y, self.parent->structure().size, "y");
             self.parent->compute([&](const System&) { self.stage->freeze(t, at); });
           }),
           py::arg("t"), py::arg("y"), "Takes time and the other unknowns from the whole system.");
}

}  // namespace

void add_system(py::module_& module) {
  py::class_<SystemHandle, std::shared_ptr<SystemHandle>>(
      module, "System", "F(t, y, ydot) = 0 with J = dF/dy + alpha dF/dydot, an index-1 system.")
      .def_property_readonly("size",
                             held([](const SystemHandle& self) { return self.structure().size; }),
                             "Number of unknowns, and of rows.")
      .def_property_readonly("differential", held([](const SystemHandle& self) {
                               const auto& flags = self.structure().differential;
                               return array(std::vector<char>(flags)).attr("astype")("bool");
                             }),
                             "Which unknowns are differential: the positions of the worn surface, "
                             "and with friction.stick the memory of slip, which follows within a "
                             "cycle (stiff).")
      .def_property_readonly("row_scale", held([](const SystemHandle& self) {
                               return array(self.structure().row_scale);
                             }),
                             "Typical sizes of the rows, by which residuals are divided.")
      .def_property_readonly("unknown_scale", held([](const SystemHandle& self) {
                               return array(self.structure().unknown_scale);
                             }),
                             "Typical sizes of the unknowns.")
      .def_property_readonly("breakpoints", held([](const SystemHandle& self) {
                               return array(self.structure().breakpoints);
                             }),
                             "Times at which the equations have a kink; steps should end there.")
      .def_property_readonly("switch_node", held([](const SystemHandle& self) {
                               return array(self.structure().switch_node);
                             }),
                             "The node of the mesh to which each switching function belongs.")
      .def_property_readonly("tolerance_scale", held([](const SystemHandle& self) {
                               return array(self.structure().tolerance_scale);
                             }),
                             "Of each unknown: its absolute tolerance in units of that of the run. "
                             "Only those of differential ones enter the norm of errors.")
      .def_property_readonly("indices", held(indices),
                             "Positions in y of the unknowns of each block, by its name.")
      .def_property_readonly(
          "counters", held([](const SystemHandle& self) { return dict_of(self.counters()); }),
          "Work asked of it so far, by name; of a run that of the run.")
      .def("residual", held(residual), py::arg("t"), py::arg("y"), py::arg("ydot") = py::none(),
           py::arg("branch") = py::none(), py::arg("within") = py::none(),
           "F(t, y, ydot). `ydot` may be None where nothing is differential. `branch`: 1 for each "
           "switching function that is taken as active, 0 for others: that smooth branch, "
           "continued beyond its border; None: by their signs. `within`: time whose smooth part "
           "in t is continued to t.")
      .def("_jacobian", held(jacobian), py::arg("t"), py::arg("y"), py::arg("ydot"),
           py::arg("alpha"), py::arg("branch") = py::none(), py::arg("within") = py::none())
      .def("switching", held(switching), py::arg("t"), py::arg("y"), py::arg("branch") = py::none(),
           py::arg("within") = py::none(),
           "One value per switching function, zero or negative where it is active.")
      .def(
          "algebraic_stages",
          [](const std::shared_ptr<SystemHandle>& self) {
            if (!self) throw py::type_error("expected an object of gnomon, got None");
            return stages(self);
          },
          "The algebraic rows as a list of Stage, to be solved one after the other.")
      .def("consistent", held(consistent), py::arg("t"), py::arg("y"),
           py::arg("within") = py::none(),
           "The State with these differential components: solves mesh motion and contact. "
           "`within`: an earlier time, so that what jumps at t has not jumped yet; in advance() of "
           "an integrator it is the time of its state.");
  add_stage(module);
}

}  // namespace gnomon::python
