#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesh/import_nodes.hpp"

namespace gnomon {

namespace {

constexpr double same_place = 1e-8;  // of the diagonal

using Place = std::array<double, 3>;

/// A node in a cube of space; a node near the side of its cube is in the neighbouring one as well.
struct Entry {
  std::uint64_t cube;
  int node;
  bool operator<(const Entry& other) const {
    return cube != other.cube ? cube < other.cube : node < other.node;
  }
};

/// Cubes that happen to have the same number do no harm: distances are compared anyway.
std::uint64_t cube_number(const std::array<std::int64_t, 3>& index) {
  std::uint64_t result = 0;
  for (std::int64_t i : index) {
    result ^= static_cast<std::uint64_t>(i) + 0x9e3779b97f4a7c15 + (result << 6) + (result >> 2);
    result *= 0xff51afd7ed558ccd;
  }
  return result;
}

std::vector<Entry> cubes_of(const ImportedMesh& mesh, double tolerance) {
  // Not at round coordinates, where nodes are and sides of cubes should not be.
  const double edge = 16 * tolerance, origin = 0.3819660113 * edge;
  Place low = mesh.nodes[0];
  for (const Place& place : mesh.nodes)
    for (int i = 0; i < 3; ++i) low[i] = std::min(low[i], place[i]);
  std::vector<Entry> entries;
  entries.reserve(mesh.nodes.size() * 3 / 2);
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node) {
    std::array<std::int64_t, 3> first, last;
    for (int i = 0; i < 3; ++i) {
      const double x = (mesh.nodes[node][i] - low[i] + origin) / edge;
      first[i] = static_cast<std::int64_t>(std::floor(x - tolerance / edge));
      last[i] = static_cast<std::int64_t>(std::floor(x + tolerance / edge));
    }
    for (auto i = first[0]; i <= last[0]; ++i)
      for (auto j = first[1]; j <= last[1]; ++j)
        for (auto k = first[2]; k <= last[2]; ++k)
          entries.push_back({cube_number({i, j, k}), static_cast<int>(node)});
  }
  std::sort(entries.begin(), entries.end());
  return entries;
}

double distance(const Place& a, const Place& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

}  // namespace

void merge_equal_nodes(ImportedMesh& mesh) {
  const double tolerance = same_place * diagonal(mesh);
  const std::vector<Entry> entries = cubes_of(mesh, tolerance);
  std::vector<int> now(mesh.nodes.size());
  std::iota(now.begin(), now.end(), 0);
  long merged = 0;
  for (std::size_t k = 0; k < entries.size(); ++k)
    for (std::size_t l = k + 1; l < entries.size() && entries[l].cube == entries[k].cube; ++l) {
      const int kept = entries[k].node, gone = entries[l].node;
      if (kept == gone || now[kept] != kept || now[gone] != gone) continue;
      if (distance(mesh.nodes[kept], mesh.nodes[gone]) > tolerance) continue;
      now[gone] = kept;
      ++merged;
    }
  if (merged == 0) return;
  // A chain of nodes may lead from one to the next.
  for (int& node : now)
    while (now[node] != node) node = now[node];
  renumber_nodes(mesh, now);
  mesh.remarks.push_back(fmt::format("{} at the place of another {} merged (within {:.2g})",
                                     counted(merged, "node"), merged == 1 ? "was" : "were",
                                     tolerance));
}

}  // namespace gnomon
