#include "app/new_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/mesh/flat_part.hpp>
#include <limits>
#include <vector>

#include "app/new_scene_text.hpp"

namespace gnomon::app {

namespace {

/// What a counter-body could do: `point` is on the wearing part, `outward` its mean normal there.
template <int dim>
struct Suggestion {
  std::string held = "bottom", wearing = "surface";
  bool closed = false;         ///< it looks everywhere, and has no mean normal
  std::optional<double> bore;  ///< its radius; `point` is its centre
  Vector<dim> outward = -Vector<dim>::Unit(dim - 1), point = Vector<dim>::Zero();
};

/// Where the wearing part reaches farthest along its mean normal, if it has one.
template <int dim>
void meet(const ImportedBody<dim>& body, Suggestion<dim>& suggestion) {
  Vector<dim> normal = Vector<dim>::Zero();
  double area = 0;
  for (const auto& patch :
       contact_patches<dim>(body.mesh, body.mesh.boundary.at(suggestion.wearing))) {
    normal += patch.initial_area * patch.initial_normal;
    area += patch.initial_area;
  }
  constexpr double closed = 1e-3;  // part of the area, below which a surface looks everywhere
  suggestion.closed = normal.norm() <= closed * area;
  if (!suggestion.closed) suggestion.outward = normal.normalized();
  double farthest = -std::numeric_limits<double>::infinity();
  for (int node : body.mesh.boundary_nodes(suggestion.wearing)) {
    const Vector<dim>& X = body.mesh.nodes[node];
    if (X.dot(suggestion.outward) <= farthest) continue;
    farthest = X.dot(suggestion.outward);
    suggestion.point = X;
  }
}

bool sounds_worn(const std::string& name) {
  return sounds_like(name, {"contact", "surface", "wear", "worn", "sole", "bore", "seat", "slid"});
}

/// The part that sounds so wears, else a curved one, else the first; one of the others is held.
template <int dim>
Suggestion<dim> suggest(const ImportedBody<dim>& body) {
  Suggestion<dim> suggestion;
  const auto& parts = body.mesh.boundary;
  if (parts.empty()) return suggestion;
  auto wearing =
      std::ranges::find_if(parts, [](const auto& part) { return sounds_worn(part.first); });
  if (wearing == parts.end())
    wearing = std::ranges::find_if(
        parts, [&](const auto& part) { return !flat_part<dim>(body.mesh, part.second).flat; });
  suggestion.wearing = (wearing == parts.end() ? parts.begin() : wearing)->first;
  meet(body, suggestion);
  if constexpr (dim == 2)
    if (const auto circle = circle_of(body.mesh, parts.at(suggestion.wearing), suggestion.outward);
        circle && circle->hollow) {
      suggestion.bore = circle->radius, suggestion.point = circle->centre;
      if (suggestion.closed) suggestion.outward *= -1;  // pressed downwards
    }
  std::vector<std::string> others;
  for (const auto& [name, facets] : parts)
    if (name != suggestion.wearing) others.push_back(name);
  suggestion.held = part_away_from(body, others, suggestion.outward);
  return suggestion;
}

/// A plane, or a shaft in a bore, and how it moves.
template <int dim>
std::string counter_shape(const Suggestion<dim>& s) {
  constexpr double clearance = 1e-3;  // of the radius
  if (s.bore)
    return fmt::format(
        "shape = \"cylinder\"\ncenter = {}  # mm\nradius = {:.6g}  # mm\n"
        "motion = {{ rotation = 10.0 }}  # rad/s\n",
        coordinates<dim>(s.point), (1 - clearance) * *s.bore);
  return fmt::format(
      "shape = \"plane\"\ncenter = {}  # mm\nnormal = {}  # towards the part\n"
      "motion = {{ velocity = {} }}  # mm/s\n",
      coordinates<dim>(s.point), coordinates<dim>(-s.outward),
      coordinates<dim>(1000 * sliding_direction<dim>(s.outward)));
}

}  // namespace

template <int dim>
std::string new_scene(const std::filesystem::path& mesh, std::optional<double> size,
                      const ImportedBody<dim>& body) {
  const Suggestion<dim> s = suggest(body);
  std::string text = scene_head("A part from " + mesh.filename().string(), mesh, size, body);
  text += fmt::format("\n[body]\n{}", material_text);
  text += support_text(s.held, every_direction<dim>(), "may be several");
  text +=
      "\n# [[load]]  # may be several\n# on = \"...\"\n# force = [...]  # or traction, pressure\n";
  text += fmt::format(
      "\n[counter_body]  # plane, ball, cylinder, cone, torus, profile: docs/counter_bodies.md\n{}"
      "press = {{ direction = {}, force = 100.0 }}  # {}\n",
      counter_shape(s), coordinates<dim>(-s.outward), unit_of_force(dim));
  text += scene_tail({s.wearing});
  return text;
}

template std::string new_scene(const std::filesystem::path&, std::optional<double>,
                               const ImportedBody<2>&);
template std::string new_scene(const std::filesystem::path&, std::optional<double>,
                               const ImportedBody<3>&);

}  // namespace gnomon::app
