#include <pybind11/stl/filesystem.h>

#include <gnomon/model/problem.hpp>

#include "bindings.hpp"

namespace gnomon::python {

void add_scene(py::module_& module) {
  using Overrides = std::vector<std::string>;
  static const std::string by_key;  // messages name an override by its key alone
  py::class_<Scene, std::shared_ptr<Scene>>(module, "Scene")
      .def(py::init([](const std::filesystem::path& file, const Overrides& overrides) {
             return checked_scene(file, overrides, by_key);
           }),
           py::arg("file"), py::arg("overrides") = Overrides{})
      .def(py::init(
               [](const std::string& text, const std::string& name, const Overrides& overrides) {
                 return checked_scene_of_text(text, name, overrides, by_key);
               }),
           py::arg("text"), py::arg("name"), py::arg("overrides"))
      .def("resolved", held(&Scene::resolved),
           "The complete scene as TOML text, defaults included.")
      .def_property_readonly("path", held(&Scene::path), "The file that it came from.")
      .def("__eq__", held([](const Scene& a, const Scene& b) { return a == b; }))
      .def("__eq__", held([](const Scene&, const py::object&) { return false; }))
      .attr("__hash__") = py::none();
  module.def("_key_help",
             held([](const std::string& problem) { return describe_keys(key_table(problem)); }));
}

}  // namespace gnomon::python
