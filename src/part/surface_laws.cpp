#include "part/surface_laws.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/part/assembly_scene.hpp>
#include <gnomon/scene/toml_key.hpp>
#include <map>

#include "part/groups.hpp"
#include "part/histories.hpp"

namespace gnomon::part {

namespace {

std::string rate_key(const std::string& surface) {
  return "wear.surfaces." + toml_key(surface) + ".rate";
}

/// What `read` makes of the scene whose wear.rate is that of a surface. Complaints name the
/// surface's key.
template <class Read>
auto with_rate_of(const Scene& scene, const std::string& surface, const Read& read) {
  const std::string key = rate_key(surface), common = scene.where("wear.rate");
  try {
    return read(scene.with("wear.rate", scene.text(key)));
  } catch (const InputError& error) {
    const std::string what = error.what();
    if (!what.starts_with(common)) throw;
    throw InputError(scene.where(key) + what.substr(common.size()));
  }
}

}  // namespace

template <int dim>
std::vector<Surface<dim>> wearing_surfaces(const Scene& scene, const ImportedBody<dim>& part) {
  std::vector<Surface<dim>> surfaces;
  std::map<typename Mesh<dim>::Facet, std::string> surface_of;  // by sorted nodes
  for (const std::string& name : scene.texts("wear.on")) {
    Surface<dim>& surface = surfaces.emplace_back();
    surface.name = name;
    for (const auto& facet : group_facets(scene, "wear.on", name, part)) {
      auto sorted = facet;
      std::sort(sorted.begin(), sorted.end());
      const auto [first, is_new] = surface_of.try_emplace(sorted, name);
      if (is_new)
        surface.facets.push_back(facet);
      else if (first->second != name)  // a name given twice is reported by find_conflicts()
        throw InputError(
            fmt::format("{}: expected groups that share no facet, but \"{}\" and \"{}\" do",
                        scene.where("wear.on"), first->second, name));
    }
  }
  if (surface_of.empty())
    throw InputError(scene.where("wear.on") + ": expected one group of the mesh or more");
  return surfaces;
}

WearLaw read_surface_law(const Scene& scene, const std::string& surface, double speed) {
  if (!given(scene, rate_key(surface))) return read_wear_law(scene, speed);
  return with_rate_of(scene, surface,
                      [speed](const Scene& own) { return read_wear_law(own, speed); });
}

void require_surface_names(const Scene& scene) {
  const std::vector<std::string>& surfaces = scene.texts("wear.on");
  for (const std::string& name : scene.chosen_names("wear.surfaces.\"*\".rate"))
    if (std::ranges::find(surfaces, name, toml_key) == surfaces.end())
      throw InputError(fmt::format("{}: expected one of wear.on, \"{}\", in the place of {}",
                                   scene.where("wear.surfaces." + name + ".rate"),
                                   fmt::join(surfaces, "\", \""), name));
}

template <int dim>
void complete_surface_laws(const Scene& scene, AssemblyParts<dim>& parts) {
  const WearCircumstances at = wear_circumstances(parts);
  std::vector<std::string> common;  // remarks on wear.rate, once
  for (Surface<dim>& surface : parts.interface.surfaces) {
    if (!surface.wears) continue;
    std::vector<std::string> remarks;
    const auto complete = [&](const Scene& own) {
      return required_law(own, surface.wear, at, remarks);
    };
    if (!given(scene, rate_key(surface.name))) {
      surface.wear = complete(scene);
      common = std::move(remarks);
      continue;
    }
    surface.wear = with_rate_of(scene, surface.name, complete);
    for (const std::string& remark : remarks)
      parts.remarks.push_back(fmt::format("\"{}\": {}", surface.name, remark));
  }
  parts.remarks.insert(parts.remarks.end(), common.begin(), common.end());
}

template std::vector<Surface<2>> wearing_surfaces(const Scene&, const ImportedBody<2>&);
template std::vector<Surface<3>> wearing_surfaces(const Scene&, const ImportedBody<3>&);
template void complete_surface_laws(const Scene&, AssemblyParts<2>&);
template void complete_surface_laws(const Scene&, AssemblyParts<3>&);

}  // namespace gnomon::part
