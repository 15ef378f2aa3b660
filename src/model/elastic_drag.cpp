#include "model/elastic_drag.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "mesh/facet_table.hpp"

namespace gnomon {

namespace {

/// From one end of the cycle's sliding to the other; absent where it does not come back.
template <int dim>
std::optional<double> stroke_of(const std::vector<Phase<dim>>& phases, double period) {
  constexpr double rounding = 1e-6;
  using Place = Eigen::Matrix<double, dim + 1, 1>;
  Place at = Place::Zero(), low = at, high = at;
  double path = 0;
  for (const Phase<dim>& phase : phases) {
    const Place step = phase.weight * period * sliding_velocity(phase);
    at += step;
    path += step.norm();
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  if (path == 0 || at.norm() > rounding * path) return {};
  return (high - low).norm();
}

/// By contact node: the first of the pairs that has it.
template <int dim>
std::vector<const MortarPair<dim>*> pairs_of_nodes(const Assembly<dim>& assembly) {
  std::vector<const MortarPair<dim>*> result(assembly.contact_nodes.size(), nullptr);
  for (const MortarPair<dim>& pair : assembly.pairs)
    for (const auto* facets : {&pair.slave, &pair.master})
      for (const int node : nodes_of_facets(*facets)) {
        auto& of = result[static_cast<std::size_t>(assembly.contact_node(node))];
        if (!of) of = &pair;
      }
  return result;
}

/// Of a node in a phase.
template <int dim>
struct Dragged {
  double weight;
  Vector<dim> moved;    ///< u along the surface [length]
  Vector<dim> sliding;  ///< how fast its partner slides [length / time]
};

/// The mean displacement with the sliding. What only keeps to a place, as of a body that follows an
/// inclined surface, has none: it takes back what it does.
template <int dim>
double mean_drag(const std::vector<Dragged<dim>>& phases) {
  double whole = 0;
  Vector<dim> mean = Vector<dim>::Zero();
  for (const Dragged<dim>& at : phases) whole += at.weight, mean += at.weight * at.sliding;
  if (whole == 0) return 0;
  mean /= whole;
  double with = 0, path = 0;
  for (const Dragged<dim>& at : phases) {
    with += at.weight * at.moved.dot(at.sliding - mean);
    path += at.weight * (at.sliding - mean).norm();
  }
  return path > 0 ? std::abs(with) / path : 0;
}

}  // namespace

template <int dim>
std::optional<ElasticDrag> find_drag(const WornBodyEquations<dim>& equations,
                                     const FieldValues<dim>& values,
                                     const std::vector<PhaseContact<dim>>& contacts) {
  const Assembly<dim>& assembly = equations.assembly();
  if (!assembly.cycle || assembly.interface.friction == 0 || assembly.interface.sticks) return {};
  const auto stroke = stroke_of(equations.phases(), assembly.cycle->motion.cycle.period);
  if (!stroke) return {};
  const std::vector<const MortarPair<dim>*> pairs = pairs_of_nodes(assembly);
  std::vector<std::vector<Dragged<dim>>> of_node(pairs.size());
  std::vector<char> active(pairs.size());
  for (std::size_t p = 0; p < contacts.size(); ++p) {
    const std::vector<ContactNode<dim>>& nodes = contacts[p].nodes;
    if (std::ranges::none_of(nodes, &ContactNode<dim>::active)) continue;
    const Phase<dim>& phase = equations.phases()[p];
    std::map<const MortarPair<dim>*, RigidMotion<dim>> motions;
    for (const MortarPair<dim>& pair : assembly.pairs)
      motions.emplace(&pair, PairPlaces<dim>(pair, phase.places).motion);
    for (std::size_t c = 0; c < pairs.size(); ++c) {
      const ContactPatch<dim>& patch = assembly.contact_nodes[c];
      active[c] |= static_cast<char>(nodes[c].active);
      const Vector<dim> u = values.vector(equations.fields(p).u).row(patch.node).transpose();
      // Of a master there is none.
      const Vector<dim>& n = nodes[c].normal.isZero(0) ? patch.initial_normal : nodes[c].normal;
      const Vector<dim> sliding = pairs[c]
                                      ? motions.at(pairs[c]).at(patch.initial_position)
                                      : Vector<dim>(sliding_velocity(phase).template head<dim>());
      of_node[c].push_back({contacts[p].weight, u - n * n.dot(u), sliding});
    }
  }
  std::array<double, 2> drag = {0, 0};  // of those that carry a multiplier; of pairs of the others
  for (std::size_t c = 0; c < pairs.size(); ++c)
    if (double& of = drag[assembly.carries[c] ? 0 : 1]; active[c])
      of = std::max(of, 2 * mean_drag(of_node[c]));
  return ElasticDrag{.stroke = *stroke, .drag = drag[0] + drag[1]};
}

template std::optional<ElasticDrag> find_drag(const WornBodyEquations<2>&, const FieldValues<2>&,
                                              const std::vector<PhaseContact<2>>&);
template std::optional<ElasticDrag> find_drag(const WornBodyEquations<3>&, const FieldValues<3>&,
                                              const std::vector<PhaseContact<3>>&);

}  // namespace gnomon
