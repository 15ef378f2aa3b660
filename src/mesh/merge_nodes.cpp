#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/tensor.hpp>
#include <gnomon/mesh/imported_body.hpp>
#include <numeric>

#include "mesh/import_nodes.hpp"

namespace gnomon {

namespace {

constexpr double same_place = 1e-8;  // of the diagonal

/// Positions along a line in no particular direction: hardly any nodes of a mesh, however regular
/// it is, are near to each other along it unless they are near in space.
std::vector<double> positions_along_line(const std::vector<Vector<3>>& places) {
  const Vector<3> direction = Vector<3>(0.4142135624, 0.7320508076, 0.5413248546).normalized();
  std::vector<double> along;
  for (const Vector<3>& place : places) along.push_back((place - places.front()).dot(direction));
  return along;
}

/// The node of the least number that stands for a node and for those merged with it.
int kept_for(std::vector<int>& now, int node) {
  while (now[node] != node) node = now[node] = now[now[node]];
  return node;
}

/// By node: which of the separate groups of cells it belongs to; -1: none.
std::vector<int> bodies_of_nodes(const ImportedMesh& mesh,
                                 const std::vector<std::string>& separate) {
  std::vector<int> body(mesh.nodes.size(), -1);
  for (const MeshGroup& group : mesh.groups) {
    const auto at = std::ranges::find(separate, group.name);
    if (at == separate.end() || group.dimension != mesh.dimension) continue;
    for (const int cell : group.members)
      for (const int node : mesh.cells.at(cell))
        body[node] = static_cast<int>(at - separate.begin());
  }
  return body;
}

}  // namespace

std::vector<std::string> separate_groups(const ImportedMesh& mesh) {
  std::vector<std::string> names;
  std::vector<int> group_of(mesh.nodes.size(), -1), bonded;
  for (const MeshGroup& group : mesh.groups) {
    if (group.dimension != mesh.dimension) continue;
    const auto number = static_cast<int>(names.size());
    names.push_back(group.name);
    bonded.push_back(number);
    for (const int cell : group.members)
      for (const int node : mesh.cells.at(cell)) {
        if (group_of[node] < 0) group_of[node] = number;
        const auto [kept, gone] =
            std::minmax({kept_for(bonded, group_of[node]), kept_for(bonded, number)});
        bonded[gone] = kept;
      }
  }
  bool is_one = true;
  for (int number = 0; number < std::ssize(names); ++number)
    is_one = is_one && kept_for(bonded, number) == 0;
  return is_one ? std::vector<std::string>() : names;
}

void merge_equal_nodes(ImportedMesh& mesh, const std::vector<std::string>& separate) {
  const std::vector<int> body = bodies_of_nodes(mesh, separate);
  const double tolerance = same_place * diagonal(mesh);
  std::vector<Vector<3>> places;
  for (const auto& place : mesh.nodes) places.push_back(Vector<3>::Map(place.data()));
  const std::vector<double> along = positions_along_line(places);
  std::vector<int> order(places.size()), now(places.size());
  std::iota(order.begin(), order.end(), 0);
  std::iota(now.begin(), now.end(), 0);
  std::ranges::sort(order, {}, [&](int node) { return along[node]; });
  long merged = 0;
  for (auto one = order.begin(); one != order.end(); ++one)
    for (auto other = one + 1; other != order.end() && along[*other] - along[*one] <= tolerance;
         ++other) {
      if ((places[*one] - places[*other]).norm() > tolerance) continue;
      if (body[*one] != body[*other]) continue;
      // A chain of nodes may lead from one to the next.
      const auto [kept, gone] = std::minmax({kept_for(now, *one), kept_for(now, *other)});
      now[gone] = kept;
      merged += gone != kept;
    }
  if (merged == 0) return;
  for (int node = 0; node < std::ssize(now); ++node) now[node] = kept_for(now, node);
  renumber_nodes(mesh, now);
  mesh.remarks.push_back(fmt::format("{} at the place of another {} merged (within {:.2g})",
                                     counted(merged, "node"), merged == 1 ? "was" : "were",
                                     tolerance));
}

}  // namespace gnomon
