// Bodies of pairs that have places over a cycle: [cycle] and motion.#.cycle.
#pragma once

#include <gnomon/model/assembly.hpp>
#include <gnomon/scene/scene.hpp>
#include <map>
#include <string>
#include <vector>

namespace gnomon::part {

/// Gives the parts, whose pairs are known but for their facets, the motions of their bodies over
/// the cycle of the scene, if it has one. Throws InputError.
template <int dim>
void read_cycle_of_bodies(const Scene& scene, const std::map<std::string, BodyCycle<dim>>& motions,
                          AssemblyParts<dim>& parts);

/// The phases of that cycle: divided where bodies that slide reverse, judged by the first pair.
template <int dim>
void read_phases_of_pairs(const Scene& scene, AssemblyParts<dim>& parts);

/// Where the bodies are: at the phases, if they are known, and at many positions between them; once
/// at rest without a cycle.
template <int dim>
std::vector<std::vector<BodyPlace<dim>>> places_over_cycle(const AssemblyParts<dim>& parts);

/// Without the phases, and at so many positions that no body is moved by more than about half of
/// the smallest one from one to the next, or at the most that is worth while.
template <int dim>
std::vector<std::vector<BodyPlace<dim>>> close_places_over_cycle(const AssemblyParts<dim>& parts);

/// The speed at which a pair slides where it first touches, its mean over the cycle: that of
/// nominal_speed(), where the scene gives none [length / time].
template <int dim>
double mean_sliding_speed(const AssemblyParts<dim>& parts, const MortarPair<dim>& pair);

}  // namespace gnomon::part
