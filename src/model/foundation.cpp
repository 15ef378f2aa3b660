#include "model/foundation.hpp"

#include <algorithm>
#include <cmath>
#include <gnomon/terms/mortar_node.hpp>
#include <limits>

#include "mesh/crossing.hpp"
#include "mesh/facet_bins.hpp"

namespace gnomon {

double FoundationLaw::pressure(double overlap) const {
  const double at = overlap / smooth;
  return stiffness * smooth * (at > 0 ? at + std::log1p(std::exp(-at)) : std::log1p(std::exp(at)));
}

template <int dim>
Foundation<dim>::Foundation(const AssemblyParts<dim>& parts,
                            const std::vector<RigidPart<dim>>& rigid, std::vector<Vector<dim>> x,
                            const std::vector<BodyPlace<dim>>& places)
    : parts_(parts), rigid_(rigid), x_(std::move(x)), now_(x_), part_of_(x_.size(), 0) {
  constexpr double part_of_size = 0.05;
  touches_.assign(rigid.size(), 0);
  margin_ = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < rigid.size(); ++k) {
    for (const int node : rigid[k].nodes) part_of_[node] = k;
    margin_ = std::min(margin_, part_of_size * rigid[k].size);
  }
  double sum = 0, facets = 0;
  for (const MortarPair<dim>& pair : parts.pairs)
    for (const bool slave : {true, false}) {
      const auto& own = slave ? pair.slave : pair.master;
      const auto& other = slave ? pair.master : pair.slave;
      if (own.empty() || other.empty()) continue;
      const PairPlaces<dim> place(pair, places);
      const std::size_t part = part_of_[own.front()[0]];
      touches_[part] = 1;
      for (const auto& facet : own) {
        sum += (x_[facet[1]] - x_[facet[0]]).norm();
        for (const int node : facet)
          largest_facet_ = std::max(largest_facet_, (x_[node] - x_[facet[0]]).norm());
      }
      facets += static_cast<double>(own.size());
      sides_.push_back({.part = part,
                        .other = part_of_[other.front()[0]],
                        .patches = contact_patches<dim>(parts.mesh, own, {}, parts.section()),
                        .targets = other,
                        .normals = {},
                        .near = {},
                        .motion = place.motion,
                        .friction = pair.friction,
                        .slave = slave});
      for (ContactPatch<dim>& patch : sides_.back().patches)
        patch.initial_normal = (place.of[slave ? 0 : 1].turn * patch.initial_normal).eval();
      for (const auto& patch : contact_patches<dim>(parts.mesh, other, {}, parts.section()))
        sides_.back().normals[patch.node] = place.of[slave ? 1 : 0].turn * patch.initial_normal;
    }
  facet_size_ = facets > 0 ? sum / facets : 0;
  if (facets > 0) margin_ = std::min(margin_, facet_size_);
  for (const Load<dim>& load : parts.loads)
    pressed_.push_back(load.forces.size() > 0
                           ? std::vector<ContactPatch<dim>>()
                           : contact_patches<dim>(parts.mesh, load.facets, {}, parts.section()));
  for (std::size_t k = 0; k < parts.loads.size(); ++k) {
    const Load<dim>& load = parts.loads[k];
    double whole = load.forces.size() > 0 ? load.forces.rowwise().norm().sum() : 0;
    for (const ContactPatch<dim>& patch : pressed_[k])
      whole += std::abs(load.pressure) * patch.initial_area;
    largest_load_ += load.history.largest() * whole;
  }
  if (springs_hold(parts) == SpringsHold::yes) return;
  for (const SpringSupport<dim>& springs : parts.supports.springs) {
    sprung_.push_back(contact_patches<dim>(parts.mesh, springs.facets, {}, parts.section()));
    largest_load_ += springs.history.largest() * pull_of(springs, parts).rowwise().norm().sum();
  }
}

template <int dim>
void Foundation<dim>::add_force(std::size_t part, const Vector<dim>& x, const Vector<dim>& force,
                                std::vector<Twist<dim>>& forces) const {
  forces[part] +=
      rigid_velocities<dim>(x, rigid_[part].centre, rigid_[part].size).transpose() * force;
}

template <int dim>
std::vector<Twist<dim>> Foundation<dim>::loads(const std::vector<Pose<dim>>& poses,
                                               LoadTime at) const {
  std::vector<Twist<dim>> forces(rigid_.size(), Twist<dim>::Zero());
  for (std::size_t k = 0; k < parts_.loads.size(); ++k) {
    const Load<dim>& load = parts_.loads[k];
    const double factor = load.history.factor(at.t, at.within);
    for (Eigen::Index node = 0; node < load.forces.rows(); ++node)
      if (!load.forces.row(node).isZero(0)) {
        const std::size_t part = part_of_[static_cast<std::size_t>(node)];
        add_force(part, poses[part] * x_[static_cast<std::size_t>(node)],
                  factor * load.forces.row(node).transpose(), forces);
      }
    for (const ContactPatch<dim>& patch : pressed_[k]) {
      const std::size_t part = part_of_[patch.node];
      add_force(part, poses[part] * x_[patch.node],
                poses[part].linear() * patch.initial_normal *
                    (-factor * load.pressure * patch.initial_area),
                forces);
    }
  }
  add_springs(poses, at, forces);
  return forces;
}

