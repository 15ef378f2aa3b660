#include "part/supports.hpp"

#include <fmt/format.h>

#include <gnomon/base/error.hpp>
#include <iterator>
#include <set>

#include "part/groups.hpp"
#include "part/histories.hpp"

namespace gnomon::part {

std::vector<Key> support_keys() {
  return {
      text_key("support.#.on", absent("needed in every [[support]]"),
               "group of the mesh that is held: facets, or single points"),
      texts_key("support.#.directions", absent("all directions"),
                "directions that are held: of \"x\", \"y\", \"z\" (axisymmetric: \"r\", \"z\")"),
      reals_key("support.#.value", "mm", absent("held at zero"), {},
                "displacement in each of the directions; of springs, that of their other ends"),
      real_key("support.#.stiffness", "MPa/mm", absent("held rigidly"), positive_quantity,
               "held by springs: traction for each unit of displacement"),
      times_key("support.#", "value"),
      factors_key("support.#", "value"),
  };
}

template <int dim>
std::vector<int> directions_of(const Scene& scene, const std::string& support) {
  const std::string key = support + ".directions";
  std::vector<int> result;
  if (!scene.given(key)) {
    for (int i = 0; i < dim; ++i) result.push_back(i);
    return result;
  }
  const std::vector<std::string> names = direction_names<dim>(scene);
  for (const std::string& direction : scene.texts(key)) {
    const auto found = std::find(names.begin(), names.end(), direction);
    if (found == names.end())
      throw InputError(fmt::format("{}: expected directions among \"{}\", got \"{}\"",
                                   scene.where(key), fmt::join(names, "\", \""), direction));
    result.push_back(static_cast<int>(found - names.begin()));
  }
  if (result.empty())
    throw InputError(fmt::format("{}: expected one direction or more of \"{}\"", scene.where(key),
                                 fmt::join(names, "\", \"")));
  return result;
}

namespace {

/// One number for each direction.
std::vector<double> values_of(const Scene& scene, const std::string& support,
                              const std::vector<int>& directions) {
  const std::string key = support + ".value";
  const std::vector<double> values = scene.reals(key);
  if (values.size() != directions.size())
    throw InputError(fmt::format("{}: expected one number for each direction, {}, got {}",
                                 scene.where(key), directions.size(), values.size()));
  return values;
}

/// With zero in other directions.
template <int dim>
SpringSupport<dim> read_springs(const Scene& scene, const ImportedBody<dim>& part,
                                const std::string& support, const std::vector<int>& directions) {
  const std::string on = support + ".on";
  SpringSupport<dim> springs{.name = "support_" + support.substr(support.rfind('.') + 1),
                             .facets = group_facets(scene, on, scene.text(on), part),
                             .history = read_history(scene, support)};
  for (int i : directions) springs.stiffness[i] = scene.real(support + ".stiffness");
  if (!scene.given(support + ".value")) return springs;
  const std::vector<double> values = values_of(scene, support, directions);
  for (std::size_t k = 0; k < directions.size(); ++k)
    springs.displacement[directions[k]] = values[k];
  return springs;
}

/// What moves of the nodes in these directions; nothing where they are held at zero.
PrescribedValues read_moved(const Scene& scene, const std::string& support,
                            const std::vector<int>& nodes, const std::vector<int>& directions) {
  PrescribedValues moved;
  moved.history = read_history(scene, support);
  if (!scene.given(support + ".value")) return moved;
  const std::vector<double> values = values_of(scene, support, directions);
  for (int node : nodes)
    for (std::size_t k = 0; k < directions.size(); ++k)
      moved.entries.push_back({node, directions[k], values[k]});
  return moved;
}

}  // namespace

void find_mistakes_of_supports(const Scene& scene, Mistakes& mistakes) {
  mistakes.collect([&] {
    for (const std::string& support : entries_of(scene, "support", support_keys(), {"on"}))
      mistakes.collect([&] { read_history(scene, support); });
  });
}

template <int dim>
Supports<dim> read_supports(const Scene& scene, const ImportedBody<dim>& part) {
  Supports<dim> result{
      .held = NodalFlags<dim>::Zero(static_cast<Eigen::Index>(part.mesh.nodes.size()), dim)};
  if constexpr (dim == 2)
    if (section_of(scene) == Section::meridian) result.held = held_on_axis(part.mesh);
  Mistakes mistakes;
  std::set<std::pair<std::string, int>> held;  // groups and directions
  for (const std::string& support : entries_of(scene, "support", support_keys(), {"on"}))
    mistakes.collect([&] {
      const std::vector<int> directions = directions_of<dim>(scene, support);
      const std::string on = support + ".on";
      for (int i : directions)
        if (!held.emplace(scene.text(on), i).second)
          throw InputError(
              fmt::format("{}: expected each direction of a group once, \"{}\" is "
                          "already held along {}",
                          scene.where(on), scene.text(on),
                          direction_names<dim>(scene)[static_cast<std::size_t>(i)]));
      if (scene.given(support + ".stiffness")) {
        result.springs.push_back(read_springs(scene, part, support, directions));
        return;
      }
      const std::vector<int> nodes = group_nodes(scene, on, scene.text(on), part);
      NamedSupport named{"support_" + support.substr(support.rfind('.') + 1), {}};
      for (int node : nodes)
        for (int i : directions) {
          if (!result.held(node, i)) named.held.emplace_back(node, i);
          result.held(node, i) = 1;
        }
      result.named.push_back(std::move(named));
      if (PrescribedValues moved = read_moved(scene, support, nodes, directions);
          !moved.entries.empty())
        result.moved.push_back(std::move(moved));
    });
  mistakes.require_none();
  return result;
}

template std::vector<int> directions_of<2>(const Scene&, const std::string&);
template std::vector<int> directions_of<3>(const Scene&, const std::string&);
template Supports<2> read_supports(const Scene&, const ImportedBody<2>&);
template Supports<3> read_supports(const Scene&, const ImportedBody<3>&);

}  // namespace gnomon::part
