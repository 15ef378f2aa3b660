// The phases of a scene with [cycle].
#pragma once

#include <functional>
#include <gnomon/laws/cycle.hpp>
#include <gnomon/model/worn_body.hpp>
#include <gnomon/scene/scene.hpp>
#include <memory>
#include <optional>
#include <vector>

namespace gnomon::part {

/// [cycle] for a body: its functions, and the axis of cycle.rotation.
template <int dim>
struct PartCycle {
  Cycle cycle;
  CycleAxis<dim> axis;
};

/// Nothing without a cycle. With cycle.force, the largest force becomes body.counter_force. Throws
/// InputError where the cycle contradicts the counter-body, whose shape and press the body has.
template <int dim>
std::optional<PartCycle<dim>> read_part_cycle(const Scene& scene, WornBody<dim>& body);

/// The counter-body at several positions of the cycle; without a cycle where it is.
template <int dim>
std::vector<CounterBody<dim>> instants(const WornBody<dim>& body,
                                       const std::optional<PartCycle<dim>>& cycle);

/// Fills in body.cycle and .refined_cycle: the phases of cycle.phases. Kinks are those of the
/// functions, and where the counter-body comes to rest at the reference of its motion. Throws
/// InputError.
template <int dim>
void make_phases(const Scene& scene, const PartCycle<dim>& cycle, WornBody<dim>& body);

/// The body `with` a number of phases that fits the tolerance of the scene (phase_tolerance()) at
/// the initial shape; a remark says which. Where the deformation is not found, the fewest.
template <int dim>
std::shared_ptr<WornBody<dim>> with_chosen_phases(
    const Scene& scene, const std::function<std::shared_ptr<WornBody<dim>>(long phases)>& with);

/// Refuses a motion to and fro that is shorter than the elastic shear of the contact: part of the
/// contact would stick, which depends on the path within the cycle. By Mindlin's formula for round
/// bodies (K. L. Johnson, Contact Mechanics, eq. 7.43); `body` has its scales. Throws InputError.
template <int dim>
void require_gross_sliding(const Scene& scene, const PartCycle<dim>& cycle,
                           const WornBody<dim>& body);

}  // namespace gnomon::part
