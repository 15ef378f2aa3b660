// Scenes with friction that may stick (docs/fretting.md): the path of their cycle.
#pragma once

#include <gnomon/model/magnitudes.hpp>
#include <gnomon/scene/scene.hpp>

#include "part/phases.hpp"

namespace gnomon::part {

/// The phases of a path: as many as cycle.phases asks for, and all extremes of motion and loads.
/// Throws InputError where the cycle has what a path cannot follow.
template <int dim>
ReadPhases<dim> read_path(const Scene& scene, const CyclicMotion<dim>& motion,
                          const CounterBody<dim>& rest, std::optional<double> force);

/// The parts `with` a number of phases that fits the tolerance of the scene at the initial shape,
/// each compared with twice as many; a remark says which. Throws SolutionError.
template <int dim>
AssemblyParts<dim> with_chosen_path(const Scene& scene,
                                    const std::function<AssemblyParts<dim>(long phases)>& with);

/// The speed that scales are made with: where bodies slide over less than the elastic shear of the
/// contact, that of the shear, and so that what wears is no deeper than they are pressed in
/// [length / time]. `parts` have the speed of the motion; `expected`: with it.
template <int dim>
double speed_on_path(const Scene& scene, const AssemblyParts<dim>& parts,
                     const Magnitudes& expected);

/// Whether the memory of slip is an algebraic unknown, as explicit methods need it.
bool memory_follows(const Scene& scene);

/// Throws InputError where a rate or the friction reads the sliding distance.
void require_no_distance(const Scene& scene);

/// Throws InputError where parts with friction that may stick have what it does not go with.
template <int dim>
void require_path(const Scene& scene, const AssemblyParts<dim>& parts);

}  // namespace gnomon::part
