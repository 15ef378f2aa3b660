#include "supports.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/terms/loads.hpp>
#include <gnomon/terms/springs.hpp>
#include <set>

#include "groups.hpp"
#include "histories.hpp"

namespace gnomon::part {

std::vector<Key> support_keys() {
  constexpr auto optional = Key::Presence::optional;
  return {
      {.name = "support.#.on",
       .kind = KeyKind::text,
       .presence = optional,
       .absent_meaning = "needed in every [[support]]",
       .help = "group of the mesh that is held: facets, or single points"},
      {.name = "support.#.directions",
       .kind = KeyKind::texts,
       .presence = optional,
       .absent_meaning = "all directions",
       .help = "directions that are held: of \"x\", \"y\", \"z\" (axisymmetric: \"r\", \"z\")"},
      {.name = "support.#.value",
       .kind = KeyKind::reals,
       .unit = "mm",
       .presence = optional,
       .absent_meaning = "held at zero",
       .help = "displacement in each of the directions; of springs, that of their other ends"},
      {.name = "support.#.stiffness",
       .unit = "MPa/mm",
       .presence = optional,
       .absent_meaning = "held rigidly",
       .range = positive_quantity,
       .help = "held by springs: traction for each unit of displacement"},
      times_key("support.#", "value"),
      factors_key("support.#", "value"),
  };
}

template <int dim>
std::vector<int> directions_of(const Scene& scene, const std::string& support) {
  const std::string key = support + ".directions";
  std::vector<int> result;
  if (!scene.knows(key) || !scene.has(key)) {
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

/// Where the other ends of springs move by c(t) u^, k A^ (u - c u^): the springs, and the force
/// c k A^ u^.
template <int dim>
void pull_springs(const Vector<dim>& stiffness, const std::vector<double>& values,
                  const std::vector<int>& directions, const std::vector<ContactPatch<dim>>& patches,
                  LoadHistory history, WornBody<dim>& body) {
  Field::Values forces =
      Field::Values::Zero(static_cast<Eigen::Index>(body.mesh.nodes.size()), dim);
  for (const ContactPatch<dim>& patch : patches)
    for (std::size_t k = 0; k < directions.size(); ++k)
      forces(patch.node, directions[k]) = stiffness[directions[k]] * patch.initial_area * values[k];
  body.added_terms.push_back(
      [forces = std::move(forces), history = std::move(history)](
          const WornBody<dim>&, const WornBodyFields& fields, const Numbering& numbering) {
        return std::make_unique<Loads<dim>>(numbering, fields.u, forces, history,
                                            Loads<dim>::Purpose::acts);
      });
}

template <int dim>
void add_springs(const Scene& scene, const ImportedBody<dim>& part, const std::string& support,
                 const std::vector<int>& directions, WornBody<dim>& body) {
  Vector<dim> stiffness = Vector<dim>::Zero();
  for (int i : directions) stiffness[i] = scene.real(support + ".stiffness");
  const std::string on = support + ".on";
  const auto facets = group_facets(scene, on, scene.text(on), part);
  const Section section = section_of(scene);
  body.added_terms.push_back(
      [=](const WornBody<dim>& whole, const WornBodyFields& fields, const Numbering& numbering) {
        return std::make_unique<Springs<dim>>(whole.mesh, facets, stiffness, numbering, fields.u,
                                              section);
      });
  if (given(scene, support + ".value"))
    pull_springs<dim>(stiffness, values_of(scene, support, directions), directions,
                      contact_patches<dim>(part.mesh, facets, {}, section),
                      read_history(scene, support), body);
}

template <int dim>
void hold(const Scene& scene, const std::string& support, const std::vector<int>& nodes,
          const std::vector<int>& directions, WornBody<dim>& body) {
  const std::string key = support + ".value";
  std::vector<double> values(directions.size(), 0.0);
  const bool moves = given(scene, key);
  if (moves) values = values_of(scene, support, directions);
  PrescribedValues prescribed;
  prescribed.history = read_history(scene, support);
  for (int node : nodes)
    for (std::size_t k = 0; k < directions.size(); ++k) {
      body.displacement_fixed(node, directions[k]) = 1;
      if (moves) prescribed.entries.push_back({node, directions[k], values[k]});
    }
  if (moves) body.prescribed_displacement.push_back(std::move(prescribed));
}

}  // namespace

void find_mistakes_of_supports(const Scene& scene, Mistakes& mistakes) {
  mistakes.collect([&] {
    for (const std::string& support : entries_of(scene, "support", support_keys(), {"on"}))
      mistakes.collect([&] { read_history(scene, support); });
  });
}

template <int dim>
void read_supports(const Scene& scene, const ImportedBody<dim>& part, WornBody<dim>& body) {
  const auto nodes = static_cast<Eigen::Index>(part.mesh.nodes.size());
  body.displacement_fixed = NodalFlags<dim>::Zero(nodes, dim);
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
      if (given(scene, support + ".stiffness"))
        add_springs(scene, part, support, directions, body);
      else
        hold(scene, support, group_nodes(scene, on, scene.text(on), part), directions, body);
    });
  mistakes.require_none();
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

}  // namespace

