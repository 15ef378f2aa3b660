// Which of the guides of a counter-body presses it, and the direction in which it comes.
#pragma once

#include <gnomon/scene/scene.hpp>
#include <gnomon/shapes/counter_body.hpp>
#include <vector>

namespace gnomon {

/// Puts what presses first, and sets approach and shares. `normals`: of the surface, outward, by
/// area, where friction holds what lies along it; empty where any guide may press. Where all guides
/// lie along it, loads or an overlap press: the counter-body is held across the surface, first.
template <int dim>
void order_guides(const Scene& scene, const std::vector<Vector<dim>>& normals,
                  CounterBody<dim>& body);

}  // namespace gnomon
