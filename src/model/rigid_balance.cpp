#include "model/rigid_balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <tuple>

#include "model/bring_together.hpp"
#include "model/settling.hpp"

namespace gnomon {

template <int dim>
bool supports_press(const AssemblyParts<dim>& parts) {
  return !parts.supports.moved.empty() || springs_hold(parts) == SpringsHold::no;
}

template <int dim>
bool wedged(const AssemblyParts<dim>& parts) {
  AssemblyParts<dim> left_alone = parts;  // friction would drag them
  left_alone.loads.clear();
  for (SpringSupport<dim>& springs : left_alone.supports.springs) springs.displacement.setZero();
  for (MortarPair<dim>& pair : left_alone.pairs) pair.friction = 0;
  return Settling<dim>(left_alone, parts.mesh.nodes, {}).is_wedged();
}

namespace {

/// Brings bodies to rest at the start, on softer foundations first: deep contact is wide on any
/// mesh, and says what rolls, whatever the foundation is; but what stands on a narrow surface may
/// fall over, and stands on stiffer ones. Returns the motion that nothing determines, or nothing,
/// and the depth of the softest foundation.
template <int dim>
std::pair<std::string, double> start(Settling<dim>& settling, const Scales& scales) {
  // As a load on a pendulum far longer than the bodies; what a foundation adds that is 4 times as
  // stiff, and facets of what rolls do not.
  constexpr double nearly = 0.03, firmer = 0.3;
  const double size = settling.size(), mesh = settling.facet_size();
  // Facets that are deep in each other do not face each other.
  const double least = std::min(scales.displacement, 2e-3 * size);
  double depth =
      std::max(least, std::min(0.1 * size, std::max(0.02 * size, 8 * mesh * mesh / size)));
  std::optional<double> before;  // stiffness of what is not yet determined
  for (double softest = 0;; depth = std::max(least, depth / 4)) {
    const bool last = depth <= least;
    if (!settling.settle(depth, scales.stress, {})) {
      if (softest > 0 || last) return {settling.last_motion(), softest};
      settling.begin_again();
      before.reset();
      continue;
    }
    if (softest == 0) {
      const auto [stiffness, motion] = settling.softest_motion(depth);
      const bool grows = !before || stiffness > *before + firmer;
      if (grows && stiffness > nearly)
        softest = depth;
      else if (last || !grows)
        return {motion, softest};
      before = stiffness;
    }
    if (last) return {"", softest};
  }
}

}  // namespace

template <int dim>
RigidBalance<dim>::RigidBalance(const AssemblyParts<dim>& parts,
                                const std::vector<BodyPlace<dim>>& places,
                                const std::vector<LoadTime>& times)
    : x(parts.mesh.nodes) {
  const Touching<dim> touching(parts, places);
  displacement = touching.displacement;
  direction = touching.direction;
  for (std::size_t node = 0; node < x.size(); ++node)
    x[node] += displacement.row(static_cast<Eigen::Index>(node)).transpose();
  if (parts.pairs.empty()) return;
  Settling<dim> settling(parts, in_space(parts.pairs, places, x), places);
  if (!settling.is_free(!places.empty()) || (!places.empty() && settling.frees_placed()) ||
      !settling.is_driven() || !parts.supports.moved.empty() ||
      (places.empty() && supports_press(parts)))
    return;
  double softest = 0;
  std::tie(doubt, softest) = start(settling, parts.scales);
  if (springs_hold(parts) == SpringsHold::no && !doubt.empty()) {
    doubt.clear();  // elastic bodies rest where the springs press them
    return;
  }
  if (!doubt.empty()) return;
  const std::vector<RigidPart<dim>>& rigid = settling.rigid();
  settled = true;
  const std::vector<NodalField<dim>> pressing = settling.pressing();
  for (std::size_t k = 0; k < rigid.size(); ++k) {
    if (rigid[k].loose.cols() == 0) continue;
    for (std::size_t n = 0; n < rigid[k].nodes.size(); ++n) {
      const int node = rigid[k].nodes[n];
      const Vector<dim> moved = settling.place(k, node);
      for (int i = 0; i < dim; ++i)
        if (!parts.supports.held(node, i)) {
          x[node][i] = moved[i];
          displacement(node, i) = moved[i] - parts.mesh.nodes[node][i];
          direction(node, i) = pressing[k](static_cast<Eigen::Index>(n), i);
        }
    }
  }
  for (const LoadTime& at : times)
    if (!settling.settle(softest, parts.scales.stress, at)) {
      doubt = fmt::format("at t = {:g} s {}", at.t, settling.last_motion());
      return;
    }
}

template bool supports_press(const AssemblyParts<2>&);
template bool supports_press(const AssemblyParts<3>&);
template bool wedged(const AssemblyParts<2>&);
template bool wedged(const AssemblyParts<3>&);
template struct RigidBalance<2>;
template struct RigidBalance<3>;

}  // namespace gnomon
