// What [cycle] says for a part: its functions, and the counter-body at a position.
#pragma once

#include <gnomon/model/cyclic_phases.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/shapes/counter_body_scene.hpp>
#include <optional>
#include <vector>

namespace gnomon::part {

/// Positions at which a cycle is looked at before its phases are known.
inline constexpr int samples = 64;

/// Nothing without a cycle. Throws InputError where it contradicts the counter-body.
template <int dim>
std::optional<CyclicMotion<dim>> read_part_cycle(const Scene& scene, const CounterBody<dim>& other);

/// Displacements of an axisymmetric scene along its coordinates (r, z). Throws InputError where
/// PREFIXx or PREFIXy gives another one than along the axis.
void put_in_meridian(const Scene& scene, const std::string& prefix, Cycle& cycle);

/// The largest force of cycle.force; nothing without it.
std::optional<double> largest_force(const Cycle& cycle);

/// The counter-body at several positions of the cycle; without a cycle where it is.
template <int dim>
std::vector<CounterBody<dim>> instants(const CounterBody<dim>& rest,
                                       const std::optional<CyclicMotion<dim>>& cycle);

}  // namespace gnomon::part