template <int dim>
void require_held(const Scene& scene, const ImportedBody<dim>& part, const WornBody<dim>& body) {
  constexpr int modes = dim == 2 ? 3 : 6;
  Vector<dim> centre = Vector<dim>::Zero();
  for (const auto& X : part.mesh.nodes) centre += X / double(part.mesh.nodes.size());
  double size = 0;
  for (const auto& X : part.mesh.nodes) size = std::max(size, (X - centre).norm());
  Eigen::Matrix<double, modes, modes> held;
  held.setZero();
  if (dim == 2 && section_of(scene) == Section::meridian)  // it moves along the axis alone
    held(0, 0) = held(modes - 1, modes - 1) = 1;
  const auto holds = [&](int node, const Vector<dim>& direction) {
    const Eigen::Matrix<double, modes, 1> row =
        rigid_motions<dim>((part.mesh.nodes[node] - centre) / size).transpose() * direction;
    held += row * row.transpose();
  };
  for (Eigen::Index node = 0; node < body.displacement_fixed.rows(); ++node)
    for (int i = 0; i < dim; ++i)
      if (body.displacement_fixed(node, i)) holds(static_cast<int>(node), Vector<dim>::Unit(i));
  for (const std::string& support : entries_of(scene, "support", support_keys(), {"on"}))
    if (given(scene, support + ".stiffness"))
      for (int node : part.mesh.boundary_nodes(scene.text(support + ".on")))
        for (int i : directions_of<dim>(scene, support)) holds(node, Vector<dim>::Unit(i));
  // The contact holds in one direction; without friction it does not hold along the surface.
  for (const auto& patch : body.contact_nodes)
    if (!body.counter_force) holds(patch.node, body.contact.counter_body.approach);
  const Eigen::SelfAdjointEigenSolver<decltype(held)> solver(held);
  if (solver.eigenvalues()[0] > 1e-9 * solver.eigenvalues()[modes - 1]) return;
  const auto free =
      (solver.eigenvalues().array() <= 1e-9 * solver.eigenvalues()[modes - 1]).count();
  throw InputError(
      fmt::format("{}: expected supports that hold the part, but it can still move as a rigid body "
                  "in {} {}, for "
                  "example it can {}; name what is held in [[support]], with directions",
                  scene.path().string(), free, free == 1 ? "way" : "ways",
                  describe<dim>(solver.eigenvectors().col(0), direction_names<dim>(scene))));
}

template std::vector<int> directions_of<2>(const Scene&, const std::string&);
template std::vector<int> directions_of<3>(const Scene&, const std::string&);
template void read_supports(const Scene&, const ImportedBody<2>&, WornBody<2>&);
template void read_supports(const Scene&, const ImportedBody<3>&, WornBody<3>&);
template void require_held(const Scene&, const ImportedBody<2>&, const WornBody<2>&);
template void require_held(const Scene&, const ImportedBody<3>&, const WornBody<3>&);

}  // namespace gnomon::part
