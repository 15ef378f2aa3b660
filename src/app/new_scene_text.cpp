#include "app/new_scene_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/mesh/flat_part.hpp>
#include <gnomon/mesh/mesh_file.hpp>
#include <limits>

#include "scene/toml_text.hpp"

namespace gnomon::app {

bool sounds_like(const std::string& name, std::initializer_list<const char*> words) {
  return std::ranges::any_of(
      words, [&](const char* word) { return name.find(word) != std::string::npos; });
}

bool sounds_held(const std::string& name) {
  return sounds_like(name, {"back", "base", "bottom", "clamp", "fix", "held", "hold", "housing",
                            "mount", "support"});
}

template <int dim>
std::string part_away_from(const ImportedBody<dim>& body, const std::vector<std::string>& names,
                           const Vector<dim>& outward) {
  std::string best = "...";
  double least = std::numeric_limits<double>::infinity();
  for (const std::string& name : names) {
    const FlatPart<dim> part = flat_part<dim>(body.mesh, body.mesh.boundary.at(name));
    const double along = sounds_held(name) ? -2 : part.flat ? part.normal.dot(outward) : 2;
    if (along < least) best = name, least = along;
  }
  return best;
}

std::optional<Circle> circle_of(const Mesh<2>& mesh, const std::vector<Mesh<2>::Facet>& facets,
                                const Vector<2>& outward) {
  constexpr double round = 1e-3;  // of the radius
  Vector<2> low = Vector<2>::Constant(std::numeric_limits<double>::infinity()), high = -low;
  const auto patches = contact_patches<2>(mesh, facets);
  for (const auto& patch : patches) {
    low = low.cwiseMin(patch.initial_position);
    high = high.cwiseMax(patch.initial_position);
  }
  Circle circle{.centre = (low + high) / 2, .radius = (high - low).maxCoeff() / 2};
  const auto looks_inwards = [&](const ContactPatch<2>& patch) {
    return (patch.initial_position - circle.centre).dot(patch.initial_normal) < 0;
  };
  const auto is_circle = [&] {
    circle.hollow = looks_inwards(patches.front());
    return std::ranges::all_of(patches, [&](const auto& patch) {
      const double distance = (patch.initial_position - circle.centre).norm();
      return std::abs(distance - circle.radius) <= round * circle.radius &&
             looks_inwards(patch) == circle.hollow;
    });
  };
  if (patches.empty()) return {};
  if (is_circle()) return circle;
  for (const bool hollow : {true, false}) {  // half a circle
    for (int i = 0; i < 2; ++i)
      if (const double height = high[i] - low[i]; height < (2 - round) * circle.radius)
        circle.centre[i] = (outward[i] > 0) == hollow ? high[i] : low[i];
    if (is_circle() && circle.hollow == hollow) return circle;
  }
  return {};
}

template <int dim>
Vector<dim> sliding_direction(const Vector<dim>& normal) {
  if constexpr (dim == 2) return {-normal[1], normal[0]};
  const Vector<dim> across = Vector<dim>::Unit(std::abs(normal[0]) < 0.9 ? 0 : 1);
  return (across - across.dot(normal) * normal).normalized();
}

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

template <int dim>
std::set<int> every_direction() {
  std::set<int> directions;
  for (int i = 0; i < dim; ++i) directions.insert(i);
  return directions;
}

std::string support_text(const std::string& on, const std::set<int>& directions,
                         const std::string& comment) {
  std::vector<std::string> names;
  for (const int i : directions) names.push_back(fmt::format("\"{}\"", "xyz"[i]));
  return fmt::format("\n[[support]]  # {}\non = {}\ndirections = [{}]\n", comment, toml_text(on),
                     fmt::join(names, ", "));
}

template <int dim>
std::string scene_head(const std::string& title, const std::filesystem::path& mesh,
                       std::optional<double> size, const ImportedBody<dim>& body) {
  std::vector<std::string> names, points;
  for (const auto& [name, facets] : body.mesh.boundary) names.push_back(name);
  for (const auto& [name, nodes] : body.point_groups) points.push_back(name);
  std::string text = fmt::format(
      "# {}. One consistent set of units: mm, N, MPa, s.\n"
      "# All keys: gnomon help scene worn_body\n\nproblem = \"worn_body\"\n\n"
      "[mesh]\nfile = {}  # parts: {}\n",
      title, toml_text(mesh.string()),
      names.empty() ? "none: name some in Gmsh" : fmt::format("{}", fmt::join(names, ", ")));
  if (!points.empty())
    text += fmt::format("# groups of points, for supports: {}\n", fmt::join(points, ", "));
  if (size) text += fmt::format("size = {}  # mm, longest edge of an element\n", *size);
  if (is_geometry(mesh))
    text += "# contact_size = ...  # mm, edge of the elements where the bodies touch\n";
  if (dim == 2)
    text += "\n[model]\nplane = \"strain\"  # or \"axisymmetric\", in coordinates (r, z)\n";
  return text;
}

std::string scene_tail(const std::vector<std::string>& wearing) {
  std::vector<std::string> names;
  for (const std::string& name : wearing) names.push_back(toml_text(name));
  return fmt::format(
      "\n[wear]\non = [{}]\ncoefficient = 1e-8  # 1/MPa  k\nrate = \"k * p * v\"\n"
      "\n[friction]\ncoefficient = 0.0\n"
      "\n[time]\nend = 1000.0  # s\n"
      "\n[integrator]\nname = \"esdirk-3\"\nrtol = 1e-4  # of the worn surface, per step\n",
      fmt::join(names, ", "));
}

template std::string part_away_from(const ImportedBody<2>&, const std::vector<std::string>&,
                                    const Vector<2>&);
template Vector<2> sliding_direction(const Vector<2>&);
template std::string coordinates(const Vector<2>&);
template std::set<int> every_direction<2>();
template std::string scene_head(const std::string&, const std::filesystem::path&,
                                std::optional<double>, const ImportedBody<2>&);
template std::string part_away_from(const ImportedBody<3>&, const std::vector<std::string>&,
                                    const Vector<3>&);
template Vector<3> sliding_direction(const Vector<3>&);
template std::string coordinates(const Vector<3>&);
template std::set<int> every_direction<3>();
template std::string scene_head(const std::string&, const std::filesystem::path&,
                                std::optional<double>, const ImportedBody<3>&);

}  // namespace gnomon::app
