#include "mesh/import_nodes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>

#include "mesh/facet_table.hpp"
#include "scene/toml_text.hpp"

namespace gnomon {

namespace {

constexpr double same_plane = 1e-9;  // of the diagonal

Eigen::AlignedBox3d box_of(const ImportedMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const auto& place : mesh.nodes) box.extend(Eigen::Vector3d::Map(place.data()));
  return box;
}

/// Elements that stand in for themselves stay, in the list and in the groups; the others give their
/// place in groups to the one that stands in for them.
void keep_elements(ElementList& list, std::vector<MeshGroup>& groups, int dimension,
                   const std::vector<int>& stand_in) {
  ElementList kept;
  std::vector<int> now(stand_in.size(), -1);
  for (int e = 0; e < list.size(); ++e) {
    if (stand_in[e] != e) continue;
    now[e] = kept.size();
    kept.add(list.kinds[e], list.tags[e], list.at(e));
  }
  list = std::move(kept);
  for (MeshGroup& group : groups) {
    if (group.dimension != dimension) continue;
    for (int& member : group.members) member = now[stand_in[member]];
    sort_once(group.members);
  }
}

void check_elements(const ImportedMesh& mesh, const ElementList& list, int dimension) {
  for (int e = 0; e < list.size(); ++e) {
    if (dimension_of(list.kinds[e]) != dimension ||
        std::ssize(list.at(e)) != node_count(list.kinds[e]))
      refuse_mesh(mesh, fmt::format("element {} is no {}", list.tags[e], name_of(list.kinds[e])));
    for (int node : list.at(e))
      if (node < 0 || node >= std::ssize(mesh.nodes))
        refuse_mesh(mesh,
                    fmt::format("element {} has a node that is not in the file", list.tags[e]));
  }
}

void check_members(const ImportedMesh& mesh) {
  for (const MeshGroup& group : mesh.groups) {
    std::ptrdiff_t count = 0;  // there are none of a higher dimension
    if (group.dimension == mesh.dimension)
      count = mesh.cells.size();
    else if (group.dimension == mesh.dimension - 1)
      count = mesh.facets.size();
    else if (group.dimension < mesh.dimension)
      count = std::ssize(mesh.nodes);
    for (int member : group.members)
      if (member < 0 || member >= count)
        refuse_mesh(
            mesh, fmt::format("{} has an element that is not in the file", toml_text(group.name)));
  }
}

}  // namespace

void refuse_mesh(const ImportedMesh& mesh, const std::string& why) {
  throw InputError(fmt::format("{}: {}", mesh.file, why));
}

