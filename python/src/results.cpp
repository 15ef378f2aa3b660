// Result files.

#include <pybind11/stl/filesystem.h>

#include <gnomon/base/error.hpp>
#include <gnomon/results/results.hpp>
#include <gnomon/run/setup.hpp>

#include "bindings.hpp"

namespace gnomon::python {

namespace {

py::dict history(const ResultReader& reader) {
  std::vector<HistoryRow> rows;
  {
    const py::gil_scoped_release without_interpreter;
    rows = reader.history();
  }
  return dict_of_rows(rows);
}

std::size_t step_at(const ResultReader& reader, std::optional<double> t) {
  const std::vector<double> times = reader.stored_times();
  if (times.empty()) throw InputError("the result has no stored step");
  if (!t) return times.size() - 1;
  for (std::size_t step = 0; step < times.size(); ++step)
    if (std::abs(times[step] - *t) <= 1e-9 * times.back()) return step;
  const auto text = [](double value) { return py::str(py::float_(value)).cast<std::string>(); };
  std::string known;
  for (const double time : times) known.append(" ").append(text(time));
  throw InputError(
      std::string("t = ").append(text(*t)).append(": expected one of the stored times") + known);
}

py::object field(const ResultReader& reader, const std::string& name, std::optional<double> t) {
  GridField field = reader.field(step_at(reader, t), name);
  if (field.components == 1) return array(std::move(field.values));
  const auto columns = static_cast<py::ssize_t>(field.components);
  const auto rows = static_cast<py::ssize_t>(field.values.size()) / columns;
  return array(std::move(field.values), {rows, columns});
}

Scene scene_of(const ResultReader& reader) {
  return scene_of_result(reader, "the scene of the result", {},
                         "load it by gnomon.load_plugin, or register the law or integrator again");
}

}  // namespace

void add_results(py::module_& module) {
  py::class_<ResultReader, std::shared_ptr<ResultReader>>(module, "_Result")
      .def(py::init<const std::filesystem::path&>(), py::arg("file"))
      .def_property_readonly(
          "status", held(&ResultReader::status),
          "How the run ended: finished, interrupted, failed: ..., or running or crashed.")
      .def_property_readonly("wall_seconds", held(&ResultReader::wall_seconds),
                             "Wall time of the integration.")
      .def_property_readonly("problem",
                             held([](const ResultReader& r) { return r.header().problem; }),
                             "Name of the problem.")
      .def_property_readonly("integrator",
                             held([](const ResultReader& r) { return r.header().integrator; }),
                             "Name of the integrator.")
      .def_property_readonly("scene_text",
                             held([](const ResultReader& r) { return r.header().scene; }),
                             "The resolved scene as TOML text.")
      .def_property_readonly("_scene", held(scene_of))
      .def("model", held([](const ResultReader& r) {
             const py::gil_scoped_release without_interpreter;
             return std::make_shared<SharedModel>(
                 set_up_again(scene_of(r), r.grid(), r.header().model_end));
           }),
           "The Model of the run, with the mesh that the result keeps.")
      .def_property_readonly("versions",
                             held([](const ResultReader& r) { return r.header().versions; }),
                             "Versions of gnomon and its libraries that made it.")
      .def_property_readonly("times",
                             held([](const ResultReader& r) { return array(r.stored_times()); }),
                             "Times of the stored steps.")
      .def_property_readonly("field_names", held(&ResultReader::field_names),
                             "Names of the stored fields.")
      .def("history", held(history))
      .def("contact", held([](const ResultReader& r, std::optional<double> t) {
             return dict_of(r.contact(t));
           }),
           py::arg("t") = py::none(),
           "The contact surface at a stored time, as arrays by name; of a cycle also "
           "phase_position, "
           "phase_weight and phase_pressure [phases, nodes]; where friction may stick "
           "phase_traction and phase_slip [phases, nodes, dim], and phase_loop [phases, 2 dim], "
           "the place of the counter-body and the force that moves it, and where it turns "
           "phase_turn [phases, 2], its angle and the moment.")
      .def_property_readonly("phase_errors", held([](const ResultReader& r) {
                               py::list errors;
                               for (const PhaseError& at : r.phase_errors())
                                 errors.append(py::make_tuple(at.t, at.phases, at.error));
                               return errors;
                             }),
                             "Of a cycle: (t, phases, error) of each estimate of the error of the "
                             "mean over its phases.")
      .def("field", held(field), py::arg("name"), py::arg("t") = py::none(),
           "A field at a stored time: one value or vector for each node or cell.")
      .def("grid", held([](const ResultReader& r, std::optional<double> t) {
             const bool stored = t || !r.stored_times().empty();
             return dict_of(r.grid(stored ? r.epoch_of(step_at(r, t)) : 0));
           }),
           py::arg("t") = py::none(),
           "Points [n, 3] and cells [m, corners], or None. In a later epoch the mesh may be "
           "another one.");
}

}  // namespace gnomon::python
