// The phases of a scene with [cycle].
#pragma once

#include <functional>
#include <memory>

#include "part_cycle.hpp"

namespace gnomon::part {

/// Fills in body.cycle and .phase_set: the phases of cycle.phases. Kinks are those of the
/// functions, and where the counter-body comes to rest at the reference of its motion. A remark
/// where the phases miss the mean of speed or force. Throws InputError.
template <int dim>
void make_phases(const Scene& scene, const PartCycle<dim>& cycle, WornBody<dim>& body);

/// The body `with` a number of phases that fits the tolerance of the scene (phase_tolerance()) at
/// the initial shape; a remark says which. Where the deformation is not found, the fewest.
template <int dim>
std::shared_ptr<WornBody<dim>> with_chosen_phases(
    const Scene& scene, const std::function<std::shared_ptr<WornBody<dim>>(long phases)>& with);

/// The velocity with which the counter-body's surface slides at the reference of its motion, at a
/// position of the cycle; the component out of the plane last [length / time].
template <int dim>
Eigen::Matrix<double, dim + 1, 1> surface_velocity(const PartCycle<dim>& part,
                                                   const WornBody<dim>& body, double tau);

/// Its magnitude, the mean over the cycle.
template <int dim>
double mean_speed(const PartCycle<dim>& part, const WornBody<dim>& body);

}  // namespace gnomon::part
