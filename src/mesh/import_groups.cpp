#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/scene/scene.hpp>
#include <iterator>

#include "mesh/import_cells.hpp"
#include "mesh/import_nodes.hpp"
#include "scene/toml_text.hpp"

namespace gnomon {

namespace {

template <int dim>
constexpr const char* part_kind = dim == 2 ? "curve" : "surface";
template <int dim>
constexpr const char* physical_part = dim == 2 ? "Physical Curve" : "Physical Surface";

/// Slots on the boundary of the facets of a group, and what is wrong with the others.
struct Found {
  std::vector<int> slots;
  long missing = 0, inside = 0;
  int first_missing = -1, first_inside = -1;  // facets
};

template <int dim>
Found find_facets(const MeshGroup& group, const FacetTable<dim>& facets, const ElementList& list) {
  Found found;
  for (int member : group.members) {
    const int slot = facets.find(list.at(member));
    if (slot < 0) {
      if (found.missing++ == 0) found.first_missing = member;
    } else if (facets.neighbour(slot) != facets.exterior) {
      if (found.inside++ == 0) found.first_inside = member;
    } else {
      found.slots.push_back(slot);
    }
  }
  return found;
}

/// Why the group is no part of the boundary; empty where it is one.
std::string fault_of(const Found& found, const MeshGroup& group, const ElementList& list) {
  const auto text = [&](long count, const char* what, int first) {
    return fmt::format(
        "is no part of the boundary: {} of its {} facets {}, the first has the number {}", count,
        group.members.size(), what, list.tags[first]);
  };
  if (found.missing > 0) return text(found.missing, "are no sides of cells", found.first_missing);
  if (found.inside > 0)
    return text(found.inside,
                "lie inside the body, or its nodes coincide with those of another side",
                found.first_inside);
  return {};
}

std::string wrong_dimension(const MeshGroup& group, int dim) {
  static constexpr const char* kinds[] = {"points", "curves", "surfaces", "volumes"};
  return fmt::format("is a group of {}, expected one of {}",
                     kinds[std::clamp(group.dimension, 0, 3)], dim == 2 ? "curves" : "surfaces");
}

constexpr const char* without_elements = "has no elements";

/// Slots of each part by its name.
using Parts = std::map<std::string, std::vector<int>>;

template <int dim>
void take_boundary_part(ImportedBody<dim>& body, const FacetTable<dim>& facets,
                        const MeshGroup& group, const ElementList& list, Parts& parts) {
  const Found found = find_facets(group, facets, list);
  if (const std::string fault = fault_of(found, group, list); !fault.empty()) {
    body.unusable.emplace(group.name, fault);
    return;
  }
  std::vector<int>& slots = parts[group.name];
  if (!slots.empty())
    body.remarks.push_back(fmt::format("several groups of {}s are called {}; they were joined",
                                       part_kind<dim>, toml_text(group.name)));
  slots.insert(slots.end(), found.slots.begin(), found.slots.end());
  sort_once(slots);
}

/// Parts may overlap; the user is informed, since it is often a mistake.
template <int dim>
void remark_overlaps(ImportedBody<dim>& body, const Parts& parts) {
  for (auto one = parts.begin(); one != parts.end(); ++one)
    for (auto other = std::next(one); other != parts.end(); ++other) {
      std::vector<int> common;
      std::set_intersection(one->second.begin(), one->second.end(), other->second.begin(),
                            other->second.end(), std::back_inserter(common));
      if (!common.empty())
        body.remarks.push_back(fmt::format("{} and {} have {} in common", toml_text(one->first),
                                           toml_text(other->first),
                                           counted(std::ssize(common), "facet")));
    }
}

std::vector<std::string> names_of(const auto& named) {
  std::vector<std::string> names;
  for (const auto& [name, ignored] : named) names.push_back(name);
  return names;
}

/// A name that is none of `names`.
template <int dim>
[[noreturn]] void refuse_name(const ImportedBody<dim>& body, const std::string& name,
                              const std::vector<std::string>& names) {
  const std::string wanted =
      fmt::format("{}: has no {} called {}", body.file, part_kind<dim>, toml_text(name));
  if (names.empty())
    throw InputError(fmt::format("{}, nor any other; in Gmsh: {}({}) = {{1}};", wanted,
                                 physical_part<dim>, toml_text(name)));
  std::string all;
  for (const std::string& one : names) all += (all.empty() ? "" : ", ") + toml_text(one);
  if (const std::string near = nearest_name(name, names); !near.empty())
    throw InputError(fmt::format("{}, did you mean {}? It has {}", wanted, toml_text(near), all));
  throw InputError(fmt::format("{}, it has {}", wanted, all));
}

}  // namespace

template <int dim>
void take_groups(ImportedBody<dim>& body, const FacetTable<dim>& facets, const ImportedMesh& mesh) {
  Parts parts;
  for (const MeshGroup& group : mesh.groups) {
    if (group.members.empty()) {
      body.unusable.emplace(group.name, without_elements);
      body.remarks.push_back(fmt::format("{} {}", toml_text(group.name), without_elements));
      continue;
    }
    if (group.dimension == dim - 1) {
      take_boundary_part(body, facets, group, mesh.facets, parts);
      continue;
    }
    body.unusable.emplace(group.name, wrong_dimension(group, dim));
    auto& groups = group.dimension == dim ? body.cell_groups : body.point_groups;
    if (group.dimension != dim && group.dimension != 0) continue;
    std::vector<int>& members = groups[group.name];
    members.insert(members.end(), group.members.begin(), group.members.end());
    sort_once(members);
  }
  for (const auto& [name, slots] : parts) {
    auto& part = body.mesh.boundary[name];
    for (int slot : slots) part.push_back(facets.facet(slot));
    body.unusable.erase(name);  // for example of points, with the same name
  }
  remark_overlaps(body, parts);
}

template <int dim>
const std::vector<typename Mesh<dim>::Facet>& boundary_part(const ImportedBody<dim>& body,
                                                            const std::string& name) {
  const auto& parts = body.mesh.boundary;
  if (const auto found = parts.find(name); found != parts.end()) return found->second;
  if (const auto found = body.unusable.find(name); found != body.unusable.end())
    refuse_mesh(body.file, toml_text(name) + " " + found->second);
  refuse_name(body, name, names_of(parts));
}

template <int dim>
std::vector<int> group_nodes(const ImportedBody<dim>& body, const std::string& name) {
  const auto& points = body.point_groups;
  if (const auto found = points.find(name); found != points.end()) return found->second;
  if (body.mesh.boundary.contains(name) || body.unusable.contains(name)) {
    boundary_part(body, name);  // for what makes it unusable
    return body.mesh.boundary_nodes(name);
  }
  std::vector<std::string> names = names_of(body.mesh.boundary);
  for (std::string& point : names_of(points)) names.push_back(std::move(point));
  refuse_name(body, name, names);
}

template void take_groups(ImportedBody<2>&, const FacetTable<2>&, const ImportedMesh&);
template void take_groups(ImportedBody<3>&, const FacetTable<3>&, const ImportedMesh&);
template std::vector<int> group_nodes(const ImportedBody<2>&, const std::string&);
template std::vector<int> group_nodes(const ImportedBody<3>&, const std::string&);
template const std::vector<Mesh<2>::Facet>& boundary_part(const ImportedBody<2>&,
                                                          const std::string&);
template const std::vector<Mesh<3>::Facet>& boundary_part(const ImportedBody<3>&,
                                                          const std::string&);

}  // namespace gnomon
