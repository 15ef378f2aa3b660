#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <gnomon/base/error.hpp>
#include <gnomon/model/memory_estimate.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace gnomon {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The number at the beginning of a file; infinite if there is none ("max").
double number_in(const std::string& file) {
  std::ifstream stream(file);
  double value = 0;
  return stream >> value ? value : unlimited;
}

double free_of_system() {
  std::ifstream stream("/proc/meminfo");
  for (std::string name, unit; stream >> name;) {
    double kilobytes = 0;
    if (name == "MemAvailable:" && stream >> kilobytes) return 1024 * kilobytes;
    std::getline(stream, unit);
  }
  return unlimited;
}

double free_of_control_group() {
  std::ifstream stream("/proc/self/cgroup");
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with("0::")) continue;  // version 2
    const std::string group = "/sys/fs/cgroup" + line.substr(3);
    const double most = number_in(group + "/memory.max");
    const double used = number_in(group + "/memory.current");
    if (std::isfinite(most) && std::isfinite(used)) return most - used;
  }
  return unlimited;
}

constexpr double program = 30e6;  // and its libraries [bytes]

/// A limit of addresses counts what is mapped, not what is used: the libraries, and the buffer of
/// OpenBLAS, which tries without an end to get one where there is no room for it.
double free_addresses() {
  constexpr double blas_buffer = 136e6;
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  const double pages = number_in("/proc/self/statm");
  const double mapped =
      std::isfinite(pages) ? pages * static_cast<double>(sysconf(_SC_PAGESIZE)) : 0;
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - mapped - blas_buffer + program);
}

}  // namespace

double estimated_memory(const Scene& scene, const MeshSize& mesh) {
  return program + linear_solver_kind(scene).memory(scene, mesh);
}

double available_memory() {
  return std::min({free_of_system(), free_of_control_group(), free_addresses()});
}

namespace {

std::string setting(const std::string& key, const std::string& value) {
  return fmt::format("{} = \"{}\"", key, value);
}

/// Of the linear solver that the scene chooses.
std::string keys_of(const Scene& scene, const MeshSize& mesh) {
  const LinearSolverKind& kind = linear_solver_kind(scene);
  const auto keys = kind.make(scene, mesh).keys;
  return keys.empty() ? setting("solver.method", kind.name)
                      : setting(keys.begin()->first, keys.begin()->second);
}

/// Scenes that choose another linear solver, and the keys by which they do so.
std::vector<std::pair<Scene, std::string>> others(const Scene& scene) {
  std::vector<std::pair<Scene, std::string>> result;
  for (const LinearSolverKind& kind : Registry<LinearSolverKind>::all()) {
    const Scene by_kind = scene.with("solver.method", kind.name);
    std::string method;
    if (kind.name != scene.text("solver.method")) {
      method = setting("solver.method", kind.name);
      result.emplace_back(by_kind, method);
      method += " with ";
    }
    for (const Key& key : kind.keys)
      for (const std::string& value : key.choices)
        result.emplace_back(by_kind.with(key.name, value), method + setting(key.name, value));
  }
  return result;
}

}  // namespace

std::string missing_memory_text(const Scene& scene, const MeshSize& mesh, double needed,
                                double available) {
  if (needed <= available) return {};
  std::string text =
      fmt::format("about {} of memory with {}, {} are available; expected a coarser mesh",
                  memory_text(needed), keys_of(scene, mesh), memory_text(available));
  for (const auto& [other, keys] : others(scene))
    if (const double less = estimated_memory(other, mesh); less <= available)
      return text + fmt::format(", or {}, which needs about {}", keys, memory_text(less));
  return text;
}

double required_memory(const Scene& scene, const MeshSize& mesh) {
  const double needed = estimated_memory(scene, mesh);
  const std::string missing = missing_memory_text(scene, mesh, needed, available_memory());
  if (missing.empty()) return needed;
  throw InputError(fmt::format("{}: its mesh needs {}", scene.path().string(), missing));
}

std::string memory_text(double bytes) {
  if (bytes < 1e9) return fmt::format("{:.0f} MB", bytes / 1e6);
  if (bytes < 1e12) return fmt::format("{:.3g} GB", bytes / 1e9);
  return fmt::format("{:.0f} TB", bytes / 1e12);
}

}  // namespace gnomon