std::string counted(long count, const char* what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string place_text(std::span<const double> place) {
  return fmt::format("({:.6g})", fmt::join(place, ", "));
}

double diagonal(const ImportedMesh& mesh) {
  return box_of(mesh).diagonal().norm();
}

void check_content(const ImportedMesh& mesh, int dim) {
  const char* physical = dim == 2 ? "Physical Surface" : "Physical Volume";
  if (mesh.dimension < 2 || mesh.cells.size() == 0)
    refuse_mesh(
        mesh,
        "has no cells, only points or curves; expected a mesh of the body itself (in Gmsh: "
        "mesh in 2D or 3D, and where groups are named, also name that of the body, by Physical "
        "Surface or Physical Volume, since Gmsh saves only what is in a group)");
  if (mesh.dimension != dim)
    refuse_mesh(
        mesh, fmt::format("is a mesh in {}D, expected one in {}D{}", mesh.dimension, dim,
                          mesh.dimension < dim
                              ? fmt::format(" (where groups are named, Gmsh saves volumes only if "
                                            "they are in a {})",
                                            physical)
                              : ""));
  check_elements(mesh, mesh.cells, dim);
  check_elements(mesh, mesh.facets, dim - 1);
  check_members(mesh);
  constexpr double far = 1e100;  // whose products are numbers still
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    for (double x : mesh.nodes[node])
      if (!(std::abs(x) < far))
        refuse_mesh(mesh, fmt::format("node {} lies at {}, expected finite coordinates",
                                      mesh.node_tags[node], place_text(mesh.nodes[node])));
  if (!(diagonal(mesh) > 1 / far)) refuse_mesh(mesh, "has all its nodes at one place");
}

void renumber_nodes(ImportedMesh& mesh, const std::vector<int>& now) {
  for (ElementList* list : {&mesh.cells, &mesh.facets})
    for (int& node : list->nodes) node = now[node];
  for (MeshGroup& group : mesh.groups) {
    if (group.dimension >= mesh.dimension - 1) continue;
    for (int& node : group.members) node = now[node];
    sort_once(group.members);
  }
}

void lay_in_plane(ImportedMesh& mesh) {
  const Eigen::AlignedBox3d box = box_of(mesh);
  const Eigen::Vector3d size = box.diagonal();
  const double tolerance = same_plane * size.norm(), least = box.min()[2], most = box.max()[2];
  if (size[2] > tolerance) {
    if (size[1] <= tolerance)
      refuse_mesh(mesh,
                  "lies in the plane of x and z, expected that of x and y (in Gmsh: Rotate "
                  "{{1, 0, 0}, {0, 0, 0}, -Pi/2})");
    if (size[0] <= tolerance)
      refuse_mesh(mesh,
                  "lies in the plane of y and z, expected that of x and y (in Gmsh: Rotate "
                  "{{0, 1, 0}, {0, 0, 0}, Pi/2})");
    refuse_mesh(mesh, fmt::format("is a surface in space (z from {:.6g} to {:.6g}), expected a "
                                  "plane mesh with z = 0 or cells of a volume (in Gmsh: mesh in "
                                  "3D, and name the volume by Physical Volume)",
                                  least, most));
  }
  if (std::max(std::abs(least), std::abs(most)) > tolerance)
    mesh.remarks.push_back(fmt::format("lies at z = {:.6g}, which was taken for 0", least));
  for (auto& place : mesh.nodes) place[2] = 0;
}

void drop_unused_nodes(ImportedMesh& mesh) {
  std::vector<int> now(mesh.nodes.size(), -1);
  for (int node : mesh.cells.nodes) now[node] = 0;
  int used = 0;
  for (std::size_t node = 0; node < now.size(); ++node) {
    if (now[node] < 0) continue;
    mesh.nodes[used] = mesh.nodes[node];
    mesh.node_tags[used] = mesh.node_tags[node];
    now[node] = used++;
  }
  const int unused = static_cast<int>(now.size()) - used;
  if (unused == 0) return;
  mesh.nodes.resize(used);
  mesh.node_tags.resize(used);
  renumber_nodes(mesh, now);
  for (MeshGroup& group : mesh.groups)
    if (group.dimension < mesh.dimension - 1) std::erase(group.members, -1);
  mesh.remarks.push_back(fmt::format("{} of no cell {} left out", counted(unused, "node"),
                                     unused == 1 ? "was" : "were"));
}

void drop_equal_cells(ImportedMesh& mesh) {
  ElementList& cells = mesh.cells;
  std::vector<std::pair<std::array<int, 8>, int>> keys(cells.size());
  for (int cell = 0; cell < cells.size(); ++cell) {
    auto& key = keys[cell].first;
    key.fill(-1);
    const std::span<const int> nodes = cells.at(cell);
    std::copy(nodes.begin(), nodes.end(), key.begin());
    std::sort(key.begin(), key.begin() + nodes.size());
    const auto twice = std::adjacent_find(key.begin(), key.begin() + nodes.size());
    if (twice != key.begin() + nodes.size())
      refuse_mesh(mesh, fmt::format("element {} has two corners at one node, {} at {}, expected a "
                                    "{} of as many nodes as corners",
                                    cells.tags[cell], mesh.node_tags[*twice],
                                    place_text(mesh.nodes[*twice]), name_of(cells.kinds[cell])));
    keys[cell].second = cell;
  }
  std::sort(keys.begin(), keys.end());
  std::vector<int> stand_in(cells.size());
  long dropped = 0;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const bool again = k > 0 && keys[k].first == keys[k - 1].first;
    stand_in[keys[k].second] = again ? stand_in[keys[k - 1].second] : keys[k].second;
    dropped += again;
  }
  if (dropped == 0) return;
  keep_elements(cells, mesh.groups, mesh.dimension, stand_in);
  mesh.remarks.push_back(fmt::format("{} listed twice (in several groups?) {} taken once",
                                     counted(dropped, "cell"), dropped == 1 ? "was" : "were"));
}

}  // namespace gnomon
