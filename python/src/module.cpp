#include <pybind11/stl/filesystem.h>

#include <gnomon/base/installation.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/results/versions.hpp>
#include <gnomon/run/plugin.hpp>
#include <gnomon/wear_laws/wear_law_kind.hpp>

#include "bindings.hpp"

PYBIND11_MODULE(_gnomon, module) {
  using namespace gnomon;
  namespace py = pybind11;
  module.doc() = "gnomon's library; use the package gnomon.";
  python::add_errors(module);
  python::add_scene(module);
  python::add_model(module);
  python::add_runs(module);
  python::add_results(module);
  python::add_extensions(module);
  python::add_arrays(module);
  python::add_budget(module);
  module.attr("__version__") = library_versions().at("gnomon");
  module.def(
      "integrators", [] { return Integrators::names(); }, "Names of the integrators.");
  module.def(
      "problems", [] { return Problems::names(); }, "Names of the problems.");
  module.def(
      "wear_laws", [] { return Registry<WearLawKind>::names(); }, "Names of the wear laws.");
  module.def("load_plugin", load_plugin, py::arg("file"),
             "Loads a plug-in in C++ (docs/library.md) for the rest of the process.");
  module.def("installed", installed, py::arg("part"), "A file of this installation.");
  module.def("versions", library_versions, "Versions of gnomon and its libraries.");
}
