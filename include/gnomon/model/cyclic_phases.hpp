// The contact states of an assembly: the phases of a cycle, or the only one.
#pragma once

#include <gnomon/cycles/body_cycle.hpp>
#include <gnomon/cycles/cycle.hpp>
#include <gnomon/cycles/cycle_quadrature.hpp>
#include <gnomon/cycles/phase_mean.hpp>
#include <optional>
#include <vector>

namespace gnomon {

/// A contact state: one of the phases of a cycle, or the only one.
template <int dim>
struct Phase {
  double position = 0;      ///< tau, in the cycle
  double weight = 1;        ///< omega, part of the mean over the cycle
  double interval = 1;      ///< of a path: part of the cycle since the phase before
  double angle = 0;         ///< by which the counter-body has turned [rad]
  double angle_before = 0;  ///< of a path, in the phase before
  /// Where it is in this phase, and how it moves; of pairs: how the first one slides where
  /// CyclicMotion says.
  CounterBody<dim> counter_body{};
  /// The force that presses the counter-body along the first of its guides, at factor one of the
  /// history; without it the counter-body does not move there.
  std::optional<double> force{};
  double load = 1;                     ///< factor of the loads on the bodies
  double swing = 1;                    ///< of those with a factor of their own, beside it
  std::vector<BodyPlace<dim>> places;  ///< of the bodies of pairs; empty: they are at rest

  /// The force along each guide at factor one; nothing where the counter-body is not free.
  std::vector<std::optional<double>> forces() const {
    std::vector<std::optional<double>> result;
    for (const Guide<dim>& guide : counter_body.guides)
      result.push_back(result.empty() ? force : guide.force);
    return result;
  }
  bool moves_freely() const {
    return std::ranges::any_of(forces(), [](const auto& value) { return value.has_value(); });
  }
  /// Of a load, beside its history. `own`: Load::swing.
  double load_factor(const std::optional<CycleFunction>& own) const {
    return own ? swing * own->value(position) : load;
  }
};

/// What moves and loads the bodies over a cycle: its functions, and the axis of its rotation.
template <int dim>
struct CyclicMotion {
  Cycle cycle;
  CycleAxis<dim> axis;
  /// Factors of the forces along the guides of the counter-body; empty, or one for each guide.
  std::vector<std::optional<CycleFunction>> forces{};
  std::vector<BodyCycle<dim>> bodies{};  ///< all of them, where they meet each other in pairs
  /// Of pairs: a point of the first of these bodies, in its frame, where the other slides on it,
  /// and the normal of its surface there, unit.
  std::array<int, 2> sliding{};
  Vector<dim> point = Vector<dim>::Zero(), normal = Vector<dim>::Zero();
};

/// The cycle, and the positions at which the deformation is taken.
template <int dim>
struct CyclicContact {
  CyclicMotion<dim> motion;
  CycleQuadrature quadrature;
};

/// At one position; its motion is that of this instant. `rest`: the counter-body without the cycle;
/// `force`: what presses it, where the cycle does not say.
template <int dim>
Phase<dim> phase_at(const CyclePoint& point, const CyclicMotion<dim>& motion,
                    const CounterBody<dim>& rest, std::optional<double> force);

/// How far the counter-body's surface has slid by along X by a phase, from its place `rest`; of
/// pairs the surface of the second of the bodies `sliding`, in the frame of the first [length].
template <int dim>
Vector<dim> carried_by(const CyclicMotion<dim>& motion, const CounterBody<dim>& rest,
                       const Phase<dim>& phase, const Vector<dim>& X);
/// The same where they slide on each other: at motion.point of pairs, else where the counter-body
/// touches.
template <int dim>
Vector<dim> carried_by(const CyclicMotion<dim>& motion, const CounterBody<dim>& rest,
                       const Phase<dim>& phase);

/// The phases of a path at the ends of its intervals. In the mean over the cycle each stands for
/// half of the intervals on both sides, around the cycle.
template <int dim>
std::vector<Phase<dim>> path_phases(const std::vector<CyclePoint>& ends,
                                    const CyclicMotion<dim>& motion, const CounterBody<dim>& rest,
                                    std::optional<double> force);

/// The phases of a quadrature; where it has fewer points than parts, a phase stands for its
/// interval: it has the whole path, and the force and load with which it was made.
template <int dim>
std::vector<Phase<dim>> phases_of(const CyclicContact<dim>& cycle, const CounterBody<dim>& rest,
                                  std::optional<double> force, const PhaseSet& set = {});

/// The velocity with which the surface slides at the reference of the motion; the component out of
/// the plane last [length / time].
template <int dim>
Eigen::Matrix<double, dim + 1, 1> sliding_velocity(const Phase<dim>& phase) {
  return phase.counter_body.motion.sliding_velocity(Vector<dim>::Zero());
}

}  // namespace gnomon
