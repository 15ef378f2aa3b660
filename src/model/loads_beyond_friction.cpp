#include "model/loads_beyond_friction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/shapes/counter_surface.hpp>
#include <optional>
#include <vector>

#include "model/connected_parts.hpp"

namespace gnomon {

namespace {

/// The loads on the body of a node, where no support and no more than soft springs hold it [force].
/// `parts`: connected_parts().
template <int dim>
std::optional<Vector<dim>> load_on(const Assembly<dim>& body, const Phase<dim>& phase, double t,
                                   const std::vector<int>& parts, int on_side) {
  const auto is_own = [&](int node) {
    return parts[static_cast<std::size_t>(node)] == parts[static_cast<std::size_t>(on_side)];
  };
  for (int node = 0; node < static_cast<int>(parts.size()); ++node)
    for (int i = 0; i < dim; ++i)
      if (is_own(node) && body.supports.held(node, i)) return {};
  constexpr double little = 1e-3;  // of the load: springs that only keep a body in its place
  const double size = std::pow(Box<dim>::around(body.mesh.nodes).diagonal(), dim - 1);
  for (const SpringSupport<dim>& springs : body.supports.springs) {
    const double most = springs.stiffness.maxCoeff() * size * body.scales.displacement;
    for (const auto& facet : springs.facets)
      if (most > little * body.scales.force && is_own(facet[0])) return {};
  }
  Vector<dim> sum = Vector<dim>::Zero();
  for (const auto* loads : {&body.loads, &body.swinging_loads})
    for (const Load<dim>& load : *loads) {
      const NodalField<dim> forces = forces_of<dim>(load, body);
      const double factor = load.history.factor(t) * phase.load_factor(load.swing);
      for (int node = 0; node < forces.rows(); ++node)
        if (is_own(node)) sum += factor * forces.row(node).transpose();
    }
  return sum;
}

}  // namespace

template <int dim>
std::string loads_beyond_friction(const Assembly<dim>& body, const Phase<dim>& phase, double t) {
  if (body.pairs.size() != 1 || body.interface.friction_factor.varies()) return {};
  const MortarPair<dim>& pair = body.pairs.front();
  constexpr double hardly = 0.01;
  // What presses is not the loads alone.
  if (pair.interference > hardly * body.scales.displacement) return {};
  double least = 1;
  for (std::size_t c = 0; c < body.contact_nodes.size(); ++c)
    if (body.carries[c])
      least = std::min(
          least, std::abs(body.contact_nodes[c].initial_normal.normalized().dot(pair.approach)));
  const std::vector<int> parts = connected_parts(body.mesh);
  for (const int node : {pair.slave.front()[0], pair.master.front()[0]}) {
    const std::optional<Vector<dim>> load = load_on(body, phase, t, parts, node);
    if (!load) continue;
    const double across = load->dot(pair.approach), along = (*load - across * pair.approach).norm(),
                 holds = pair.friction * std::abs(across);
    if (along * least > holds)
      return fmt::format(
          "loads of {:.4g} along the contact are more than friction holds, f P = {:.4g}", along,
          holds);
  }
  return {};
}

template std::string loads_beyond_friction(const Assembly<2>&, const Phase<2>&, double);
template std::string loads_beyond_friction(const Assembly<3>&, const Phase<3>&, double);

}  // namespace gnomon
