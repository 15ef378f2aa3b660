#include "part/supports.hpp"

#include <fmt/format.h>

#include <functional>
#include <gnomon/base/error.hpp>
#include <iterator>
#include <set>

#include "base/spectrum.hpp"
#include "model/bring_together.hpp"
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

namespace {

/// Rigid motions of a point: translations, then rotations.
template <int dim>
Eigen::Matrix<double, dim, dim == 2 ? 3 : 6> rigid_motions(const Vector<dim>& x) {
  Eigen::Matrix<double, dim, dim == 2 ? 3 : 6> modes;
  modes.setZero();
  modes.template leftCols<dim>().setIdentity();
  if constexpr (dim == 2)
    modes.col(2) << -x[1], x[0];
  else
    for (int axis = 0; axis < 3; ++axis) modes.col(3 + axis) = Vector<3>::Unit(axis).cross(x);
  return modes;
}

/// "along x", "about z", or both.
template <int dim>
std::string describe(const Eigen::VectorXd& mode, const std::vector<std::string>& names) {
  Eigen::Index largest = 0;
  mode.cwiseAbs().maxCoeff(&largest);
  if (largest < dim) return "move along " + names[static_cast<std::size_t>(largest)];
  return dim == 2 ? "turn in its plane"
                  : "turn about " + names[static_cast<std::size_t>(largest - 3)];
}

/// A rigid motion, by the displacement of a point.
template <int dim>
using RigidMotionOfPoints = std::function<Vector<dim>(const Vector<dim>&)>;

/// Nodes of a part of the mesh that is connected: 1 by node.
using NodesOfPart = std::vector<char>;

/// Work of a load on a part at factor one.
template <int dim>
double work_of(const Load<dim>& load, const AssemblyParts<dim>& parts, const NodesOfPart& part,
               const RigidMotionOfPoints<dim>& motion) {
  double work = 0;
  for (std::size_t node = 0; node < static_cast<std::size_t>(load.forces.rows()); ++node)
    if (part[node])
      work += load.forces.row(static_cast<Eigen::Index>(node)).dot(motion(parts.mesh.nodes[node]));
  for (const auto& patch : contact_patches<dim>(parts.mesh, load.facets, {}, parts.section()))
    if (part[patch.node])
      work -= load.pressure * patch.initial_area *
              patch.initial_normal.dot(motion(patch.initial_position));
  return work;
}

/// "the part", or what the bodies of this part are called.
template <int dim>
std::string name_of(const AssemblyParts<dim>& parts, const NodesOfPart& part) {
  if (parts.pairs.empty()) return "the part";
  for (const Body& body : parts.bodies)
    for (const int cell : body.cells)
      if (part[parts.mesh.cells[cell][0]]) return "\"" + body.name + "\"";
  return "each body";
}

/// Contact alone resists this motion, and to one side: loads have to drive the bodies there.
template <int dim>
void require_pressing_loads(const Scene& scene, const AssemblyParts<dim>& parts,
                            const NodesOfPart& part, const RigidMotionOfPoints<dim>& motion) {
  constexpr double oblique = 1e-3;
  double away = 0, back = 0;
  for (const ContactPatch<dim>& patch : contact_nodes_of(parts)) {
    if (!part[patch.node]) continue;
    const double work =
        patch.initial_area * patch.initial_normal.dot(motion(patch.initial_position));
    (work > 0 ? away : back) += std::abs(work);
  }
  if (std::min(away, back) > oblique * std::max(away, back)) return;
  const double side = away > back ? 1 : -1, end = scene.real("time.end");
  std::set<double> times = {0, end};
  std::vector<double> works;
  double whole = 0;
  for (const Load<dim>& load : parts.loads) {
    times.insert(load.history.times().begin(), load.history.times().end());
    works.push_back(side * work_of(load, parts, part, motion));
    whole += std::abs(works.back());
  }
  for (const Phase<dim>& phase : parts.instants())
    for (auto t = times.begin(); *t < end; ++t)
      for (const double at : {*t, *std::next(t)}) {  // the ends of a straight line
        double pressing = 0;
        for (std::size_t k = 0; k < works.size(); ++k)
          pressing += phase.load * parts.loads[k].history.factor(at, *t) * works[k];
        if (pressing <= 0)
          throw InputError(fmt::format(
              "{}: [[load]]: expected loads that press {} at any time, since nothing else holds "
              "them there, got {:.3g} of the loads at t = {:g} s{}",
              scene.path().string(),
              parts.pairs.empty() ? "the bodies on the counter-body"
                                  : name_of(parts, part) + " and what it touches on each other",
              whole > 0 ? pressing / whole : 0, at,
              parts.cycle ? fmt::format(", tau = {:.3g} of the cycle", phase.position) : ""));
      }
}

}  // namespace

