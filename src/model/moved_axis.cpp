#include "model/moved_axis.hpp"

#include <cmath>
#include <set>

#include "mesh/facet_table.hpp"

namespace gnomon {

namespace {

/// Means over one side of a pair in a phase, by the contact forces.
template <int dim>
struct MeanOfSide {
  double force = 0;
  Vector<dim> x = Vector<dim>::Zero(), moved = Vector<dim>::Zero();  // in space

  MeanOfSide(const Assembly<dim>& assembly, const std::set<int>& nodes, const BodyPlace<dim>& place,
             const NodalField<dim>& d, const NodalField<dim>& u,
             const std::vector<ContactNode<dim>>& contact) {
    for (const int node : nodes) {
      const ContactNode<dim>& at = contact[static_cast<std::size_t>(assembly.contact_node(node))];
      const double part = at.area * std::max(0.0, -at.traction);
      const Vector<dim> own = u.row(node).transpose();
      force += part;
      moved += part * (place.turn * own);
      x += part * place.of(assembly.mesh.nodes[static_cast<std::size_t>(node)] +
                           d.row(node).transpose() + own);
    }
    if (force > 0) moved /= force, x /= force;
  }
};

}  // namespace

template <int dim>
std::optional<MovedAxis> find_moved_axis(const WornBodyEquations<dim>& equations,
                                         const FieldValues<dim>& values,
                                         const std::vector<PhaseContact<dim>>& contacts) {
  const Assembly<dim>& assembly = equations.assembly();
  if (assembly.interface.rolling) return {};
  std::optional<MovedAxis> most;
  for (const MortarPair<dim>& pair : assembly.pairs)
    for (const int side : {0, 1}) {
      const std::set<int> nodes = nodes_of_facets(side == 0 ? pair.slave : pair.master);
      double fast = 0, sliding = 0, way = 0;
      for (std::size_t p = 0; p < contacts.size(); ++p) {
        const Phase<dim>& phase = equations.phases()[p];
        const PairPlaces<dim> places(pair, phase.places);
        const Tensor<dim> spin = phase.places.empty()
                                     ? pair.spins[static_cast<std::size_t>(side)]
                                     : places.of[static_cast<std::size_t>(side)].motion.spin;
        const MeanOfSide<dim> mean(assembly, nodes, places.of[static_cast<std::size_t>(side)],
                                   values.vector(equations.fields(p).d),
                                   values.vector(equations.fields(p).u), contacts[p].nodes);
        const Vector<dim> v = places.motion.at(mean.x), wrong = spin * mean.moved;
        const double weight = contacts[p].weight * mean.force;
        const double across = places.motion.across_at(mean.x);
        const double speed = std::hypot(v.norm(), across);
        // The first body's velocity is subtracted.
        const Vector<dim> right = v - (side == 0 ? -1.0 : 1.0) * wrong;
        sliding += weight * speed;
        fast += weight * (speed - std::hypot(right.norm(), across));
        if (!spin.isZero(0)) way = std::max(way, mean.moved.norm());
      }
      if (way == 0 || sliding == 0) continue;
      if (const double part = fast / sliding; !most || std::abs(part) > std::abs(most->part))
        most = MovedAxis{
            assembly.bodies[static_cast<std::size_t>(pair.numbers[static_cast<std::size_t>(side)])]
                .name,
            way, part};
    }
  return most;
}

template std::optional<MovedAxis> find_moved_axis(const WornBodyEquations<2>&,
                                                  const FieldValues<2>&,
                                                  const std::vector<PhaseContact<2>>&);
template std::optional<MovedAxis> find_moved_axis(const WornBodyEquations<3>&,
                                                  const FieldValues<3>&,
                                                  const std::vector<PhaseContact<3>>&);

}  // namespace gnomon
