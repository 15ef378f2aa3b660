#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <gnomon/model/memory_estimate.hpp>
#include <limits>

namespace gnomon {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// kB per node; measured on the meshes in docs/linear.md.
double kilobytes_a_node(const MeshSize& mesh, const LinearSolverChoice& solver) {
  const bool direct = solver.method == LinearSolverChoice::Method::direct;
  if (mesh.dim == 2) {
    const double growth = std::log2(std::max(2.0, mesh.nodes));
    return direct ? 11 + 0.5 * growth : 5 + 0.35 * growth;
  }
  const double growth = std::cbrt(mesh.nodes);
  if (direct) return 30 + 5.7 * growth;
  const bool multigrid = solver.preconditioner == LinearSolverChoice::Preconditioner::multigrid;
  return multigrid ? 35 : 27 + 1.5 * growth;
}

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

double address_space() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  return static_cast<double>(limit.rlim_cur);
}

}  // namespace

double estimated_memory(const MeshSize& mesh, const LinearSolverChoice& solver) {
  constexpr double program = 18e6;  // the program and its libraries
  return program + 1e3 * mesh.nodes * kilobytes_a_node(mesh, solver);
}

double available_memory() {
  return std::min({free_of_system(), free_of_control_group(), address_space()});
}

std::string memory_text(double bytes) {
  if (bytes < 1e9) return fmt::format("{:.0f} MB", bytes / 1e6);
  if (bytes < 1e12) return fmt::format("{:.3g} GB", bytes / 1e9);
  return fmt::format("{:.0f} TB", bytes / 1e12);
}

}  // namespace gnomon
