#include "app/new_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/mesh/flat_part.hpp>
#include <limits>
#include <vector>

namespace gnomon::app {

namespace {

/// What a counter-body could do: `point` is on the wearing part, `outward` its mean normal there.
template <int dim>
struct Suggestion {
  std::string held = "bottom", wearing = "surface";
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
  if (normal.norm() > closed * area) suggestion.outward = normal.normalized();
  double farthest = -std::numeric_limits<double>::infinity();
  for (int node : body.mesh.boundary_nodes(suggestion.wearing)) {
    const Vector<dim>& X = body.mesh.nodes[node];
    if (X.dot(suggestion.outward) <= farthest) continue;
    farthest = X.dot(suggestion.outward);
    suggestion.point = X;
  }
}

/// A circle whose normals look to its centre, at least a half of one.
void find_bore(const ImportedBody<2>& body, Suggestion<2>& suggestion) {
  constexpr double round = 1e-3;  // of the radius
  Vector<2> low = Vector<2>::Constant(std::numeric_limits<double>::infinity()), high = -low;
  const auto patches = contact_patches<2>(body.mesh, body.mesh.boundary.at(suggestion.wearing));
  for (const auto& patch : patches) {
    low = low.cwiseMin(patch.initial_position);
    high = high.cwiseMax(patch.initial_position);
  }
  const double radius = (high - low).maxCoeff() / 2;
  Vector<2> centre = (low + high) / 2;
  for (int i = 0; i < 2; ++i)  // of half a circle
    if (const double height = high[i] - low[i]; height < (2 - round) * radius)
      centre[i] = suggestion.outward[i] > 0 ? low[i] : high[i];
  for (const auto& patch : patches) {
    const Vector<2> arm = patch.initial_position - centre;
    if (std::abs(arm.norm() - radius) > round * radius || arm.dot(patch.initial_normal) >= 0)
      return;
  }
  suggestion.bore = radius;
  suggestion.point = centre;
}

/// Whether somebody may have named a part so because it is what these words say.
bool sounds_like(const std::string& name, std::initializer_list<const char*> words) {
  return std::ranges::any_of(
      words, [&](const char* word) { return name.find(word) != std::string::npos; });
}

bool sounds_worn(const std::string& name) {
  return sounds_like(name, {"contact", "surface", "wear", "worn", "sole", "bore", "seat", "slid"});
}

bool sounds_held(const std::string& name) {
  return sounds_like(name, {"back", "base", "bottom", "clamp", "fix", "held", "hold", "housing",
                            "mount", "support"});
}

/// The part that sounds so wears, else a curved one, else the first. Of the others that one is held
/// which sounds so, else of flat ones that which looks most away from where the wearing one looks,
/// else any.
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
  if constexpr (dim == 2) find_bore(body, suggestion);
  suggestion.held = "...";
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [name, facets] : parts) {
    if (name == suggestion.wearing) continue;
    const FlatPart<dim> part = flat_part<dim>(body.mesh, facets);
    const double along = sounds_held(name) ? -2
                         : part.flat       ? part.normal.dot(suggestion.outward)
                                           : 2;
    if (along < least) suggestion.held = name, least = along;
  }
  return suggestion;
}

/// As a user would write it: without rounding errors.
template <int dim>
std::string coordinates(const Vector<dim>& vector) {
  const double largest = vector.template lpNorm<Eigen::Infinity>();
  std::vector<std::string> numbers;
  for (double x : vector) {
    std::string number = fmt::format("{:.6g}", std::abs(x) <= 1e-9 * largest ? 0.0 : x);
    if (number.find_first_of(".e") == std::string::npos) number += ".0";
    numbers.push_back(std::move(number));
  }
  return fmt::format("[{}]", fmt::join(numbers, ", "));
}

/// A direction along the plane.
template <int dim>
Vector<dim> sliding_direction(const Vector<dim>& outward) {
  if constexpr (dim == 2) return {-outward[1], outward[0]};
  const Vector<dim> across = Vector<dim>::Unit(std::abs(outward[0]) < 0.9 ? 0 : 1);
  return (across - across.dot(outward) * outward).normalized();
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
  std::vector<std::string> names;
  for (const auto& [name, facets] : body.mesh.boundary) names.push_back(name);
  const Suggestion<dim> s = suggest(body);
  const std::string file = mesh.filename().string();
  std::string text = fmt::format(
      "# A part from {}. One consistent set of units: mm, N, MPa, s.\n"
      "# All keys: gnomon help scene worn_body\n\nproblem = \"worn_body\"\n\n"
      "[mesh]\nfile = \"{}\"  # parts: {}\n",
      file, file,
      names.empty() ? "none: name some in Gmsh" : fmt::format("{}", fmt::join(names, ", ")));
  std::vector<std::string> points;
  for (const auto& [name, nodes] : body.point_groups) points.push_back(name);
  if (!points.empty())
    text += fmt::format("# groups of points, for supports: {}\n", fmt::join(points, ", "));
  if (size) text += fmt::format("size = {}  # mm, longest edge of an element\n", *size);
  if (dim == 2)
    text += "\n[model]\nplane = \"strain\"  # or \"axisymmetric\", in coordinates (r, z)\n";
  text += "\n[body]\nyoung_modulus = 210e3  # MPa\npoisson_ratio = 0.3\n";
  text += fmt::format("\n[[support]]  # may be several\non = \"{}\"\ndirections = [{}]\n", s.held,
                      dim == 2 ? "\"x\", \"y\"" : "\"x\", \"y\", \"z\"");
  text +=
      "\n# [[load]]  # may be several\n# on = \"...\"\n# force = [...]  # or traction, pressure\n";
  text += fmt::format(
      "\n[counter_body]  # plane, ball, cylinder, cone, torus, profile: docs/counter_bodies.md\n{}"
      "press = {{ direction = {}, force = 100.0 }}  # {}\n",
      counter_shape(s), coordinates<dim>(s.bore ? s.outward : -s.outward),
      dim == 2 ? "N per mm of thickness; axisymmetric: N" : "N");
  text += fmt::format(
      "\n[wear]\non = [\"{}\"]\ncoefficient = 1e-8  # 1/MPa  k\nrate = \"k * p * v\"\n"
      "\n[friction]\ncoefficient = 0.0\n"
      "\n[time]\nend = 1000.0  # s\n"
      "\n[integrator]\nname = \"esdirk-3\"\nrtol = 1e-4  # of the worn surface, per step\n",
      s.wearing);
  return text;
}

template std::string new_scene(const std::filesystem::path&, std::optional<double>,
                               const ImportedBody<2>&);
template std::string new_scene(const std::filesystem::path&, std::optional<double>,
                               const ImportedBody<3>&);

}  // namespace gnomon::app
