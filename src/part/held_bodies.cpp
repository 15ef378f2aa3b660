// Whether supports, springs and contact hold every body.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <gnomon/base/error.hpp>

#include "base/spectrum.hpp"
#include "model/rigid_balance.hpp"
#include "part/histories.hpp"
#include "part/pair_cycle.hpp"
#include "part/supports.hpp"

namespace gnomon::part {

namespace {

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
  const NodalField<dim> forces = forces_of(load, parts);
  double work = 0;
  for (std::size_t node = 0; node < part.size(); ++node)
    if (part[node])
      work += forces.row(static_cast<Eigen::Index>(node)).dot(motion(parts.mesh.nodes[node]));
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
  const double side = away > back ? 1 : -1;
  std::vector<double> works;
  for (const Load<dim>& load : parts.loads)
    works.push_back(side * work_of(load, parts, part, motion));
  for (const Phase<dim>& phase : parts.instants())
    for (const LoadTime& at : load_times(scene, parts.loads)) {
      double pressing = 0;
      for (std::size_t k = 0; k < works.size(); ++k)
        pressing += phase.load * parts.loads[k].history.factor(at.t, at.within) * works[k];
      if (pressing <= 0)
        throw InputError(fmt::format(
            "{}: [[load]]: expected loads that press {} at any time, since nothing else holds them "
            "there, but {} at t = {:g} s{}",
            scene.path().string(),
            parts.pairs.empty() ? "the bodies on the counter-body"
                                : name_of(parts, part) + " and what it touches on each other",
            pressing < 0 ? "they pull them apart" : "none presses them", at.t,
            parts.cycle ? fmt::format(", tau = {:.3g} of the cycle", phase.position) : ""));
    }
}

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
                       const RigidPart<dim>& rigid) {
  constexpr int modes = rigid_motions_of(dim);
  NodesOfPart part(parts.mesh.nodes.size(), 0);
  for (const int node : rigid.nodes) part[node] = 1;
  const auto velocities = [&](const Vector<dim>& X) {
    return rigid_velocities<dim>(X, rigid.centre, rigid.size);
  };
  Eigen::MatrixXd held = resisted(parts, rigid, parts.mesh.nodes);
  constexpr double nothing = 1e-9;
  const Spectrum without_contact = spectrum_of(held);
  const auto loose = [](const Eigen::VectorXd& values) {
    return (values.array() <= nothing * values[modes - 1]).count();
  };
  // The contact holds in one direction; without friction it does not hold along the surface.
  hold_by_contact(parts, part, [&](int node, const Vector<dim>& direction) {
    const Eigen::VectorXd row = velocities(parts.mesh.nodes[node]).transpose() * direction;
    held += row * row.transpose();
  });
  const auto [values, vectors] = spectrum_of(held);
  const auto free = loose(values);
  if (free == 0) {
    // Several motions may be resisted together, as by a prism in a groove.
    if (!parts.interface.force && loose(without_contact.values) == 1)
      require_pressing_loads<dim>(scene, parts, part, [&](const Vector<dim>& X) -> Vector<dim> {
        return velocities(X) * without_contact.vectors.col(0);
      });
    return;
  }
  throw InputError(fmt::format(
      "{}: expected supports that hold {}, but it can still move as a rigid body "
      "in {} {}, for "
      "example it can {}; name what is held in [[support]], with directions{}",
      scene.path().string(), name_of(parts, part), free, free == 1 ? "way" : "ways",
      describe<dim>(vectors.col(0), direction_names<dim>(scene)),
      parts.interface.sticks ? "; friction does not count, a support with a small stiffness does"
                             : ""));
}

}  // namespace

template <int dim>
void require_held(const Scene& scene, const AssemblyParts<dim>& parts, const std::string& hint) {
  Mistakes mistakes;
  for (const RigidPart<dim>& part : rigid_parts(parts, parts.mesh.nodes))
    mistakes.collect([&] { require_part_held(scene, parts, part); });
  mistakes.require_none();
  const RigidBalance<dim> balance(
      parts, places_over_cycle(parts).front(),
      loads_change(parts.loads) ? load_times(scene, parts.loads) : std::vector<LoadTime>());
  if (!balance.doubt.empty())
    throw InputError(
        fmt::format("{}: expected supports and contact that determine where each body rests under "
                    "its loads, but {}; hold it there in [[support]], or direct [[load]] into the "
                    "contact{}",
                    scene.path().string(), balance.doubt, hint.empty() ? "" : "; " + hint));
}

template void require_held(const Scene&, const AssemblyParts<2>&, const std::string&);
template void require_held(const Scene&, const AssemblyParts<3>&, const std::string&);

}  // namespace gnomon::part
