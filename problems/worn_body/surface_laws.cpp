#include "surface_laws.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/model/worn_body_scene.hpp>
#include <gnomon/scene/toml_key.hpp>

#include "histories.hpp"

namespace gnomon::part {

namespace {

std::string rate_key(const std::string& surface) {
  return "wear.surfaces." + toml_key(surface) + ".rate";
}

/// Those of wear.on that have a law of their own, in this order.
std::vector<std::string> surfaces_with_laws(const Scene& scene) {
  std::vector<std::string> surfaces;
  for (const std::string& surface : scene.texts("wear.on"))
    if (given(scene, rate_key(surface))) surfaces.push_back(surface);
  return surfaces;
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
void read_wear_laws(const Scene& scene, const ImportedBody<dim>& part, WornBody<dim>& body) {
  body.contact.wear = read_wear_law(scene);
  const std::vector<std::string>& surfaces = scene.texts("wear.on");
  for (const std::string& name : scene.chosen_names("wear.surfaces.\"*\".rate"))
    if (std::ranges::find(surfaces, name, toml_key) == surfaces.end())
      throw InputError(fmt::format("{}: expected one of wear.on, \"{}\", in the place of {}",
                                   scene.where("wear.surfaces." + name + ".rate"),
                                   fmt::join(surfaces, "\", \""), name));
  std::vector<int> law_of_node(part.mesh.nodes.size(), -1);
  for (const std::string& surface : surfaces) {
    int law = 0;
    if (given(scene, rate_key(surface))) {
      body.further_wear.push_back(with_rate_of(scene, surface, read_wear_law));
      law = static_cast<int>(body.further_wear.size());
    }
    for (int node : part.mesh.boundary_nodes(surface))
      if (law_of_node[node] < 0) law_of_node[node] = law;
  }
  if (body.further_wear.empty()) return;
  for (const auto& patch : body.contact_nodes) body.wear_surface.push_back(law_of_node[patch.node]);
}

template <int dim>
void require_surface_laws(const Scene& scene, const WornBody<dim>& body) {
  const WearCircumstances at = wear_circumstances(body);
  std::size_t law = 0;
  for (const std::string& surface : surfaces_with_laws(scene)) {
    const WearLaw& own = body.further_wear[law++];
    with_rate_of(scene, surface, [&](const Scene& changed) { require_law(changed, own, at); });
  }
}

template void read_wear_laws(const Scene&, const ImportedBody<2>&, WornBody<2>&);
template void read_wear_laws(const Scene&, const ImportedBody<3>&, WornBody<3>&);
template void require_surface_laws(const Scene&, const WornBody<2>&);
template void require_surface_laws(const Scene&, const WornBody<3>&);

}  // namespace gnomon::part
