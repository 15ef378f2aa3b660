#include "model/across_contact.hpp"

#include <algorithm>
#include <cmath>
#include <gnomon/base/processes.hpp>
#include <limits>

namespace gnomon {

namespace {

/// Of one of two bodies that touch, by the forces that press there.
template <int dim>
class Normals {
public:
  /// Of a place: the sum of the normals there times the forces, and that of the forces.
  void add(const Vector<dim>& normals, double forces) {
    if (forces == 0) return;
    ++places_;
    sum_ += normals;
    whole_ += forces;
  }
  void add_processes() {
    for (int i = 0; i < dim; ++i) sum_[i] = sum_over_processes(sum_[i]);
    whole_ = sum_over_processes(whole_);
    places_ = sum_over_processes(places_);
  }
  /// One facet or node alone may be of a round body.
  bool are_of_a_plane() const {
    constexpr double rounding = 1e-8;
    return places_ > 1 && sum_.norm() > (1 - rounding) * whole_;
  }
  bool are_of_one_side() const {
    constexpr double one_side = 0.7;  // of half a circle 0.64
    return whole_ > 0 && sum_.norm() > one_side * whole_;
  }
  /// Unit.
  Vector<dim> mean() const { return sum_.normalized(); }

private:
  Vector<dim> sum_ = Vector<dim>::Zero();
  double whole_ = 0, places_ = 0;
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
    result.add(pressed * facet_normal<dim>(facet, assembly.mesh.nodes), pressed);
  }
  result.add_processes();
  return result;
}

/// Of the counter-body, where nodes meet it.
template <int dim>
Normals<dim> normals_of_partner(const std::vector<PhaseContact<dim>>& phases) {
  Normals<dim> result;
  for (std::size_t c = 0; c < phases.front().nodes.size(); ++c) {
    Vector<dim> sum = Vector<dim>::Zero();
    double forces = 0;
    for (const PhaseContact<dim>& phase : phases) {
      const ContactNode<dim>& node = phase.nodes[c];
      if (!node.active) continue;
      sum += node.force.norm() * node.normal;
      forces += node.force.norm();
    }
    result.add(sum, forces);
  }
  result.add_processes();
  return result;
}

}  // namespace

template <int dim>
Vector<dim> across_contact(const Assembly<dim>& assembly,
                           const std::vector<PhaseContact<dim>>& phases) {
  constexpr double along = 0.966;  // cosine of 15 degrees
  const bool pair = !assembly.pairs.empty();
  const Vector<dim>& approach =
      pair ? assembly.pairs.front().approach : assembly.interface.partner.approach;
  const Normals<dim> own = normals_of(
      assembly, pair ? assembly.pairs.front().slave : facets_of(assembly.interface.surfaces),
      phases);
  const Normals<dim> others = pair ? normals_of(assembly, assembly.pairs.front().master, phases)
                                   : normals_of_partner(phases);
  if (others.are_of_a_plane()) return others.mean();
  if (own.are_of_a_plane()) return own.mean();
  const bool inclined = own.are_of_one_side() && std::abs(own.mean().dot(approach)) < along;
  return inclined ? own.mean() : approach;
}

template Vector<2> across_contact(const Assembly<2>&, const std::vector<PhaseContact<2>>&);
template Vector<3> across_contact(const Assembly<3>&, const std::vector<PhaseContact<3>>&);

}  // namespace gnomon
