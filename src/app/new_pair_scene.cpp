#include "app/new_pair_scene.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/flat_part.hpp>
#include <gnomon/shapes/counter_surface.hpp>
#include <limits>
#include <set>

#include "app/facing_bodies.hpp"
#include "app/new_scene_text.hpp"
#include "scene/toml_text.hpp"

namespace gnomon::app {

namespace {

/// Outwards from one side of an encounter, that of a flat side or the mean one.
template <int dim>
Vector<dim> normal_of(const Mesh<dim>& mesh, const Encounter<dim>& encounter, std::size_t side) {
  constexpr double everywhere = 0.1;  // part of the area, below which a side has no mean normal
  std::array<Vector<dim>, 2> mean;
  for (const std::size_t each : {side, 1 - side}) {
    const double sign = each == side ? 1 : -1;
    const FlatPart<dim> part = flat_part<dim>(mesh, encounter.facets[each]);
    if (part.flat) return sign * part.normal;
    double area = 0;
    mean[each].setZero();
    for (const auto& facet : encounter.facets[each]) {
      const Vector<dim> vector = area_vector(mesh, facet);
      mean[each] += sign * vector;
      area += vector.norm();
    }
    mean[each] /= area;
  }
  for (const std::size_t each : {side, 1 - side})
    if (mean[each].norm() > everywhere) return mean[each].normalized();
  return Vector<dim>::Unit(dim - 1);  // a shaft all around
}

/// The coordinate direction that is nearest.
template <int dim>
Vector<dim> along_axis(const Vector<dim>& direction) {
  Eigen::Index axis = 0;
  direction.cwiseAbs().maxCoeff(&axis);
  return std::copysign(1.0, direction[axis]) * Vector<dim>::Unit(axis);
}

/// What is to be written, as it is found out.
template <int dim>
class PairScene {
public:
  PairScene(const ImportedBody<dim>& body, const std::vector<std::string>& names)
      : body_(body), names_(names), node_body_(bodies_of_nodes(body, names)) {
    choose_pairs(find_encounters(body, names));
    find_free_parts();
    std::vector<char> reached(names.size(), 0);
    for (int root = choose_root(reached); root >= 0; root = choose_root(reached)) {
      hold(root);
      press_on(root, reached);
    }
  }

  std::string text() const {
    std::string text;
    for (const std::string& name : names_)
      text += fmt::format("\n[[body]]\nname = {}\n{}", toml_text(name), material_text);
    for (const Encounter<dim>& pair : pairs_)
      text += fmt::format("\n[[pair]]  # bodies that touch each other\nbodies = [{}, {}]\n",
                          toml_text(names_[pair.bodies[0]]), toml_text(names_[pair.bodies[1]]));
    text += motions_;
    for (const Support& support : supports_)
      text += support_text(support.on, support.directions, support.comment);
    return text + loads_ + scene_tail(wearing());
  }

private:
  struct Support {
    std::string on;
    std::set<int> directions;
    std::string comment;
  };
  using Parts = std::vector<std::string>;

  const ImportedBody<dim>& body_;
  const std::vector<std::string>& names_;
  std::vector<int> node_body_;
  std::vector<Encounter<dim>> pairs_;
  std::vector<Parts> free_;  // by body: named parts of it alone that touch nothing
  std::vector<Support> supports_;
  std::string motions_, loads_;

  /// The nearest ones that join all bodies, and all others that touch.
  void choose_pairs(std::vector<Encounter<dim>> encounters) {
    if (encounters.empty())
      throw InputError(
          fmt::format("{}: expected bodies that face each other, none of \"{}\" faces another one",
                      body_.file, fmt::join(names_, "\", \"")));
    std::vector<int> joined(names_.size());
    for (std::size_t k = 0; k < joined.size(); ++k) joined[k] = static_cast<int>(k);
    for (Encounter<dim>& encounter : encounters) {
      const int one = joined[encounter.bodies[0]], other = joined[encounter.bodies[1]];
      if (one == other && !encounter.touch) continue;
      std::ranges::replace(joined, other, one);
      pairs_.push_back(std::move(encounter));
    }
  }

  Parts wearing() const {
    Parts result;
    for (const Encounter<dim>& pair : pairs_)
      for (const Parts& parts : pair.parts)
        for (const std::string& part : parts)
          if (std::ranges::find(result, part) == result.end()) result.push_back(part);
    return result.empty() ? Parts{"..."} : result;
  }

  void find_free_parts() {
    free_.resize(names_.size());
    const Parts touching = wearing();
    for (const auto& [name, facets] : body_.mesh.boundary) {
      const int of = facets.empty() ? -1 : node_body_[facets.front()[0]];
      const bool whole = std::ranges::all_of(
          facets, [&](const auto& facet) { return node_body_[facet[0]] == of; });
      if (of >= 0 && whole && std::ranges::find(touching, name) == touching.end())
        free_[of].push_back(name);
    }
  }

  /// Of the bodies that are not reached and part of a pair: one with a part that sounds held, else
  /// the lowest; -1 if there is none.
  int choose_root(const std::vector<char>& reached) const {
    int best = -1;
    std::pair<bool, double> most;
    for (const Encounter<dim>& pair : pairs_)
      for (const int of : pair.bodies) {
        if (reached[of]) continue;
        double low = std::numeric_limits<double>::infinity();
        for (std::size_t node = 0; node < node_body_.size(); ++node)
          if (node_body_[node] == of) low = std::min(low, body_.mesh.nodes[node][dim - 1]);
        const bool held = sounds_held(names_[of]) || std::ranges::any_of(free_[of], sounds_held);
        if (best >= 0 && std::pair(held, -low) <= most) continue;
        best = of, most = {held, -low};
      }
    return best;
  }

