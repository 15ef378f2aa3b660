#include "part/surfaces.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/model/joining_boundary.hpp>
#include <gnomon/model/physics.hpp>
#include <gnomon/part/assembly_scene.hpp>
#include <gnomon/scene/toml_key.hpp>
#include <limits>
#include <map>

#include "expressions/expression_text.hpp"
#include "mesh/facet_table.hpp"
#include "part/changing_friction.hpp"
#include "part/groups.hpp"
#include "part/histories.hpp"

namespace gnomon::part {

namespace {

/// That of the surface, if it has one.
std::string rate_key(const Scene& scene, const std::string& surface) {
  const std::string own = "wear.surfaces." + toml_key(surface) + ".rate";
  return scene.given(own) ? own : "wear.rate";
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
      const auto [first, is_new] = surface_of.try_emplace(sorted(facet), name);
      if (is_new)
        surface.facets.push_back(facet);
      else if (first->second != name)  // a name given twice is reported by find_conflicts()
        throw InputError(
            fmt::format("{}: expected groups that share no facet, but \"{}\" and \"{}\" do",
                        scene.where("wear.on"), first->second, name));
    }
  }
  if (surface_of.empty()) refuse(scene, "wear.on", "one group of the mesh or more");
  return surfaces;
}

namespace {

/// With the coefficient of the surface, if it has one.
Scene scene_of(const Scene& scene, const std::string& surface) {
  const std::string own = "wear.surfaces." + toml_key(surface) + ".coefficient";
  return scene.given(own) ? scene.with("wear.coefficient", scene.real(own)) : scene;
}

}  // namespace

WearLaw read_surface_law(const Scene& scene, const std::string& surface, double speed) {
  return read_wear_law(scene_of(scene, surface), speed, rate_key(scene, surface));
}

template <int dim>
void require_positions(const Scene& scene, const std::string& key) {
  if (dim == 3 || !tokens_in(scene.text(key)).contains("z0")) return;
  const bool of_revolution = scene.text("model.plane") == "axisymmetric";
  refuse(scene, key,
         of_revolution ? "x0 for the radius and y0 for the place along the axis, got z0"
                       : "x0 and y0, got z0, which a plane does not have");
}

template void require_positions<2>(const Scene&, const std::string&);
template void require_positions<3>(const Scene&, const std::string&);

namespace {

/// Where an expression reads s and the motion gives its speed.
template <int dim>
std::string remark_on_distance(const Scene& scene, const AssemblyParts<dim>& parts) {
  const bool reads = (scene.text("wear.law") == "expression" && reads_in_rates(scene, "s")) ||
                     reads_in_friction(scene, "s");
  if (!reads || scene.given("wear.velocity")) return {};
  std::vector<std::string> speeds;
  for (const Surface<dim>& surface : parts.interface.surfaces)
    if (surface.wears)
      speeds.push_back(
          fmt::format("{:.4g} mm/s on \"{}\"", parts.nominal_speed(surface), surface.name));
  if (speeds.empty()) return {};
  return fmt::format(
      "the sliding distance s is counted with {} (wear.velocity gives another speed)",
      fmt::join(speeds, ", "));
}

}  // namespace

template <int dim>
WearCircumstances circumstances_of(const AssemblyParts<dim>& parts, const Surface<dim>& surface) {
  WearCircumstances at = wear_circumstances(parts);
  at.speed = parts.nominal_speed(surface);
  at.initial.clear();
  for (const int node : nodes_of_facets(surface.facets))
    at.initial.push_back(point_in_space<dim>(parts.mesh.nodes[static_cast<std::size_t>(node)]));
  return at;
}

template <int dim>
void complete_surface_laws(const Scene& scene, AssemblyParts<dim>& parts) {
  std::vector<std::string> common;  // remarks on wear.rate, once
  if (std::string remark = remark_on_distance(scene, parts); !remark.empty())
    parts.remarks.push_back(std::move(remark));
  for (Surface<dim>& surface : parts.interface.surfaces) {
    if (!surface.wears) continue;
    const WearCircumstances at = circumstances_of(parts, surface);
    std::vector<std::string> remarks;
    const std::string key = rate_key(scene, surface.name);
    if (scene.text("wear.law") == "expression") require_positions<dim>(scene, key);
    // That it does not wear is no doubt where its coefficient is zero.
    surface.wear = required_law(scene_of(scene, surface.name), surface.wear, at, remarks, key);
    if (key == "wear.rate" && !remarks.empty())
      common = std::move(remarks);
    else
      for (const std::string& remark : remarks)
        parts.remarks.push_back(fmt::format("\"{}\": {}", surface.name, remark));
  }
  parts.remarks.insert(parts.remarks.end(), common.begin(), common.end());
}

template std::vector<Surface<2>> wearing_surfaces(const Scene&, const ImportedBody<2>&);
template std::vector<Surface<3>> wearing_surfaces(const Scene&, const ImportedBody<3>&);
template WearCircumstances circumstances_of(const AssemblyParts<2>&, const Surface<2>&);
template WearCircumstances circumstances_of(const AssemblyParts<3>&, const Surface<3>&);
template void complete_surface_laws(const Scene&, AssemblyParts<2>&);
template void complete_surface_laws(const Scene&, AssemblyParts<3>&);

namespace {

/// How far the counter-body of an instant moves to touch each node; infinite where it passes by.
template <int dim>
class Travels {
public:
  Travels(const AssemblyParts<dim>& parts, const CounterBody<dim>& other) : other_(other) {
    for (const ContactPatch<dim>& patch : contact_nodes_of(parts))
      first_ = std::min(first_, to(patch));
  }

  /// Whether it touches the node at most `depth` before or behind its first touch of a surface, and
  /// the body faces it there, seen from where it touches first. What it would have met long before,
  /// as the outside of a bush, it has passed.
  bool within(double depth, const ContactPatch<dim>& patch) const {
    return std::abs(to(patch) - first_) <= depth &&
           faces<dim>(
               patch.initial_normal,
               other_.unchecked_distance(other_.seen(patch.initial_position, first_), 0).normal);
  }

private:
  double to(const ContactPatch<dim>& patch) const {
    return other_.travel_to(patch.initial_position, patch.initial_normal);
  }

  const CounterBody<dim>& other_;
  double first_ = std::numeric_limits<double>::infinity();
};

}  // namespace

template <int dim>
Surface<dim> reachable_boundary(const AssemblyParts<dim>& parts, double depth) {
  const auto instants = parts.instants();
  std::vector<Travels<dim>> travels;
  for (const Phase<dim>& instant : instants) travels.emplace_back(parts, instant.counter_body);
  return OtherBoundary<dim>(parts).joining([&](const ContactPatch<dim>& patch) {
    return std::ranges::any_of(travels,
                               [&](const auto& each) { return each.within(depth, patch); });
  });
}

template Surface<2> reachable_boundary(const AssemblyParts<2>&, double);
template Surface<3> reachable_boundary(const AssemblyParts<3>&, double);

}  // namespace gnomon::part
