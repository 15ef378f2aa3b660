#include "part/held_bodies.hpp"

#include <fmt/format.h>

#include <gnomon/base/error.hpp>

#include "base/spectrum.hpp"
#include "model/rigid_balance.hpp"
#include "part/histories.hpp"
#include "part/pair_cycle.hpp"

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

/// "the part", or what a body of this part is called.
template <int dim>
std::string name_of(const AssemblyParts<dim>& parts, const RigidPart<dim>& part) {
  return parts.pairs.empty() ? "the part" : "\"" + body_of_part(parts, part).name + "\"";
}

/// Contact alone resists this motion of one of the parts, and to one side: loads have to drive it
/// there.
template <int dim>
void require_pressing_loads(const Scene& scene, const AssemblyParts<dim>& parts,
                            const std::vector<RigidPart<dim>>& rigid, std::size_t k,
                            const Twist<dim>& motion) {
  const Closing contact = closing_of(parts, rigid[k], motion);
  if (!contact.is_one_sided()) return;
  const double side = contact.closes > contact.opens ? 1 : -1;
  const Foundation<dim> foundation(parts, rigid, parts.mesh.nodes, {});
  const std::vector<Pose<dim>> at_first(rigid.size(), Pose<dim>::Identity());
  for (const Phase<dim>& phase : parts.instants())
    for (const LoadTime& at : load_times(scene, parts.loads)) {
      const double pressing = side * phase.load * foundation.loads(at_first, at)[k].dot(motion);
      if (pressing <= 0)
        throw InputError(fmt::format(
            "{}: [[load]]: expected loads that press {} at any time, since nothing else holds them "
            "there, but {} at t = {:g} s{}",
            scene.path().string(),
            parts.pairs.empty() ? "the bodies on the counter-body"
                                : name_of(parts, rigid[k]) + " and what it touches on each other",
            pressing < 0 ? "they pull them apart" : "none presses them", at.t,
            parts.cycle ? fmt::format(", tau = {:.3g} of the cycle", phase.position) : ""));
    }
}

/// What holds a part by contact: its partner, in the direction in which this comes, or other
/// bodies, across the surfaces.
template <int dim, class Hold>
void hold_by_contact(const AssemblyParts<dim>& parts, const RigidPart<dim>& part,
                     const Hold& holds) {
  if (!parts.pairs.empty()) {
    for (const ContactPatch<dim>& patch : contact_nodes_of(parts))
      if (part.has(patch.node)) holds(patch.node, patch.initial_normal);
    return;
  }
  if (parts.interface.force) return;
  for (const Surface<dim>& surface : parts.interface.surfaces)
    for (const auto& facet : surface.facets)
      for (int node : facet) holds(node, parts.interface.partner.approach);
}

template <int dim>
void require_part_held(const Scene& scene, const AssemblyParts<dim>& parts,
                       const std::vector<RigidPart<dim>>& rigid, std::size_t k) {
  constexpr int modes = rigid_motions_of(dim);
  const RigidPart<dim>& part = rigid[k];
  Eigen::MatrixXd held = resisted(parts, part, parts.mesh.nodes);
  constexpr double nothing = 1e-9;
  const Eigen::MatrixXd by_supports = held;
  const Spectrum without_contact = spectrum_of(held);
  const auto loose = [](const Eigen::VectorXd& values) {
    return (values.array() <= nothing * values[modes - 1]).count();
  };
  // The contact holds in one direction; without friction it does not hold along the surface.
  hold_by_contact(parts, part, [&](int node, const Vector<dim>& direction) {
    const Eigen::VectorXd row =
        rigid_velocities<dim>(parts.mesh.nodes[node], part.centre, part.size).transpose() *
        direction;
    held += row * row.transpose();
  });
  const auto [values, vectors] = spectrum_of(held);
  const auto free = loose(values);
  if (free == 0) {
    if (parts.interface.force) return;
    // Several motions may be resisted together, as by a prism in a groove; on a counter-body that
    // along its approach is looked at, whatever else is loose.
    Twist<dim> approach = Twist<dim>::Zero();
    approach.template head<dim>() = parts.interface.partner.approach;
    if (loose(without_contact.values) == 1)
      require_pressing_loads<dim>(scene, parts, rigid, k, without_contact.vectors.col(0));
    else if (parts.pairs.empty() && (by_supports * approach).norm() <= nothing * values[modes - 1])
      require_pressing_loads<dim>(scene, parts, rigid, k, approach);
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
  const std::vector<RigidPart<dim>> rigid = rigid_parts(parts, parts.mesh.nodes);
  for (std::size_t k = 0; k < rigid.size(); ++k)
    mistakes.collect([&] { require_part_held(scene, parts, rigid, k); });
  mistakes.require_none();
  const auto require_rest = [&](const std::string& doubt) {
    if (!doubt.empty())
      throw InputError(
          fmt::format("{}: expected supports and contact that determine where each body rests "
                      "under its loads, but {}; hold it there in [[support]], or direct [[load]] "
                      "into the contact{}",
                      scene.path().string(), doubt, hint.empty() ? "" : "; " + hint));
  };
  require_rest(RigidBalance<dim>(parts, places_over_cycle(parts).front(),
                                 loads_change(parts.loads) ? load_times(scene, parts.loads)
                                                           : std::vector<LoadTime>())
                   .doubt);
  if (parts.pairs.empty()) return;
  for (const Phase<dim>& phase : parts.phases)
    if (const std::string doubt = RigidBalance<dim>(parts, phase.places).doubt; !doubt.empty())
      require_rest(fmt::format("at tau = {:.3g} of the cycle {}", phase.position, doubt));
}

template void require_held(const Scene&, const AssemblyParts<2>&, const std::string&);
template void require_held(const Scene&, const AssemblyParts<3>&, const std::string&);

}  // namespace gnomon::part
