#include "part/groups.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/model/wear_scene.hpp>
#include <gnomon/scene/toml_key.hpp>
#include <map>
#include <set>

#include "model/connected_parts.hpp"
#include "part/histories.hpp"
#include "part/supports.hpp"

namespace gnomon::part {

template <int dim>
const Facets<dim>& group_facets(const Scene& scene, const std::string& key, const std::string& name,
                                const ImportedBody<dim>& part) try {
  return boundary_part(part, name);
} catch (const InputError& error) {
  throw InputError(scene.where(key) + ": " + error.what());
}

template <int dim>
std::vector<int> group_nodes(const Scene& scene, const std::string& key, const std::string& name,
                             const ImportedBody<dim>& part) try {
  return gnomon::group_nodes(part, name);
} catch (const InputError& error) {
  throw InputError(scene.where(key) + ": " + error.what());
}

template <int dim>
void find_unknown_groups(const Scene& scene, const ImportedBody<dim>& part, Mistakes& mistakes) {
  for (const char* table : {"support", "load"})
    for (const std::string& number : scene.chosen_names(std::string(table) + ".#.on")) {
      const std::string key = std::string(table) + "." + number + ".on";
      if (scene.given(key))
        mistakes.collect([&] { group_nodes(scene, key, scene.text(key), part); });
    }
  for (const char* key : {"wear.on", "shape.hold", "shape.slide"}) {
    if (!scene.given(key)) continue;
    for (const std::string& name : scene.texts(key))
      mistakes.collect([&] { group_facets(scene, key, name, part); });
  }
}

template const Facets<2>& group_facets(const Scene&, const std::string&, const std::string&,
                                       const ImportedBody<2>&);
template const Facets<3>& group_facets(const Scene&, const std::string&, const std::string&,
                                       const ImportedBody<3>&);
template std::vector<int> group_nodes(const Scene&, const std::string&, const std::string&,
                                      const ImportedBody<2>&);
template std::vector<int> group_nodes(const Scene&, const std::string&, const std::string&,
                                      const ImportedBody<3>&);
template void find_unknown_groups(const Scene&, const ImportedBody<2>&, Mistakes&);
template void find_unknown_groups(const Scene&, const ImportedBody<3>&, Mistakes&);

namespace {

/// The groups of a list; none where the scene has no value for it.
std::vector<std::string> groups_of(const Scene& scene, const std::string& key) {
  return scene.given(key) ? scene.texts(key) : std::vector<std::string>();
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::ranges::find(names, name) != names.end();
}

}  // namespace

void find_conflicts(const Scene& scene, Mistakes& mistakes) {
  for (const char* key : {"wear.on", "shape.hold", "shape.slide"}) {
    std::set<std::string> known;
    for (const std::string& name : groups_of(scene, key))
      if (!known.insert(name).second)
        mistakes.add(
            fmt::format("{}: expected each group once, got \"{}\" twice", scene.where(key), name));
  }
  const std::vector<std::string> wearing = groups_of(scene, "wear.on"),
                                 held = groups_of(scene, "shape.hold");
  for (const char* key : {"shape.hold", "shape.slide"})
    for (const std::string& name : groups_of(scene, key))
      if (contains(wearing, name))
        mistakes.add(fmt::format("{}: expected groups that do not wear, but \"{}\" is in wear.on",
                                 scene.where(key), name));
  for (const std::string& name : groups_of(scene, "shape.slide"))
    if (contains(held, name))
      mistakes.add(fmt::format("{}: expected groups that are not held, but \"{}\" is in shape.hold",
                               scene.where("shape.slide"), name));
  const auto has_own = [&](const std::string& name) {
    return scene.given("wear.surfaces." + toml_key(name) + ".coefficient");
  };
  if (scene.given("wear.coefficient") && !wearing.empty() && std::ranges::all_of(wearing, has_own))
    mistakes.add(scene.where("wear.coefficient") +
                 ": expected none, for each surface of wear.on has its own");
}

std::vector<std::string> remarks_on_loads(const Scene& scene) {
  std::vector<std::string> remarks;
  std::map<std::string, std::vector<std::string>> loads;  // by group
  for (const std::string& number : scene.chosen_names("load.#.on"))
    loads[scene.text("load." + number + ".on")].push_back(number);
  if (loads.empty() && scene.has("cycle.load"))
    remarks.push_back("cycle.load has no effect: there is no [[load]]");
  for (const auto& [group, numbers] : loads)
    if (numbers.size() > 1)
      remarks.push_back(fmt::format("\"{}\" has several loads, [[load]] number {}: they add up",
                                    group, fmt::join(numbers, ", ")));
  for (const auto& [group, numbers] : loads)
    if (contains(scene.texts("wear.on"), group))
      remarks.push_back(
          fmt::format("[[load]] number {} acts on \"{}\", which wears: it is there beside the "
                      "pressure of contact",
                      fmt::join(numbers, ", "), group));
  return remarks;
}

template <int dim>
std::vector<std::string> remarks_on_pivots(const Scene& scene, const ImportedBody<dim>& part) {
  std::vector<std::string> remarks;
  const std::vector<int> connected = connected_parts(part.mesh);
  for (const std::string& number : scene.chosen_names("support.#.on")) {
    const std::string name = scene.text("support." + number + ".on");
    const auto group = part.point_groups.find(name);
    if (group == part.point_groups.end()) continue;
    std::map<int, int> points;  // by connected part
    for (const int node : group->second) ++points[connected[static_cast<std::size_t>(node)]];
    for (const auto& [own, count] : points)
      if (count > 1)
        remarks.push_back(fmt::format(
            "[[support]] number {} holds each of the {} points of \"{}\": together they "
            "may resist rotation, where a pivot is one point",
            number, count, name));
  }
  return remarks;
}

template std::vector<std::string> remarks_on_pivots(const Scene&, const ImportedBody<2>&);
template std::vector<std::string> remarks_on_pivots(const Scene&, const ImportedBody<3>&);

template <int dim>
void require_free_contact(const Scene& scene, const ImportedBody<dim>& part) {
  for (const std::string& number : scene.chosen_names("support.#.on")) {
    const std::string support = "support." + number, group = scene.text(support + ".on");
    if (!contains(scene.texts("wear.on"), group) || scene.given(support + ".stiffness")) continue;
    double along = 0, area = 0;
    for (const auto& patch :
         contact_patches<dim>(part.mesh, part.mesh.boundary.at(group), {}, section_of(scene))) {
      area += patch.initial_area;
      for (int i : directions_of<dim>(scene, support))
        along += patch.initial_area * patch.initial_normal[i] * patch.initial_normal[i];
    }
    if (along > area / 2)
      throw InputError(fmt::format(
          "{}: expected a surface that does not wear, or directions along it: held across itself, "
          "\"{}\" would have no contact pressure",
          scene.where(support + ".on"), group));
  }
}

template <int dim>
void require_moving_shape(const Scene& scene, const std::vector<ContactPatch<dim>>& patches,
                          const ShapeMotion<dim>& shape) {
  const auto may_move = [&](const ContactPatch<dim>& patch) {
    return !shape.free(patch.node).isZero(0);
  };
  if (!asks_for_wear(scene) || std::ranges::any_of(patches, may_move)) return;
  refuse(scene, "wear.on",
         "surfaces that can wear, but all their nodes lie on sides that hold the shape: "
         "shape.hold, or curved sides");
}

template void require_moving_shape(const Scene&, const std::vector<ContactPatch<2>>&,
                                   const ShapeMotion<2>&);
template void require_moving_shape(const Scene&, const std::vector<ContactPatch<3>>&,
                                   const ShapeMotion<3>&);
template void require_free_contact(const Scene&, const ImportedBody<2>&);
template void require_free_contact(const Scene&, const ImportedBody<3>&);

}  // namespace gnomon::part