namespace {

/// What holds a part by contact: its partner, in the direction in which this comes, or other
/// bodies, across the surfaces.
template <int dim, class Hold>
void hold_by_contact(const AssemblyParts<dim>& parts, const NodesOfPart& part, const Hold& holds) {
  if (!parts.pairs.empty()) {
    for (const ContactPatch<dim>& patch : contact_nodes_of(parts))
      if (part[patch.node]) holds(patch.node, patch.initial_normal);
    return;
  }
  if (parts.interface.force) return;
  for (const Surface<dim>& surface : parts.interface.surfaces)
    for (const auto& facet : surface.facets)
      for (int node : facet) holds(node, parts.interface.partner.approach);
}

template <int dim>
void require_part_held(const Scene& scene, const AssemblyParts<dim>& parts,
                       const NodesOfPart& part) {
  constexpr int modes = dim == 2 ? 3 : 6;
  const std::vector<Vector<dim>>& nodes = parts.mesh.nodes;
  Vector<dim> centre = Vector<dim>::Zero();
  const auto count = static_cast<double>(std::ranges::count(part, 1));
  for (std::size_t node = 0; node < nodes.size(); ++node)
    if (part[node]) centre += nodes[node] / count;
  double size = 0;
  for (std::size_t node = 0; node < nodes.size(); ++node)
    if (part[node]) size = std::max(size, (nodes[node] - centre).norm());
  Eigen::Matrix<double, modes, modes> held;
  held.setZero();
  if (dim == 2 && parts.section() == Section::meridian)  // it moves along the axis alone
    held(0, 0) = held(modes - 1, modes - 1) = 1;
  const auto holds = [&](int node, const Vector<dim>& direction) {
    const Eigen::Matrix<double, modes, 1> row =
        rigid_motions<dim>((nodes[node] - centre) / size).transpose() * direction;
    held += row * row.transpose();
  };
  const NodalFlags<dim>& fixed = parts.supports.held;
  for (Eigen::Index node = 0; node < fixed.rows(); ++node)
    for (int i = 0; i < dim; ++i)
      if (part[node] && fixed(node, i)) holds(static_cast<int>(node), Vector<dim>::Unit(i));
  for (const SpringSupport<dim>& springs : parts.supports.springs)
    for (const auto& facet : springs.facets)
      for (int node : facet)
        for (int i = 0; i < dim; ++i)
          if (part[node] && springs.stiffness[i] > 0) holds(node, Vector<dim>::Unit(i));
  constexpr double nothing = 1e-9;
  const Spectrum without_contact = spectrum_of(held);
  const auto loose = [](const Eigen::VectorXd& values) {
    return (values.array() <= nothing * values[modes - 1]).count();
  };
  // The contact holds in one direction; without friction it does not hold along the surface.
  hold_by_contact(parts, part, holds);
  const auto [values, vectors] = spectrum_of(held);
  const auto free = loose(values);
  if (free == 0) {
    // Several motions may be resisted together, as by a prism in a groove.
    if (!parts.interface.force && loose(without_contact.values) == 1)
      require_pressing_loads<dim>(scene, parts, part, [&](const Vector<dim>& X) -> Vector<dim> {
        return rigid_motions<dim>((X - centre) / size) * without_contact.vectors.col(0);
      });
    return;
  }
  throw InputError(
      fmt::format("{}: expected supports that hold {}, but it can still move as a rigid body "
                  "in {} {}, for "
                  "example it can {}; name what is held in [[support]], with directions",
                  scene.path().string(), name_of(parts, part), free, free == 1 ? "way" : "ways",
                  describe<dim>(vectors.col(0), direction_names<dim>(scene))));
}

}  // namespace

template <int dim>
void require_held(const Scene& scene, const AssemblyParts<dim>& parts) {
  const std::vector<int> number = connected_parts(parts.mesh);
  Mistakes mistakes;
  for (const int part : std::set<int>(number.begin(), number.end())) {
    NodesOfPart nodes;
    for (const int each : number) nodes.push_back(each == part);
    mistakes.collect([&] { require_part_held(scene, parts, nodes); });
  }
  mistakes.require_none();
}

template std::vector<int> directions_of<2>(const Scene&, const std::string&);
template std::vector<int> directions_of<3>(const Scene&, const std::string&);
template Supports<2> read_supports(const Scene&, const ImportedBody<2>&);
template Supports<3> read_supports(const Scene&, const ImportedBody<3>&);
template void require_held(const Scene&, const AssemblyParts<2>&);
template void require_held(const Scene&, const AssemblyParts<3>&);

}  // namespace gnomon::part
