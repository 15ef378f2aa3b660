// Models, states and systems: the contract of include/gnomon/system/system.hpp.

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
  if (owner_) return owner_->setup.model->system();
  if (!system_) throw Error("the run that this system belongs to has ended");
  return *system_;
}

std::vector<double> numbers(const py::object& given, long size, const std::string& what) {
  const auto values = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(given);
  if (!values) {
    PyErr_Clear();
    throw InputError(what + ": expected an array of numbers");
  }
  if (values.ndim() != 1 || values.size() != size)
    throw InputError(what + ": expected " + std::to_string(size) + " numbers, got an array of " +
                     std::to_string(values.size()) + " in " + std::to_string(values.ndim()) +
                     " dimensions");
  return {values.data(), values.data() + size};
}

py::array_t<double> array_of_points(const std::vector<std::array<double, 3>>& points) {
  std::vector<double> flat;
  flat.reserve(3 * points.size());
  for (const auto& point : points) flat.insert(flat.end(), point.begin(), point.end());
  return array(std::move(flat), {static_cast<py::ssize_t>(points.size()), 3});
}

py::dict dict_of(const Counters& counters) {
  using namespace py::literals;
  return py::dict("steps"_a = counters.steps, "rejected_steps"_a = counters.rejected_steps,
                  "events"_a = counters.events, "newton_iterations"_a = counters.newton_iterations,
                  "residual_evaluations"_a = counters.residual_evaluations,
                  "jacobian_evaluations"_a = counters.jacobian_evaluations,
                  "factorizations"_a = counters.factorizations,
                  "linear_solves"_a = counters.linear_solves,
                  "krylov_iterations"_a = counters.krylov_iterations,
                  "preconditioner_setups"_a = counters.preconditioner_setups);
}

py::dict dict_of(const std::vector<Scalar>& scalars) {
  py::dict result;
  for (const Scalar& scalar : scalars) result[py::str(scalar.name)] = scalar.value;
  return result;
}

py::dict dict_of(const ContactSurface& surface) {
  using namespace py::literals;
  py::dict made("node"_a = array(surface.node), "initial"_a = array_of_points(surface.initial),
                "worn"_a = array_of_points(surface.worn),
                "current"_a = array_of_points(surface.current),
                "pressure"_a = array(surface.pressure), "wear_depth"_a = array(surface.wear_depth),
                "active"_a = array(surface.active));
  if (surface.phase_position.empty()) return made;
  const auto phases = static_cast<py::ssize_t>(surface.phase_position.size()),
             nodes = static_cast<py::ssize_t>(surface.node.size());
  made["phase_position"] = array(surface.phase_position);
  made["phase_weight"] = array(surface.phase_weight);
  made["phase_pressure"] = array(surface.phase_pressure, {phases, nodes});
  if (surface.phase_traction.empty()) return made;
  made["phase_traction"] = array(surface.phase_traction, {phases, nodes, surface.dim});
  made["phase_slip"] = array(surface.phase_slip, {phases, nodes, surface.dim});
  if (!surface.phase_loop.empty())
    made["phase_loop"] = array(surface.phase_loop, {phases, 2 * surface.dim});
  if (!surface.phase_turn.empty()) made["phase_turn"] = array(surface.phase_turn, {phases, 2});
  return made;
}

py::object dict_of(const std::optional<Grid>& grid) {
  using namespace py::literals;
  if (!grid) return py::none();
  const py::ssize_t corners = grid->cell == Grid::Cell::quadrilateral ? 4 : 8;
  const py::ssize_t cells = static_cast<py::ssize_t>(grid->cells.size()) / corners;
  return py::dict("points"_a = array_of_points(grid->points),
                  "cells"_a = array(grid->cells, {cells, corners}));
}

namespace {

using Shared = std::shared_ptr<SharedModel>;

/// The arguments of System::residual and others, as a Point that refers to them.
struct PointArguments {
  std::vector<double> y, ydot;
  ActiveSet branch;
  Point point;

