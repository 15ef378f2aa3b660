#include "part/bodies.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/part/assembly_scene.hpp>

#include "mesh/facet_table.hpp"
#include "part/histories.hpp"

namespace gnomon::part {

namespace {

const std::vector<std::string>& needed_keys() {
  static const std::vector<std::string> keys = {"name", "young_modulus", "poisson_ratio"};
  return keys;
}

template <int dim>
std::vector<std::string> group_names(const ImportedBody<dim>& part) {
  std::vector<std::string> names;
  for (const auto& [name, cells] : part.cell_groups) names.push_back(name);
  return names;
}

template <int dim>
const std::vector<int>& cells_of(const Scene& scene, const std::string& table,
                                 const ImportedBody<dim>& part) {
  const std::string key = table + ".name";
  if (const auto group = part.cell_groups.find(scene.text(key)); group != part.cell_groups.end())
    return group->second;
  const std::vector<std::string> names = group_names(part);
  const std::string wanted = fmt::format("{}: {} has no group of elements called \"{}\"",
                                         scene.where(key), part.file, scene.text(key));
  if (names.empty())
    throw InputError(fmt::format("{}, nor any other; in Gmsh: Physical {}(\"{}\") = {{1}};", wanted,
                                 dim == 2 ? "Surface" : "Volume", scene.text(key)));
  const std::string near = nearest_name(scene.text(key), names);
  throw InputError(near.empty()
                       ? fmt::format("{}, it has \"{}\"", wanted, fmt::join(names, "\", \""))
                       : fmt::format("{}, did you mean \"{}\"?", wanted, near));
}

}  // namespace

std::vector<Key> body_table_keys() {
  std::vector<Key> keys = {text_key("body.#.name", absent("needed in every [[body]]"),
                                    "group of elements that is this body; bodies that share nodes "
                                    "are bonded"),
                           density_key("body.#.density")};
  for (Key key : worn_body_keys(2)) {
    if (!key.name.starts_with("body.")) continue;
    key.absent_meaning = key.default_value ? "\"" + std::get<std::string>(*key.default_value) + "\""
                                           : "needed in every [[body]]";
    key.default_value.reset();
    key.name.insert(5, "#.");
    key.controls.reset();  // the bodies have one choice together (part_keys.cpp)
    keys.push_back(std::move(key));
  }
  return keys;
}

bool has_bodies(const Scene& scene) {
  return !scene.chosen_names("body.#.name").empty() ||
         !scene.chosen_names("body.#.young_modulus").empty();
}

template <int dim>
std::vector<Body> read_bodies(const Scene& scene, const ImportedBody<dim>& part, Section section) {
  if (!has_bodies(scene)) return {read_body(scene, section)};
  std::vector<Body> bodies;
  for (const std::string& table : entries_of(scene, "body", body_table_keys(), needed_keys())) {
    bodies.push_back(read_body(scene, section, table));
    bodies.back().name = scene.text(table + ".name");
    bodies.back().cells = cells_of(scene, table, part);
  }
  try {
    body_of_cells(bodies, part.mesh.cells.size());
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: [[body]]: {}; groups of elements: \"{}\"",
                                 scene.path().string(), error.what(),
                                 fmt::join(group_names(part), "\", \"")));
  }
  return bodies;
}

template <int dim>
std::vector<std::string> remarks_on_bodies(const Scene& scene, const ImportedBody<dim>& part) {
  if (has_bodies(scene) || part.cell_groups.size() < 2) return {};
  return {
      fmt::format("the groups of elements \"{}\" are one body of one material; [[body]] gives "
                  "each its own",
                  fmt::join(group_names(part), "\", \""))};
}

template <int dim>
Facets<dim> bonded_facets(const Mesh<dim>& mesh, const std::vector<Body>& bodies) {
  Facets<dim> result;
  if (bodies.size() < 2) return result;
  const std::vector<int> body_of = body_of_cells(bodies, mesh.cells.size());
  const FacetTable<dim> facets(mesh);
  for (int slot = 0; slot < facets.slots(); ++slot) {
    const int other = facets.neighbour(slot);
    const auto body_at = [&](int at) {
      return body_of[static_cast<std::size_t>(at / facets.facets_per_cell)];
    };
    if (other >= 0 && body_at(slot) < body_at(other)) result.push_back(facets.facet(slot));
  }
  return result;
}

bool has_small_strains(const std::vector<Body>& bodies) {
  return std::ranges::all_of(
      bodies, [](const Body& body) { return body.element.kinematics == Kinematics::small; });
}

template std::vector<Body> read_bodies(const Scene&, const ImportedBody<2>&, Section);
template std::vector<Body> read_bodies(const Scene&, const ImportedBody<3>&, Section);
template std::vector<std::string> remarks_on_bodies(const Scene&, const ImportedBody<2>&);
template std::vector<std::string> remarks_on_bodies(const Scene&, const ImportedBody<3>&);
template Facets<2> bonded_facets(const Mesh<2>&, const std::vector<Body>&);
template Facets<3> bonded_facets(const Mesh<3>&, const std::vector<Body>&);

}  // namespace gnomon::part
