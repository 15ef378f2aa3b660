#include "model/across_contact.hpp"

#include <algorithm>
#include <cmath>
#include <gnomon/base/processes.hpp>
#include <limits>

namespace gnomon {

namespace {

/// Of one of two bodies that touch, by the force that presses there.
template <int dim>
class Normals {
public:
  void add(const Vector<dim>& normal, double force) {
    sum_ += force * normal;
    whole_ += force;
  }
  void add_processes() {
    for (int i = 0; i < dim; ++i) sum_[i] = sum_over_processes(sum_[i]);
    whole_ = sum_over_processes(whole_);
  }
  /// One less the cosine of the root mean square angle to mean(): of a plane zero.
  double spread() const { return sum_.isZero(0) ? 1 : std::max(0.0, 1 - sum_.norm() / whole_); }
  /// Unit.
  Vector<dim> mean() const { return sum_.normalized(); }

private:
  Vector<dim> sum_ = Vector<dim>::Zero();
  double whole_ = 0;
};

/// Of facets that touch with all their nodes: averages at the nodes of an edge point elsewhere.
template <int dim>
Normals<dim> normals_of(const Assembly<dim>& assembly,
                        const std::vector<typename Mesh<dim>::Facet>& facets,
                        const std::vector<PhaseContact<dim>>& phases) {
  Normals<dim> result;
  for (const auto& facet : facets) {
    double pressed = 0;
    for (const PhaseContact<dim>& phase : phases) {
      double least = std::numeric_limits<double>::infinity();
      for (const int node : facet) {
        const auto c = static_cast<std::size_t>(assembly.contact_node(node));
        least = std::min(least, phase.nodes[c].active ? phase.nodes[c].force.norm() : 0);
      }
      pressed += least;
    }
    if (pressed > 0) result.add(facet_normal<dim>(facet, assembly.mesh.nodes), pressed);
  }
  result.add_processes();
  return result;
}

/// Of the counter-body.
template <int dim>
Normals<dim> normals_of_partner(const std::vector<PhaseContact<dim>>& phases) {
  Normals<dim> result;
  for (const PhaseContact<dim>& phase : phases)
    for (const ContactNode<dim>& node : phase.nodes)
      if (node.active) result.add(node.normal, node.force.norm());
  result.add_processes();
  return result;
}

}  // namespace

template <int dim>
Vector<dim> across_contact(const Assembly<dim>& assembly,
                           const std::vector<PhaseContact<dim>>& phases) {
  constexpr double clear = 4;  // of the spread: twice the root mean square angle
  const bool pair = !assembly.pairs.empty();
  const Vector<dim>& approach =
      pair ? assembly.pairs.front().approach : assembly.interface.partner.approach;
  const Normals<dim> own = normals_of(
      assembly, pair ? assembly.pairs.front().slave : facets_of(assembly.interface.surfaces),
      phases);
  const Normals<dim> others = pair ? normals_of(assembly, assembly.pairs.front().master, phases)
                                   : normals_of_partner(phases);
  const Normals<dim>& flatter = own.spread() < others.spread() ? own : others;
  const bool inclined = 1 - std::abs(flatter.mean().dot(approach)) > clear * flatter.spread();
  return inclined ? flatter.mean() : approach;
}

template Vector<2> across_contact(const Assembly<2>&, const std::vector<PhaseContact<2>>&);
template Vector<3> across_contact(const Assembly<3>&, const std::vector<PhaseContact<3>>&);

}  // namespace gnomon