  PointArguments(const Structure& structure, double t, const py::object& at,
                 const py::object& rates, const py::object& on, const py::object& within)
      : y(numbers(at, structure.size, "y")) {
    if (!rates.is_none())
      ydot = numbers(rates, structure.size, "ydot");
    else if (std::ranges::count(structure.differential, 1) > 0)
      throw InputError("ydot: expected " + std::to_string(structure.size) +
                       " numbers, because some unknowns are differential, got None");
    point = {.t = t, .y = y, .ydot = ydot};
    if (!within.is_none()) point.within = within.cast<double>();
    if (on.is_none()) return;
    const auto count = static_cast<long>(structure.switch_node.size());
    for (const double flag : numbers(on, count, "branch")) branch.push_back(flag != 0);
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
  if (!std::isfinite(t)) throw InputError(at + ": expected a finite time");
  if (within && !(*within <= t))
    throw InputError(at + ": expected a time `within` that is not later");
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

/// A copy that may not be written to, since the state would not change.
py::array_t<double> copy_of(const std::vector<double>& values) {
  py::array_t<double> copy = array(values);
  copy.attr("setflags")(py::arg("write") = false);
  return copy;
}

void add_state(py::module_& module) {
  py::class_<State, std::shared_ptr<State>>(
      module, "State", "A point of the solution: t, y and ydot (copies to read).")
      .def(py::init([](double t, const py::array_t<double>& y, const py::array_t<double>& ydot) {
             return State{t, numbers(y, y.size(), "y"), numbers(ydot, y.size(), "ydot")};
           }),
           py::arg("t"), py::arg("y"), py::arg("ydot"))
      .def_property_readonly("t", held([](const State& state) { return state.t; }), "Time.")
      .def_property_readonly("y", held([](const State& state) { return copy_of(state.y); }),
                             "All unknowns.")
      .def_property_readonly("ydot", held([](const State& state) { return copy_of(state.ydot); }),
                             "Their rates; of algebraic unknowns zero.")
      .def("__repr__", held([](const State& state) {
             return "<gnomon.State at t = " + std::string(py::str(py::float_(state.t))) + " of " +
                    std::to_string(state.y.size()) + " unknowns>";
           }))
      .def(py::pickle(held([](const State& state) {
                        return py::make_tuple(state.t, array(state.y), array(state.ydot));
                      }),
                      [](const py::tuple& parts) {
                        if (parts.size() != 3)
                          throw InputError("a pickled State: expected three parts");
                        const auto y = parts[1].cast<py::array_t<double>>();
                        return State{parts[0].cast<double>(), numbers(y, y.size(), "y"),
                                     numbers(parts[2], y.size(), "ydot")};
                      }));
}

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

void require_state(const SharedModel& model, const State& state) {
  const auto size = static_cast<std::size_t>(model.setup.model->system().structure().size);
  if (state.y.size() != size || state.ydot.size() != size)
    throw InputError("a state of " + std::to_string(state.y.size()) + " unknowns, expected " +
                     std::to_string(size));
}

py::dict fields(SharedModel& model, const State& state) {
  require_state(model, state);
  py::dict result;
  for (GridField& field : with_model(model, [&] { return model.setup.model->fields(state); })) {
    const py::ssize_t rows = field.values.size() / field.components;
    result[py::str(field.name)] =
        field.components == 1
            ? array(std::move(field.values))
            : array(std::move(field.values), {rows, py::ssize_t(field.components)});
  }
  return result;
}

py::object contact(SharedModel& model, const State& state) {
  require_state(model, state);
  const auto surface = with_model(model, [&] { return model.setup.model->contact(state); });
  return surface ? py::object(dict_of(*surface)) : py::object(py::none());
}

py::list blocks(const SharedModel& model) {
  using namespace py::literals;
  py::list result;
  for (const BlockSize& block : model.setup.model->blocks)
    result.append(py::dict("name"_a = block.name, "symbol"_a = block.symbol, "size"_a = block.size,
                           "where"_a = block.where));
  return result;
}

}  // namespace

void add_model(py::module_& module) {
  add_state(module);
  add_system(module);
  add_stage(module);
  py::class_<SharedModel, Shared>(module, "Model", "What a problem makes of a scene.")
      .def(py::init(held([](const Scene& scene) {
             const py::gil_scoped_release without_interpreter;
             return std::make_shared<SharedModel>(set_up(scene));
           })),
           py::arg("scene"))
      .def_property_readonly("_scene",
                             held([](const SharedModel& model) { return model.setup.scene; }))
      .def_property_readonly(
          "remarks", held([](const SharedModel& model) { return model.setup.model->remarks; }),
          "What was noticed before the start, as text.")
      .def_property_readonly("blocks", held(blocks),
                             "The unknown blocks: name, symbol, size and where they are.")
      .def_property_readonly(
          "system", held([](const Shared& model) { return std::make_shared<SystemHandle>(model); }),
          "The equations, a System.")
      .def_property_readonly(
          "error_scale",
          held([](const SharedModel& model) { return model.setup.model->differential_scale; }),
          "Typical size of the differential unknowns, the wear depth [mm]: by default "
          "integrator.atol is integrator.rtol times it.")
      .def("start", held([](SharedModel& model) {
             return with_model(model, [&] {
               Counters counters;
               return model.setup.model->start(counters);
             });
           }),
           "The consistent State at t = 0.")
      .def("observe", held([](SharedModel& model, const State& state) {
             require_state(model, state);
             return dict_of(with_model(model, [&] { return model.setup.model->observe(state); }));
           }),
           py::arg("state"), "The scalars of a state.")
      .def("grid", held([](const SharedModel& model) { return dict_of(model.setup.model->grid); }),
           "Points [n, 3] and cells [m, corners], or None.")
      .def("fields", held(fields), py::arg("state"), "Fields over the grid.")
      .def("contact", held(contact), py::arg("state"), "The contact surface, or None.")
      .def("exact", held([](SharedModel& model, double t) {
             const auto& exact = model.setup.model->exact;
             return with_model(model, [&] { return exact ? exact(t) : std::nullopt; });
           }),
           py::arg("t"), "The State in closed form (differential components), or None.");
}

}  // namespace gnomon::python
