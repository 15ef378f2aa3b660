#include <algorithm>
#include <gnomon/base/processes.hpp>

#include "model/resultants.hpp"

namespace gnomon {

namespace {

/// By mesh node.
template <int dim>
std::vector<char> closed_nodes(const Assembly<dim>& body,
                               const std::vector<ContactNode<dim>>& nodes) {
  std::vector<char> closed(body.mesh.nodes.size(), 0);
  for (std::size_t c = 0; c < nodes.size(); ++c)
    closed[static_cast<std::size_t>(body.contact_nodes[c].node)] = nodes[c].traction < 0;
  return closed;
}

}  // namespace

template <int dim>
ContactArea contact_area(const Assembly<dim>& body, const NodalField<dim>& d,
                         const std::vector<ContactNode<dim>>& nodes) {
  const std::vector<char> closed = closed_nodes(body, nodes);
  double area = 0, unknown = 0;
  for (std::size_t c = 0; c < nodes.size(); ++c) {
    if (!body.carries[c]) continue;
    const ContactPatch<dim>& patch = body.contact_nodes[c];
    PatchNodal<dim> X(static_cast<Eigen::Index>(patch.nodes.size()), dim);
    for (Eigen::Index p = 0; p < X.rows(); ++p)
      X.row(p) = body.mesh.nodes[patch.nodes[p]].transpose() + d.row(patch.nodes[p]);
    if (nodes[c].load > 0) area += nodes[c].share;
    for (const auto& corner : patch.corners) {
      const auto others = std::ranges::count_if(
          corner.nodes, [&](int p) { return closed[patch.nodes[p]] != closed[patch.node]; });
      if (others > 0)
        unknown += corner.share * corner_area_vector<dim, double>(corner, X).norm() / 2;
    }
  }
  return {sum_over_processes(area * body.copies), sum_over_processes(unknown * body.copies)};
}

template <int dim>
double wear_flux_of(const std::vector<PhaseContact<dim>>& phases, double copies) {
  double flux = 0;
  for (const auto& [weight, nodes] : phases)
    for (const ContactNode<dim>& node : nodes) flux += weight * copies * node.area * node.wear_rate;
  return sum_over_processes(flux);
}

template <int dim>
std::optional<EdgePressure> edge_pressure(const Assembly<dim>& body,
                                          const std::vector<PhaseContact<dim>>& phases) {
  double inside = 0, at_edge = 0;
  EdgePressure edge;
  for (const auto& [weight, nodes] : phases) {
    const std::vector<char> closed = closed_nodes(body, nodes);
    for (std::size_t c = 0; c < nodes.size(); ++c) {
      if (!body.carries[c]) continue;
      const double pressure = -nodes[c].traction;
      const ContactPatch<dim>& patch = body.contact_nodes[c];
      const bool within = std::ranges::all_of(patch.corners, [&](const auto& corner) {
        return std::ranges::all_of(corner.nodes, [&](int p) { return closed[patch.nodes[p]]; });
      });
      if (within) inside = std::max(inside, pressure);
      if (within || pressure <= at_edge) continue;
      at_edge = pressure;
      edge.position = point_in_space<dim>(body.mesh.nodes[patch.node]);
    }
  }
  if (inside == 0 || at_edge <= inside) return {};
  edge.pressure = at_edge;
  edge.inside = inside;
  return edge;
}

template double wear_flux_of(const std::vector<PhaseContact<2>>&, double);
template double wear_flux_of(const std::vector<PhaseContact<3>>&, double);
template ContactArea contact_area(const Assembly<2>&, const NodalField<2>&,
                                  const std::vector<ContactNode<2>>&);
template ContactArea contact_area(const Assembly<3>&, const NodalField<3>&,
                                  const std::vector<ContactNode<3>>&);
template std::optional<EdgePressure> edge_pressure(const Assembly<2>&,
                                                   const std::vector<PhaseContact<2>>&);
template std::optional<EdgePressure> edge_pressure(const Assembly<3>&,
                                                   const std::vector<PhaseContact<3>>&);

}  // namespace gnomon
