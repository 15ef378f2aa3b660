#include <dlfcn.h>
#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/newton/linear_solver_kind.hpp>
#include <gnomon/run/plugin.hpp>
#include <gnomon/shapes/counter_shape_kind.hpp>
#include <gnomon/terms/material_law.hpp>
#include <gnomon/wear_laws/wear_law_kind.hpp>
#include <iterator>
#include <sstream>

namespace gnomon {

namespace {

template <class... Entries>
std::size_t registered() {
  return (Registry<Entries>::all().size() + ...);
}

/// Everything that a plug-in may register. Throws RegistrationError for a name that was taken.
std::size_t all_registered() {
  return registered<Integrator, Problem, WearLawKind, CounterShapeKind, MaterialLaw,
                    LinearSolverKind>();
}

/// Refuses a plug-in that was compiled for other headers than this library: its objects would have
/// another layout, and its registrations, which run when it is loaded, could crash. The stamp is in
/// everything that links the target gnomon::gnomon, as a text.
void require_same_interface(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  const std::string kind = "gnomon interface ";
  if (bytes.find(kind + GNOMON_INTERFACE) != std::string::npos) return;
  const bool stamped = bytes.find(kind) != std::string::npos;
  throw InputError(
      fmt::format("plug-in {}: {}, expected a shared library that is compiled for this gnomon and "
                  "links gnomon::gnomon",
                  file.string(),
                  stamped ? "was compiled for another gnomon" : "has no stamp of its interface"));
}

}  // namespace

void load_plugin(const std::filesystem::path& file) {
  const std::string name = file.string();
  if (!std::filesystem::is_regular_file(file))
    throw InputError(fmt::format("plug-in {}: there is no such file", name));
  require_same_interface(file);
  const std::size_t before = all_registered();
  // Absolute, because a name without a slash would be searched for in the folders of the system.
  if (!dlopen(std::filesystem::absolute(file).c_str(), RTLD_NOW | RTLD_LOCAL))
    throw InputError(fmt::format("plug-in {}: cannot be loaded: {}", name, dlerror()));
  try {
    if (all_registered() > before) return;
  } catch (const RegistrationError& error) {
    throw InputError(fmt::format("plug-in {}: {}", name, error.what()));
  }
  throw InputError(fmt::format(
      "plug-in {}: registers nothing, or is loaded already, expected a Registration", name));
}

void load_plugins_of_environment() {
  const char* names = std::getenv("GNOMON_PLUGINS");
  std::istringstream list(names ? names : "");
  for (std::string name; std::getline(list, name, ':');) {
    if (name.empty()) continue;
    try {
      load_plugin(name);
    } catch (const InputError& error) {
      throw InputError(fmt::format("GNOMON_PLUGINS: {}", error.what()));
    }
  }
}

}  // namespace gnomon
