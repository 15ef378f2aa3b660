#include "part/body_meshes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/scene/keys.hpp>
#include <map>
#include <numeric>
#include <utility>

#include "part/histories.hpp"

namespace gnomon::part {

std::vector<Key> body_mesh_keys() {
  return {{.name = "body.#.mesh",
           .kind = KeyKind::text,
           .absent_meaning = "a group of mesh.file",
           .names_file = true,
           .help = "mesh or geometry of this body alone, instead of mesh.file"},
          reals_key("body.#.shift", "mm", absent("where its file has it"), {},
                    "by which the mesh of this body is moved")};
}

namespace {

/// The number of each [[body]] that has a mesh of its own.
std::vector<std::string> bodies_with_mesh(const Scene& scene) {
  return scene.chosen_names("body.#.mesh");
}

/// The file that a key names: beside the scene, unless its path is absolute.
ImportedMesh read_file(const Scene& scene, const std::string& key, FineZone fine) {
  if (!is_geometry(scene.text(key))) fine = {};
  try {
    return read_mesh_file(scene.path().parent_path() / scene.text(key),
                          {.size = scene.real_if("mesh.size").value_or(0),
                           .factor = scene.real("mesh.factor"),
                           .fine = std::move(fine)});
  } catch (const InputError& error) {
    throw InputError(scene.where(key) + ": " + error.what());
  }
}

void move(const Scene& scene, const std::string& key, ImportedMesh& mesh) {
  if (!scene.given(key)) return;
  const std::vector<double>& shift = scene.reals(key);
  if (static_cast<int>(shift.size()) != mesh.dimension)
    throw InputError(fmt::format("{}: expected {} numbers, got {}", scene.where(key),
                                 mesh.dimension, shift.size()));
  for (auto& node : mesh.nodes)
    for (std::size_t i = 0; i < shift.size(); ++i) node[i] += shift[i];
}

/// In the coordinates of the file of a body that the scene moves.
FineZone moved_back(const Scene& scene, const std::string& key, FineZone fine) {
  if (!scene.given(key)) return fine;
  const std::vector<double>& shift = scene.reals(key);
  for (FineZone::Ball& ball : fine.balls)
    for (std::size_t i = 0; i < std::min<std::size_t>(shift.size(), 3); ++i) ball[i] -= shift[i];
  return fine;
}

/// The cells of the file become the body's group; its other groups of cells are left out.
void make_body(ImportedMesh& mesh, const std::string& body) {
  std::erase_if(mesh.groups,
                [&](const MeshGroup& group) { return group.dimension == mesh.dimension; });
  MeshGroup all{.name = body, .dimension = mesh.dimension, .members = {}};
  all.members.resize(static_cast<std::size_t>(mesh.cells.size()));
  std::iota(all.members.begin(), all.members.end(), 0);
  mesh.groups.push_back(std::move(all));
}

void append(const ElementList& more, int first_node, ElementList& list) {
  for (int k = 0; k < more.size(); ++k) {
    std::vector<int> nodes(more.at(k).begin(), more.at(k).end());
    for (int& node : nodes) node += first_node;
    list.add(more.kinds[static_cast<std::size_t>(k)], more.tags[static_cast<std::size_t>(k)],
             nodes);
  }
}

void append(ImportedMesh more, ImportedMesh& mesh) {
  const auto nodes = static_cast<int>(mesh.nodes.size());
  const int cells = mesh.cells.size(), facets = mesh.facets.size();
  mesh.nodes.insert(mesh.nodes.end(), more.nodes.begin(), more.nodes.end());
  mesh.node_tags.insert(mesh.node_tags.end(), more.node_tags.begin(), more.node_tags.end());
  append(more.cells, nodes, mesh.cells);
  append(more.facets, nodes, mesh.facets);
  for (MeshGroup& group : more.groups) {
    const int first = group.dimension == mesh.dimension       ? cells
                      : group.dimension == mesh.dimension - 1 ? facets
                                                              : nodes;
    for (int& member : group.members) member += first;
    mesh.groups.push_back(std::move(group));
  }
  mesh.has_sizes = mesh.has_sizes || more.has_sizes;
  mesh.remarks.insert(mesh.remarks.end(), more.remarks.begin(), more.remarks.end());
  mesh.file += " and " + more.file;
}

/// The body goes before names that several files have.
void tell_apart(std::vector<ImportedMesh>& meshes, const std::vector<std::string>& bodies) {
  std::map<std::string, int> files;
  for (const ImportedMesh& mesh : meshes)
    for (const MeshGroup& group : mesh.groups) ++files[group.name];
  for (std::size_t k = 0; k < meshes.size(); ++k)
    for (MeshGroup& group : meshes[k].groups)
      if (files[group.name] > 1) group.name = bodies[k] + "." + group.name;
}

ImportedMesh read_meshes_of_bodies(const Scene& scene, const FineZone& fine) {
  if (scene.has("mesh.file")) refuse(scene, "mesh.file", "none beside body.#.mesh");
  std::vector<ImportedMesh> meshes;
  std::vector<std::string> bodies;
  for (const std::string& number : scene.chosen_names("body.#.name")) {
    const std::string table = "body." + number, key = table + ".mesh";
    if (!scene.given(key))
      throw InputError(fmt::format("{}: [[body]] number {}: expected `mesh`, as the others have",
                                   scene.path().string(), number));
    meshes.push_back(read_file(scene, key, moved_back(scene, table + ".shift", fine)));
    bodies.push_back(scene.text(table + ".name"));
    if (meshes.back().dimension != meshes.front().dimension)
      refuse(scene, key, "meshes that are all in the plane, or in space");
    move(scene, table + ".shift", meshes.back());
    make_body(meshes.back(), bodies.back());
  }
  tell_apart(meshes, bodies);
  ImportedMesh mesh = std::move(meshes.front());
  for (std::size_t k = 1; k < meshes.size(); ++k) append(std::move(meshes[k]), mesh);
  return mesh;
}

}  // namespace

bool has_geometry(const Scene& scene) {
  const auto is = [&](const std::string& key) {
    return scene.given(key) && is_geometry(scene.text(key));
  };
  const std::vector<std::string> bodies = bodies_with_mesh(scene);
  return is("mesh.file") || std::ranges::any_of(bodies, [&](const std::string& number) {
           return is("body." + number + ".mesh");
         });
}

ImportedMesh read_mesh(const Scene& scene, const FineZone& fine) {
  if (!bodies_with_mesh(scene).empty()) return read_meshes_of_bodies(scene, fine);
  if (!scene.has("mesh.file"))
    throw InputError(scene.path().string() +
                     ": section [mesh]: expected `file`, a mesh, or a geometry, which Gmsh meshes");
  return read_file(scene, "mesh.file", fine);
}

}  // namespace gnomon::part
