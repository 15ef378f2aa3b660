// What [cycle] says for a part: its functions, and the counter-body at a position.
#pragma once

#include <gnomon/cycles/cycle.hpp>
#include <gnomon/model/worn_body.hpp>
#include <gnomon/scene/scene.hpp>
#include <optional>
#include <vector>

namespace gnomon::part {

inline constexpr int samples =
    64;  ///< positions at which a cycle is looked at before its phases are known

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

}  // namespace gnomon::part
