#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <gnomon/linear/inner_solver.hpp>
#include <gnomon/model/memory_estimate.hpp>
#include <limits>
#include <utility>
#include <vector>

namespace gnomon {

namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

constexpr double megabyte = 1e6, kilobyte = 1e3;

double in_the_plane(const MeshSize& mesh, bool direct) {
  const double growth = std::log2(std::max(2.0, mesh.nodes));
  if (direct) return kilobyte * mesh.nodes * mesh.phases * (11 + 0.5 * growth);
  return kilobyte * mesh.nodes * (5 + 0.35 * growth + 3.5 * (mesh.phases - 1));
}

/// Entries of the Cholesky factors of three unknowns at each node of a compact body.
double usual_factor(double unknowns) {
  const double nodes = unknowns / 3;
  return 9 * nodes * std::max(10.0, 10.6 * std::cbrt(nodes) - 22);
}

/// Large factors have a copy in single precision; CHOLMOD stores zeros among the entries.
double factor_memory(double analysed, double unknowns) {
  constexpr double stored = 1.23, large = 5e6;
  const double entries = analysed > 0 ? analysed : usual_factor(unknowns) / stored;
  return stored * entries * (entries < large ? 8 : 12);
}

double in_space(const MeshSize& mesh, const LinearSolverChoice& solver) {
  const double u = mesh.displacements / 3, d = mesh.shapes / 3;
  const double further = kilobyte * 11.5 * u * (mesh.phases - 1);  // share the factors
  if (!solver.uses_factors()) return 26 * megabyte + kilobyte * (25.6 * u + 12.3 * d) + further;
  const double stiffness = factor_memory(mesh.displacement_factor, mesh.displacements);
  if (solver.method == LinearSolverChoice::Method::direct) {
    const double together = std::pow(1 + mesh.shapes / std::max(1.0, mesh.displacements), 2);
    return mesh.phases * (kilobyte * 24 * u + 4 * together * stiffness);
  }
  return kilobyte * (25.8 * u + 5.9 * d) + further + stiffness +
         factor_memory(mesh.shape_factor, mesh.shapes);
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

constexpr double program = 30 * megabyte;  // and its libraries

/// A limit of addresses counts what is mapped, not what is used: the libraries, and the buffer of
/// OpenBLAS, which tries without an end to get one where there is no room for it.
double free_addresses() {
  constexpr double blas_buffer = 136 * megabyte;
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  const double pages = number_in("/proc/self/statm");
  const double mapped =
      std::isfinite(pages) ? pages * static_cast<double>(sysconf(_SC_PAGESIZE)) : 0;
  return std::max(0.0, static_cast<double>(limit.rlim_cur) - mapped - blas_buffer + program);
}

}  // namespace

double estimated_memory(const MeshSize& mesh, const LinearSolverChoice& solver) {
  if (mesh.dim == 3) return program + in_space(mesh, solver);
  return program + in_the_plane(mesh, solver.method == LinearSolverChoice::Method::direct);
}

double available_memory() {
  return std::min({free_of_system(), free_of_control_group(), free_addresses()});
}

namespace {

using Method = LinearSolverChoice::Method;
using Preconditioner = LinearSolverChoice::Preconditioner;

/// As the keys of a scene.
std::string keys_of(const LinearSolverChoice& solver) {
  if (solver.method == Method::direct) return "solver.method = \"direct\"";
  return fmt::format("solver.preconditioner = \"{}\"",
                     solver.preconditioner == Preconditioner::factor ? "factor" : "multigrid");
}

/// Solvers that need less memory, and what makes a scene use them.
std::vector<std::pair<LinearSolverChoice, std::string>> thriftier(
    const LinearSolverChoice& solver) {
  std::vector<std::pair<LinearSolverChoice, std::string>> choices;
  LinearSolverChoice block = solver;
  block.method = Method::block;
  const bool direct = solver.method == Method::direct;
  if (direct) choices.emplace_back(block, "solver.method = \"block\"");
  if (block.preconditioner == Preconditioner::factor && has_multigrid()) {
    block.preconditioner = Preconditioner::multigrid;
    choices.emplace_back(block, (direct ? "solver.method = \"block\" with " : "") + keys_of(block));
  }
  return choices;
}

}  // namespace

std::string missing_memory_text(const MeshSize& mesh, const LinearSolverChoice& solver,
                                double available) {
  const double needed = estimated_memory(mesh, solver);
  if (needed <= available) return {};
  std::string text =
      fmt::format("about {} of memory with {}, {} are available; expected a coarser mesh",
                  memory_text(needed), keys_of(solver), memory_text(available));
  for (const auto& [choice, keys] : thriftier(solver))
    if (const double less = estimated_memory(mesh, choice); less <= available)
      return text + fmt::format(", or {}, which needs about {}", keys, memory_text(less));
  return text;
}

std::string memory_text(double bytes) {
  if (bytes < 1e9) return fmt::format("{:.0f} MB", bytes / 1e6);
  if (bytes < 1e12) return fmt::format("{:.3g} GB", bytes / 1e9);
  return fmt::format("{:.0f} TB", bytes / 1e12);
}

}  // namespace gnomon
