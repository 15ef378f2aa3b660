#include "mesh/import_nodes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <map>

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

void check_elements(const ImportedMesh& mesh, const ElementList& list, int dimension) {
  for (int e = 0; e < list.size(); ++e) {
    if (dimension_of(list.kinds[e]) != dimension ||
        std::ssize(list.at(e)) != node_count(list.kinds[e]))
      refuse_mesh(mesh.file,
                  fmt::format("element {} is no {}", list.tags[e], name_of(list.kinds[e])));
    for (int node : list.at(e))
      if (node < 0 || node >= std::ssize(mesh.nodes))
        refuse_mesh(mesh.file,
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
        refuse_mesh(mesh.file, fmt::format("{} has an element that is not in the file",
                                           toml_text(group.name)));
  }
}

}  // namespace

void refuse_mesh(const std::string& file, const std::string& why) {
  throw InputError(fmt::format("{}: {}", file, why));
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
        mesh.file,
        "has no cells, only points or curves; expected a mesh of the body itself (in Gmsh: "
        "mesh in 2D or 3D, and where groups are named, also name that of the body, by Physical "
        "Surface or Physical Volume, since Gmsh saves only what is in a group)");
  if (mesh.dimension != dim)
    refuse_mesh(
        mesh.file,
        fmt::format("is a mesh in {}D, expected one in {}D{}", mesh.dimension, dim,
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
        refuse_mesh(mesh.file, fmt::format("node {} lies at {}, expected finite coordinates",
                                           mesh.node_tags[node], place_text(mesh.nodes[node])));
  if (!(diagonal(mesh) > 1 / far)) refuse_mesh(mesh.file, "has all its nodes at one place");
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
      refuse_mesh(mesh.file,
                  "lies in the plane of x and z, expected that of x and y (in Gmsh: Rotate "
                  "{{1, 0, 0}, {0, 0, 0}, -Pi/2})");
    if (size[0] <= tolerance)
      refuse_mesh(mesh.file,
                  "lies in the plane of y and z, expected that of x and y (in Gmsh: Rotate "
                  "{{0, 1, 0}, {0, 0, 0}, Pi/2})");
    refuse_mesh(mesh.file,
                fmt::format("is a surface in space (z from {:.6g} to {:.6g}), expected a "
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
  ElementList kept;
  std::map<std::vector<int>, int> first;  // number of the cell that stays, by its sorted nodes
  std::vector<int> now;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const ElementKind kind = mesh.cells.kinds[cell];
    const std::int64_t tag = mesh.cells.tags[cell];
    const std::span<const int> nodes = mesh.cells.at(cell);
    const std::vector<int> key = sorted(std::vector<int>(nodes.begin(), nodes.end()));
    if (const auto twice = std::ranges::adjacent_find(key); twice != key.end())
      refuse_mesh(
          mesh.file,
          fmt::format("element {} has two corners at one node, {} at {}, expected a "
                      "{} of as many nodes as corners",
                      tag, mesh.node_tags[*twice], place_text(mesh.nodes[*twice]), name_of(kind)));
    const auto [place, is_new] = first.try_emplace(key, kept.size());
    if (is_new) kept.add(kind, tag, nodes);
    now.push_back(place->second);
  }
  const int dropped = mesh.cells.size() - kept.size();
  if (dropped == 0) return;
  mesh.cells = std::move(kept);
  for (MeshGroup& group : mesh.groups) {
    if (group.dimension != mesh.dimension) continue;
    for (int& member : group.members) member = now[member];
    sort_once(group.members);
  }
  mesh.remarks.push_back(fmt::format("{} listed twice (in several groups?) {} taken once",
                                     counted(dropped, "cell"), dropped == 1 ? "was" : "were"));
}

}  // namespace gnomon
