// Contact of two surfaces that both deform and may both wear, as data.
#pragma once

#include <gnomon/mesh/mesh.hpp>
#include <gnomon/shapes/body_place.hpp>
#include <map>
#include <string>
#include <vector>

namespace gnomon {

template <int dim>
struct MortarPair {
  using Facet = typename Mesh<dim>::Facet;
  std::vector<Facet> slave;   ///< its nodes carry the multipliers
  std::vector<Facet> master;  ///< no node of the slave's
  /// All boundary of the slave's body and of the master's, of which these are parts.
  std::array<std::vector<Facet>, 2> boundary{};
  /// The direction in which the master comes near to the slave: unit.
  Vector<dim> approach = Vector<dim>::Unit(dim - 1);
  /// Of the master's material relative to the slave's, v^2 - F V of eq. (6), where the bodies are
  /// at rest; those that have a place in a phase of a cycle have their motion there.
  RigidMotion<dim> motion{};
  /// Of the slave's and of the master's material about fixed points, in the steady motion.
  std::array<Tensor<dim>, 2> spins = {Tensor<dim>::Zero(), Tensor<dim>::Zero()};
  double friction = 0;
  double slides = 1;  ///< its sliding distance, by that of all (nominal_speed())
  double reach = 0;   ///< facets that are farther apart do not meet [length]
  /// How deep bodies that supports hold lie in each other at rest: a load ramp begins where they
  /// touch [length].
  double interference = 0;
  std::array<std::string, 2> bodies{};  ///< names of the slave and of the master
  std::array<int, 2> numbers{};         ///< of them among the bodies
  /// Steady, of the slave's material and of the master's; read where they roll [length / time].
  std::array<Vector<dim>, 2> velocities = {Vector<dim>::Zero(), Vector<dim>::Zero()};
  /// By node of the slave: the projector on the directions in which its normal may point, where
  /// supports, as of a symmetry, leave it fewer than all.
  std::map<int, Tensor<dim>> along{};
};

/// Of the slave and of the master of a pair, in a phase.
template <int dim>
struct PairPlaces {
  std::array<BodyPlace<dim>, 2> of{};
  RigidMotion<dim> motion{};  ///< of the master's material relative to the slave's

  /// `bodies`: the places of all bodies; empty: they are at rest.
  PairPlaces(const MortarPair<dim>& pair, const std::vector<BodyPlace<dim>>& bodies);
};

/// Moves nodes of the pairs' boundaries to where they are in a phase; `x`: in the frames of the
/// bodies.
template <int dim>
std::vector<Vector<dim>> in_space(const std::vector<MortarPair<dim>>& pairs,
                                  const std::vector<BodyPlace<dim>>& places,
                                  std::vector<Vector<dim>> x);

/// The outward normal at the centre of a facet, unit, nodes at `x`.
template <int dim>
Vector<dim> facet_normal(const typename Mesh<dim>::Facet& facet, const std::vector<Vector<dim>>& x);

/// By slave facet of a pair: the masters that may cover it, by their positions in `master`.
using MortarCandidates = std::vector<std::vector<int>>;
/// Those near to it where the nodes are at `x`, with a margin of a facet around.
template <int dim>
MortarCandidates mortar_candidates(const MortarPair<dim>& pair, const std::vector<Vector<dim>>& x);
/// By master facet of a pair, of those given, which of them may cover a slave facet at the same
/// time, wherever the bodies are; nodes at `x` in the frames of the bodies.
template <int dim>
std::vector<std::vector<int>> masters_beside(const MortarPair<dim>& pair,
                                             const typename Mesh<dim>::Facet& slave,
                                             const std::vector<int>& masters,
                                             const std::vector<Vector<dim>>& x);
/// Whether the surfaces have moved relative to each other, from `near` to `x`, by no more than this
/// part of the margin of candidates.
template <int dim>
bool is_within_margin(const MortarPair<dim>& pair, const std::vector<Vector<dim>>& near,
                      const std::vector<Vector<dim>>& x, double part);

}  // namespace gnomon
