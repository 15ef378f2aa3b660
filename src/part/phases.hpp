// The phases of a scene with [cycle], and whether the bodies slide over a whole cycle.
#pragma once

#include <functional>
#include <gnomon/base/error.hpp>
#include <gnomon/model/assembly.hpp>

#include "part/part_cycle.hpp"

namespace gnomon::part {

template <int dim>
struct ReadPhases {
  CyclicContact<dim> contact;
  std::vector<Phase<dim>> phases;
  std::vector<std::string> remarks;  ///< also where the phases miss the mean of speed or force
};

/// Where the speed at the reference of the motion is zero and changes its sign, |v| has a kink.
template <int dim>
std::vector<double> reversals(const CyclicMotion<dim>& motion, const CounterBody<dim>& rest);

/// The phases of cycle.phases. Kinks are those of the functions, where the counter-body comes to
/// rest at the reference of its motion, and `others` apart from these. Throws InputError.
template <int dim>
ReadPhases<dim> read_phases(const Scene& scene, const CyclicMotion<dim>& motion,
                            const CounterBody<dim>& rest, std::optional<double> force,
                            const std::vector<double>& others = {});

/// Refuses phases in which nothing presses a counter-body that a force presses at `largest`, by
/// cycle.force or the table `press`.
template <int dim>
void require_forces(const Scene& scene, const std::vector<Phase<dim>>& phases,
                    const std::string& press, std::optional<double> largest);

/// Nothing presses the bodies on each other: in other phases something may.
struct NothingPresses : InputError {
  using InputError::InputError;
};

/// The parts `with` a number of phases that fits the tolerance of the scene (phase_tolerance()) at
/// the initial shape; a remark says which. Where the deformation is not found, the fewest in some
/// of which bodies press on each other.
template <int dim>
AssemblyParts<dim> with_chosen_phases(const Scene& scene,
                                      const std::function<AssemblyParts<dim>(long phases)>& with);

/// The velocity with which the counter-body's surface slides at the reference of its motion, at a
/// position of the cycle; the component out of the plane last [length / time].
template <int dim>
Eigen::Matrix<double, dim + 1, 1> surface_velocity(const CyclicMotion<dim>& motion,
                                                   const CounterBody<dim>& rest, double tau);

/// Its magnitude, the mean over the cycle.
template <int dim>
double mean_speed(const CyclicMotion<dim>& motion, const CounterBody<dim>& rest);

/// Refuses a motion whose strokes are shorter than the elastic shear of the contact: part of the
/// contact would stick, which depends on the path within the cycle. By Mindlin's formula for round
/// bodies (K. L. Johnson, Contact Mechanics, eq. 7.43); `parts` have their scales. Short strokes
/// that are less than a twentieth of the path are let pass. Throws InputError.
template <int dim>
void require_gross_sliding(const Scene& scene, const CyclicMotion<dim>& cycle,
                           const AssemblyParts<dim>& parts);

}  // namespace gnomon::part