template <int dim>
void Foundation<dim>::add_springs(const std::vector<Pose<dim>>& poses, LoadTime at,
                                  std::vector<Twist<dim>>& forces) const {
  for (std::size_t k = 0; k < sprung_.size(); ++k) {
    const SpringSupport<dim>& springs = parts_.supports.springs[k];
    const Vector<dim> ends = springs.history.factor(at.t, at.within) * springs.displacement;
    for (const ContactPatch<dim>& patch : sprung_[k]) {
      const std::size_t part = part_of_[patch.node];
      const Vector<dim> x = poses[part] * x_[patch.node], moved = x - parts_.mesh.nodes[patch.node];
      add_force(part, x, patch.initial_area * springs.stiffness.cwiseProduct(ends - moved), forces);
    }
  }
}

template <int dim>
bool Foundation<dim>::has_moved(const std::vector<Pose<dim>>& poses) const {
  if (found_at_.empty()) return true;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const Vector<dim> shift = poses[k] * rigid_[k].centre - found_at_[k] * rigid_[k].centre;
    const double turn = (poses[k].linear() - found_at_[k].linear()).norm();
    if (shift.norm() + turn * rigid_[k].size > margin_) return true;
  }
  return false;
}

template <int dim>
void Foundation<dim>::find_near(const std::vector<Pose<dim>>& poses) {
  constexpr double reach = std::numeric_limits<double>::infinity();
  const double around = 4 * margin_ + largest_facet_;
  for (Side& side : sides_) {
    const FacetBins<dim> bins(side.targets, now_);
    side.near.clear();
    for (const ContactPatch<dim>& patch : side.patches)
      side.near.push_back(bins.near_line(
          now_[patch.node], poses[side.part].linear() * patch.initial_normal, reach, around));
  }
  found_at_ = poses;
}

/// Opposite has no weight where a share is below -1/2: outside of a simplex that is 5/2 as large.
/// Its middle is within a third of the radius of the facet's, its corners within four thirds.
template <int dim>
void Foundation<dim>::find_middles(Side& side) const {
  constexpr double times = 1.0 / 3 + 5.0 / 2 * 4 / 3;
  side.middles.clear();
  side.reaches.clear();
  for (const auto& facet : side.targets) {
    Vector<dim> middle = Vector<dim>::Zero();
    for (const int node : facet) middle += now_[node] / static_cast<double>(facet.size());
    double radius = 0;
    for (const int node : facet) radius = std::max(radius, (now_[node] - middle).norm());
    side.middles.push_back(middle);
    side.reaches.push_back(times * radius);
  }
}

template <int dim>
typename Foundation<dim>::Opposite Foundation<dim>::opposite(const Side& side, std::size_t p,
                                                             const Vector<dim>& n,
                                                             const Tensor<dim>& rotation) const {
  constexpr double facing = -0.2;  // cosine
  const double deepest = std::min(rigid_[side.part].size, rigid_[side.other].size) / 2;
  const Vector<dim>& from = now_[side.patches[p].node];
  Opposite best;
  for (const int f : side.near[p]) {
    const Vector<dim> to = side.middles[f] - from;
    if ((to - n * n.dot(to)).norm() > side.reaches[f]) continue;
    const auto& facet = side.targets[f];
    for (const auto& simplex : simplices<dim>(facet)) {
      const Crossing<dim> at(from, n, simplex, now_);
      const double weight = 1 - 2 * std::max(0.0, -at.shares.minCoeff());
      if (!(weight > 0) || at.distance < -deepest || weight < best.weight) continue;
      if (weight == best.weight && std::abs(at.distance) >= std::abs(best.distance)) continue;
      if (facet_normal<dim>(facet, now_).dot(n) > facing) continue;
      Vector<dim> normal = Vector<dim>::Zero();
      for (int k = 0; k < dim; ++k) normal += at.shares[k] * side.normals.at(simplex[k]);
      best = {weight, at.distance, rotation * normal};
    }
  }
  return best;
}

template <int dim>
void Foundation<dim>::add_side(const Side& side, const std::vector<Pose<dim>>& poses,
                               const FoundationLaw& law, std::vector<Twist<dim>>& forces) {
  for (std::size_t p = 0; p < side.patches.size(); ++p) {
    const ContactPatch<dim>& patch = side.patches[p];
    const Vector<dim> n = poses[side.part].linear() * patch.initial_normal;
    const Opposite at = opposite(side, p, n, poses[side.other].linear());
    if (at.weight == 0) continue;
    deepest_ = std::max(deepest_, -at.distance);
    // Each of two surfaces carries half of the pressure, between the normals of both.
    const double force = at.weight * law.pressure(-at.distance) * patch.initial_area / 2;
    const Vector<dim> out = side.slave ? Vector<dim>(n - at.normal) : Vector<dim>(at.normal - n);
    const Vector<dim> place = now_[patch.node] + at.distance / 2 * n;
    const Vector<dim> on_slave =
        force *
        SlidingTraction<dim>(patch, out.normalized(), place, side.motion, side.friction).direction;
    add_force(side.slave ? side.part : side.other, place, on_slave, forces);
    add_force(side.slave ? side.other : side.part, place, -on_slave, forces);
  }
}

template <int dim>
void Foundation<dim>::add_contact(const std::vector<Pose<dim>>& poses, const FoundationLaw& law,
                                  std::vector<Twist<dim>>& forces) {
  for (std::size_t node = 0; node < x_.size(); ++node)
    now_[node] = poses[part_of_[node]] * x_[node];
  if (has_moved(poses)) find_near(poses);
  deepest_ = 0;
  for (Side& side : sides_) {
    find_middles(side);
    add_side(side, poses, law, forces);
  }
}

template class Foundation<2>;
template class Foundation<3>;

}  // namespace gnomon
