#include "gmsh/model_mesh.hpp"

#include <gmsh.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>

namespace gnomon::gmsh_reader {

namespace {

using Tags = std::vector<std::size_t>;

ElementKind kind_of(int type) {
  static const std::map<int, ElementKind> kinds = {
      {15, ElementKind::point},        {1, ElementKind::line},        {2, ElementKind::triangle},
      {3, ElementKind::quadrilateral}, {4, ElementKind::tetrahedron}, {5, ElementKind::hexahedron},
      {6, ElementKind::wedge},         {7, ElementKind::pyramid}};
  if (const auto found = kinds.find(type); found != kinds.end()) return found->second;
  std::string name;
  int dimension, order, count, primary;
  std::vector<double> ignored;
  gmsh::model::mesh::getElementProperties(type, name, dimension, order, count, ignored, primary);
  throw Refusal("has elements of order " + std::to_string(order) + " (" + name +
                "), expected the first order; in Gmsh: Mesh.ElementOrder = 1");
}

/// Index of a node among ascending tags; -1 where there is none.
int index_of(const Tags& nodes, std::size_t tag) {
  const auto found = std::ranges::lower_bound(nodes, tag);
  return found != nodes.end() && *found == tag ? static_cast<int>(found - nodes.begin()) : -1;
}

std::vector<int> ascending(const Tags& tags) {
  std::vector<int> order(tags.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&tags](int a, int b) { return tags[a] < tags[b]; });
  return order;
}

/// Returns the tags of the nodes.
Tags copy_nodes(ImportedMesh& mesh) {
  Tags tags;
  std::vector<double> places, ignored;
  gmsh::model::mesh::getNodes(tags, places, ignored, -1, -1, false, false);
  if (tags.empty()) throw Refusal("has no nodes");
  if (tags.size() > std::numeric_limits<int>::max() / 8) throw Refusal("has too many nodes");
  Tags sorted;
  for (int i : ascending(tags)) {
    if (!sorted.empty() && sorted.back() == tags[i]) continue;
    sorted.push_back(tags[i]);
    mesh.node_tags.push_back(static_cast<std::int64_t>(tags[i]));
    mesh.nodes.push_back({places[3 * i], places[3 * i + 1], places[3 * i + 2]});
  }
  return sorted;
}

/// Elements of one geometrical entity after the other, with where each begins.
struct EntityElements {
  ElementList list;
  std::map<int, std::array<int, 2>> ranges;  // of each entity
};

EntityElements copy_elements(const std::vector<int>& entities, int dimension,
                             const Tags& mesh_nodes) {
  EntityElements result;
  for (int entity : entities) {
    const int first = result.list.size();
    std::vector<int> types;
    std::vector<Tags> tags, nodes;
    gmsh::model::mesh::getElements(types, tags, nodes, dimension, entity);
    for (std::size_t t = 0; t < types.size(); ++t) {
      const ElementKind kind = kind_of(types[t]);
      const auto count = static_cast<std::size_t>(node_count(kind));
      std::array<int, 8> own{};
      for (std::size_t e = 0; e < tags[t].size(); ++e) {
        for (std::size_t a = 0; a < count; ++a) {
          own[a] = index_of(mesh_nodes, nodes[t][count * e + a]);
          if (own[a] < 0)
            throw Refusal("element " + std::to_string(tags[t][e]) + " has node " +
                          std::to_string(nodes[t][count * e + a]) + ", which is not in the file");
        }
        result.list.add(kind, static_cast<std::int64_t>(tags[t][e]), {own.data(), count});
      }
    }
    result.ranges[entity] = {first, result.list.size()};
  }
  return result;
}

std::vector<int> entities_of_group(int dimension, int group) {
  std::vector<int> entities;
  gmsh::model::getEntitiesForPhysicalGroup(dimension, group, entities);
  return entities;
}

gmsh::vectorpair groups_of(int dimension) {
  gmsh::vectorpair groups;
  gmsh::model::getPhysicalGroups(groups, dimension);
  return groups;
}

std::vector<int> entities_to_copy(int dimension, bool only_in_groups) {
  const gmsh::vectorpair groups = groups_of(dimension);
  if (!only_in_groups || groups.empty()) return entities_of(dimension);
  std::set<int> used;
  for (const auto& group : groups)
    for (int entity : entities_of_group(dimension, group.second)) used.insert(entity);
  return {used.begin(), used.end()};
}

std::vector<int> members(const std::vector<int>& entities, const EntityElements& elements) {
  std::vector<int> result;
  for (int entity : entities) {
    const auto range = elements.ranges.find(entity);
    if (range == elements.ranges.end()) continue;
    for (int e = range->second[0]; e < range->second[1]; ++e) result.push_back(e);
  }
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<int> nodes_of_group(int dimension, int group, const Tags& mesh_nodes) {
  Tags tags;
  std::vector<double> ignored;
  gmsh::model::mesh::getNodesForPhysicalGroup(dimension, group, tags, ignored);
  std::vector<int> result;
  for (std::size_t tag : tags)
    if (const int node = index_of(mesh_nodes, tag); node >= 0) result.push_back(node);
  std::sort(result.begin(), result.end());
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

void copy_groups(ImportedMesh& mesh, const EntityElements& cells, const EntityElements& facets,
                 const Tags& mesh_nodes) {
  for (const auto& [dimension, tag] : groups_of(-1)) {
    std::string name;
    gmsh::model::getPhysicalName(dimension, tag, name);
    MeshGroup group{name.empty() ? std::to_string(tag) : name, dimension, {}};
    if (dimension == mesh.dimension)
      group.members = members(entities_of_group(dimension, tag), cells);
    else if (dimension == mesh.dimension - 1)
      group.members = members(entities_of_group(dimension, tag), facets);
    else if (dimension < mesh.dimension)
      group.members = nodes_of_group(dimension, tag, mesh_nodes);
    mesh.groups.push_back(group);
  }
}

/// Names for groups without elements: Gmsh keeps them, but lists only groups that have some.
void add_empty_groups(ImportedMesh& mesh) {
  constexpr int most = 10'000;  // numbers of groups; Gmsh counts them from 1
  std::set<std::string> known;
  for (const MeshGroup& group : mesh.groups) known.insert(group.name);
  for (int dimension = 0; dimension <= 3; ++dimension)
    for (int tag = 1; tag <= most; ++tag) {
      std::string name;
      gmsh::model::getPhysicalName(dimension, tag, name);
      if (!name.empty() && known.insert(name).second) mesh.groups.push_back({name, dimension, {}});
    }
}

/// Without physical groups of the boundary, its geometrical entities are the groups.
void name_entities(ImportedMesh& mesh, const EntityElements& facets) {
  const std::string what = mesh.dimension == 2 ? "curve" : "surface";
  int count = 0;
  for (const auto& [entity, range] : facets.ranges)
    if (range[0] < range[1]) {
      mesh.groups.push_back(
          {what + std::to_string(entity), mesh.dimension - 1, members({entity}, facets)});
      ++count;
    }
  if (count > 0)
    mesh.remarks.push_back("has no physical groups of " + what + "s, so they are named by their " +
                           "numbers in Gmsh: " + what + "1; to name them in Gmsh: Physical " +
                           (mesh.dimension == 2 ? "Curve" : "Surface") + "(\"name\") = {1};");
}

/// Sorted by tag, so that the same mesh comes out whatever format it went through.
void sort_by_tag(EntityElements& elements, std::vector<MeshGroup>& groups, int dimension) {
  const ElementList& old = elements.list;
  Tags tags(old.tags.begin(), old.tags.end());
  if (std::is_sorted(tags.begin(), tags.end())) return;
  const std::vector<int> order = ascending(tags);
  std::vector<int> place(order.size());
  ElementList sorted;
  for (std::size_t k = 0; k < order.size(); ++k) {
    place[order[k]] = static_cast<int>(k);
    sorted.add(old.kinds[order[k]], old.tags[order[k]], old.at(order[k]));
  }
  elements.list = std::move(sorted);
  for (MeshGroup& group : groups) {
    if (group.dimension != dimension) continue;
    for (int& member : group.members) member = place[member];
    std::sort(group.members.begin(), group.members.end());
  }
}

int highest_dimension() {
  for (int dimension = 3; dimension >= 0; --dimension)
    if (!element_types(dimension).empty()) return dimension;
  throw Refusal("has no elements");
}

}  // namespace

std::vector<int> entities_of(int dimension) {
  gmsh::vectorpair pairs;
  gmsh::model::getEntities(pairs, dimension);
  std::vector<int> tags;
  for (const auto& pair : pairs) tags.push_back(pair.second);
  return tags;
}

std::vector<int> element_types(int dimension) {
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, dimension);
  return types;
}

void copy_model(ImportedMesh& mesh, bool geometry) {
  mesh.dimension = highest_dimension();
  const Tags nodes = copy_nodes(mesh);
  EntityElements cells =
      copy_elements(entities_to_copy(mesh.dimension, geometry), mesh.dimension, nodes);
  EntityElements facets;
  if (mesh.dimension > 0)
    facets = copy_elements(entities_to_copy(mesh.dimension - 1, false), mesh.dimension - 1, nodes);
  copy_groups(mesh, cells, facets, nodes);
  add_empty_groups(mesh);
  if (mesh.dimension > 1 && groups_of(mesh.dimension - 1).empty()) name_entities(mesh, facets);
  sort_by_tag(cells, mesh.groups, mesh.dimension);
  sort_by_tag(facets, mesh.groups, mesh.dimension - 1);
  mesh.cells = std::move(cells.list);
  mesh.facets = std::move(facets.list);
}

}  // namespace gnomon::gmsh_reader
