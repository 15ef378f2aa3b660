#include "model/intrusion.hpp"

#include <algorithm>
#include <array>
#include <gnomon/model/gap_motion.hpp>
#include <set>
#include <span>

#include "mesh/facet_table.hpp"
#include "model/facet_gaps.hpp"
#include "model/near_facets.hpp"

namespace gnomon {

namespace {

/// Points between the nodes of a facet, by the weights of its nodes in cyclic order.
template <int dim>
const std::vector<std::array<double, 1 << (dim - 1)>>& points_between() {
  static const auto points = [] {
    constexpr int parts = dim == 2 ? 8 : 4;
    std::vector<std::array<double, 1 << (dim - 1)>> made;
    for (int i = 1; i < parts; ++i) {
      const double a = double(i) / parts;
      if constexpr (dim == 2) {
        made.push_back({1 - a, a});
      } else {
        for (int j = 1; j < parts; ++j) {
          const double b = double(j) / parts;
          made.push_back({(1 - a) * (1 - b), a * (1 - b), a * b, (1 - a) * b});
        }
      }
    }
    return made;
  }();
  return points;
}

}  // namespace

template <int dim>
std::optional<BoundaryPoint> find_intrusion(const WornBodyEquations<dim>& equations,
                                            const FieldValues<dim>& values, double t,
                                            const std::vector<PhaseContact<dim>>& contacts) {
  // Part of a facet by which a smooth counter-body that its nodes resolve lies between them.
  constexpr double resolved = 0.02;
  const Assembly<dim>& assembly = equations.assembly();
  std::set<int> nodes = nodes_of_facets(assembly.interface.boundary);
  for (const ContactPatch<dim>& patch : assembly.contact_nodes) nodes.erase(patch.node);
  std::optional<BoundaryPoint> deepest;
  for (std::size_t p = 0; p < equations.phases().size(); ++p) {
    const WornBodyFields& fields = equations.fields(p);
    const CounterBody<dim>& other = equations.phases()[p].counter_body;
    const PartnerMotion<> q = equations.partner_motion(values, t, p);
    const auto look = [&](std::span<const int> at, std::span<const double> weights, double least) {
      Vector<dim> initial = Vector<dim>::Zero(), x = initial;
      for (std::size_t a = 0; a < at.size(); ++a) {
        initial += weights[a] * assembly.mesh.nodes[at[a]];
        x += weights[a] *
             (values.vector(fields.d).row(at[a]) + values.vector(fields.u).row(at[a])).transpose();
      }
      const double gap = other.unchecked_distance(initial + x, q, t).gap;
      if (gap < -std::max(least, deepest ? deepest->depth : 0))
        deepest = BoundaryPoint{point_in_space<dim>(initial), -gap};
    };
    for (const int node : nodes)
      if (!is_worn_away(assembly, values.vector(fields.d), assembly.mesh.nodes[node]))
        look(std::array{node}, std::array{1.0}, 0);
    if (std::ranges::any_of(contacts[p].nodes, &ContactNode<dim>::active)) continue;
    for (const auto& facet : facets_of(assembly.interface.surfaces))
      for (const auto& weights : points_between<dim>())
        look(facet, weights,
             resolved * (assembly.mesh.nodes[facet[1]] - assembly.mesh.nodes[facet[0]]).norm());
  }
  return deepest;
}

template <int dim>
std::optional<BoundaryPoint> find_intrusion_of_pairs(const WornBodyEquations<dim>& equations,
                                                     const FieldValues<dim>& values) {
  const Assembly<dim>& assembly = equations.assembly();
  // Facets that face away from each other are farther behind each other.
  constexpr double many = 20, thin = 0.01;
  const double far = std::min(many * assembly.scales.displacement,
                              thin * Box<dim>::around(assembly.mesh.nodes).diagonal());
  std::set<typename Mesh<dim>::Facet> meeting;  // in any pair
  for (const MortarPair<dim>& pair : assembly.pairs)
    for (const auto* side : {&pair.slave, &pair.master})
      for (const auto& facet : *side) meeting.insert(sorted(facet));
  std::optional<BoundaryPoint> deepest;
  for (std::size_t p = 0; p < equations.phases().size(); ++p) {
    const WornBodyFields& fields = equations.fields(p);
    const auto x =
        in_space(assembly.pairs, equations.phases()[p].places,
                 deformed(assembly.mesh, values.vector(fields.d), values.vector(fields.u)));
    for (const MortarPair<dim>& pair : assembly.pairs) {
      if (pair.numbers[0] == pair.numbers[1]) continue;  // a lip may be as thin
      const FacetGaps gaps =
          facet_gaps<dim>(pair.boundary[0], pair.boundary[1], x, assembly.section(), {-far, 0});
      for (const std::size_t side : {0, 1})
        for (std::size_t f = 0; f < pair.boundary[side].size(); ++f)
          if (const auto& facet = pair.boundary[side][f];
              gaps[side][f] < (deepest ? -deepest->depth : 0) && !meeting.contains(sorted(facet)))
            deepest =
                BoundaryPoint{point_in_space<dim>(assembly.mesh.nodes[facet[0]]), -gaps[side][f]};
    }
  }
  return deepest;
}

template std::optional<BoundaryPoint> find_intrusion_of_pairs(const WornBodyEquations<2>&,
                                                              const FieldValues<2>&);
template std::optional<BoundaryPoint> find_intrusion_of_pairs(const WornBodyEquations<3>&,
                                                              const FieldValues<3>&);
template std::optional<BoundaryPoint> find_intrusion(const WornBodyEquations<2>&,
                                                     const FieldValues<2>&, double,
                                                     const std::vector<PhaseContact<2>>&);
template std::optional<BoundaryPoint> find_intrusion(const WornBodyEquations<3>&,
                                                     const FieldValues<3>&, double,
                                                     const std::vector<PhaseContact<3>>&);

}  // namespace gnomon