  void add_support(const std::string& on, const std::set<int>& directions,
                   const std::string& comment) {
    const auto found = std::ranges::find(supports_, on, &Support::on);
    if (found == supports_.end() || on == "...")
      supports_.push_back({on, directions, comment});
    else
      found->directions.insert(directions.begin(), directions.end());
  }

  /// Held, and its material moves along where it first touches another body.
  void hold(int root) {
    const auto first = std::ranges::find_if(
        pairs_, [&](const auto& pair) { return pair.bodies[0] == root || pair.bodies[1] == root; });
    const std::size_t side = first->bodies[0] == root ? 0 : 1;
    const Vector<dim> normal = normal_of<dim>(body_.mesh, *first, side);
    add_support(part_away_from<dim>(body_, free_[root], normal), every_direction<dim>(),
                fmt::format("holds \"{}\"; may be several", names_[root]));
    std::string motion;
    if constexpr (dim == 2)
      if (const auto circle = circle_of(body_.mesh, first->facets[side], normal))
        motion = fmt::format("rotation = 10.0  # rad/s\ncenter = {}  # mm\n",
                             coordinates<dim>(circle->centre));
    if (motion.empty())
      motion = fmt::format("velocity = {}  # mm/s; or rotation, rad/s, about a center{}\n",
                           coordinates<dim>(1000 * sliding_direction<dim>(-normal)),
                           dim == 2 ? "" : " and an axis");
    motions_ +=
        fmt::format("\n[[motion]]  # of its material: its shape stays where it is\nbody = {}\n{}",
                    toml_text(names_[root]), motion);
  }

  /// Guides and presses the bodies that touch one that is held, and those that touch them.
  void press_on(int held, std::vector<char>& reached) {
    reached[held] = 1;
    for (const Encounter<dim>& pair : pairs_)
      for (const std::size_t side : {0u, 1u}) {
        const int other = pair.bodies[1 - side];
        if (pair.bodies[side] != held || reached[other]) continue;
        press(other, held, along_axis<dim>(-normal_of<dim>(body_.mesh, pair, side)));
        press_on(other, reached);
      }
  }

  void press(int pressed, int on, const Vector<dim>& direction) {
    const std::string loaded = part_away_from<dim>(body_, free_[pressed], direction);
    for (int axis = 0; axis < dim; ++axis)
      if (direction[axis] == 0)
        add_support(
            guide_along(axis, pressed, on).value_or(loaded), {axis},
            fmt::format("guides \"{}\": free in the direction of the load", names_[pressed]));
    loads_ += fmt::format("\n[[load]]  # presses \"{}\" on \"{}\"\non = {}\nforce = {}  # {}\n",
                          names_[pressed], names_[on], toml_text(loaded),
                          coordinates<dim>(100 * direction), unit_of_force(dim));
  }

  /// A flat part of the body across this axis; on a plane of symmetry, if there is one, where the
  /// other body is guided, too.
  std::optional<std::string> guide_along(int axis, int pressed, int on) {
    const Parts sides = across(axis, pressed), partners = across(axis, on);
    std::vector<std::pair<std::string, std::string>> planes;  // that both end at
    for (const std::string& one : sides)
      for (const std::string& other : partners)
        if (same_plane(axis, one, other)) planes.emplace_back(one, other);
    if (planes.size() == 1) {
      add_support(planes[0].second, {axis},
                  fmt::format("if \"{}\" is on a plane of symmetry", planes[0].second));
      return planes[0].first;
    }
    if (sides.empty()) return {};
    const auto held = std::ranges::find_if(sides, sounds_held);
    return held == sides.end() ? sides.front() : *held;
  }

  Parts across(int axis, int of) const {
    constexpr double parallel = 1 - 1e-6;  // cosine
    Parts result;
    for (const std::string& name : free_[of]) {
      const FlatPart<dim> part = flat_part<dim>(body_.mesh, body_.mesh.boundary.at(name));
      if (part.flat && std::abs(part.normal[axis]) > parallel) result.push_back(name);
    }
    return result;
  }

  bool same_plane(int axis, const std::string& one, const std::string& other) const {
    const double same = 1e-6 * Box<dim>::around(body_.mesh.nodes).diagonal();
    const auto side = [&](const std::string& name) {
      const auto& facet = body_.mesh.boundary.at(name).front();
      return std::pair(body_.mesh.nodes[facet[0]][axis], area_vector(body_.mesh, facet)[axis]);
    };
    const auto [x, outward] = side(one);
    const auto [y, too] = side(other);
    return std::abs(x - y) < same && outward * too > 0;
  }
};

}  // namespace

std::vector<std::string> bodies_that_meet(const ImportedMesh& mesh) {
  const std::vector<std::string> names = separate_groups(mesh);
  std::set<int> cells;
  for (const MeshGroup& group : mesh.groups)
    if (group.dimension == mesh.dimension) cells.insert(group.members.begin(), group.members.end());
  return std::ssize(cells) == mesh.cells.size() ? names : std::vector<std::string>();
}

template <int dim>
std::string new_pair_scene(const std::filesystem::path& mesh, std::optional<double> size,
                           const ImportedBody<dim>& body, const std::vector<std::string>& names) {
  return scene_head("Bodies from " + mesh.filename().string() + " that touch each other", mesh,
                    size, body) +
         PairScene<dim>(body, names).text();
}

template std::string new_pair_scene(const std::filesystem::path&, std::optional<double>,
                                    const ImportedBody<2>&, const std::vector<std::string>&);
template std::string new_pair_scene(const std::filesystem::path&, std::optional<double>,
                                    const ImportedBody<3>&, const std::vector<std::string>&);

}  // namespace gnomon::app
