// Models and states.

#include <gnomon/base/error.hpp>

#include "bindings.hpp"

namespace gnomon::python {

Reals real_numbers(const py::object& given) {
  const auto as_given = py::array::ensure(given);
  const bool complex = as_given && as_given.dtype().kind() == 'c';  // its real part alone is taken
  Reals values = complex ? py::reinterpret_steal<Reals>(py::handle()) : Reals::ensure(given);
  if (!values) PyErr_Clear();
  return values;
}

std::vector<double> numbers(const py::object& given, long size, const std::string& what) {
  const Reals values = real_numbers(given);
  if (!values) throw InputError(what + ": expected an array of real numbers");
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

void require_state(const SharedModel& model, const State& state) {
  const auto size = static_cast<std::size_t>(model.model().system().structure().size);
  if (state.y.size() != size || state.ydot.size() != size)
    throw InputError("a state of " + std::to_string(state.y.size()) + " unknowns, expected " +
                     std::to_string(size));
}

py::dict fields(SharedModel& model, const State& state) {
  require_state(model, state);
  py::dict result;
  for (GridField& field : with_model(model, [&] { return model.model().fields(state); })) {
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
  const auto surface = with_model(model, [&] { return model.model().contact(state); });
  return surface ? py::object(dict_of(*surface)) : py::object(py::none());
}

py::list blocks(const SharedModel& model) {
  using namespace py::literals;
  py::list result;
  for (const BlockSize& block : model.model().blocks)
    result.append(py::dict("name"_a = block.name, "symbol"_a = block.symbol, "size"_a = block.size,
                           "where"_a = block.where));
  return result;
}

}  // namespace

void add_model(py::module_& module) {
  add_state(module);
  add_system(module);
  py::class_<SharedModel, Shared>(module, "Model", "What a problem makes of a scene.")
      .def(py::init(held([](const Scene& scene) {
             const py::gil_scoped_release without_interpreter;
             return std::make_shared<SharedModel>(set_up(scene));
           })),
           py::arg("scene"))
      .def_property_readonly("_scene",
                             held([](const SharedModel& model) { return model.setup().scene; }))
      .def_property_readonly("remarks",
                             held([](const SharedModel& model) { return model.model().remarks; }),
                             "What was noticed before the start, as text.")
      .def_property_readonly("blocks", held(blocks),
                             "The unknown blocks: name, symbol, size and where they are.")
      .def_property_readonly(
          "system", held([](const Shared& model) { return std::make_shared<SystemHandle>(model); }),
          "The equations, a System.")
      .def_property_readonly(
          "error_scale",
          held([](const SharedModel& model) { return model.model().differential_scale; }),
          "Typical size of the differential unknowns, the wear depth [mm]: by default "
          "integrator.atol is integrator.rtol times it.")
      .def("start", held([](SharedModel& model) {
             return with_model(model, [&] {
               Counters counters;
               return model.model().start(counters);
             });
           }),
           "The consistent State at t = 0.")
      .def("observe", held([](SharedModel& model, const State& state) {
             require_state(model, state);
             return dict_of(with_model(model, [&] { return model.model().observe(state); }));
           }),
           py::arg("state"), "The scalars of a state.")
      .def("grid", held([](const SharedModel& model) { return dict_of(model.model().grid); }),
           "Points [n, 3] and cells [m, corners], or None.")
      .def("fields", held(fields), py::arg("state"), "Fields over the grid.")
      .def("contact", held(contact), py::arg("state"), "The contact surface, or None.")
      .def("exact", held([](SharedModel& model, double t) {
             const auto& exact = model.model().exact;
             return with_model(model, [&] { return exact ? exact(t) : std::nullopt; });
           }),
           py::arg("t"), "The State in closed form (differential components), or None.");
}

}  // namespace gnomon::python
