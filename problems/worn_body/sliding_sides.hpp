// Which components of the shape the sides of a part hold: the geometry decides, or the scene.
#pragma once

#include <array>
#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/scene/scene.hpp>
#include <map>
#include <vector>

namespace gnomon::part {

/// 1 where a side holds a component of the shape.
template <int dim>
using Held = std::array<char, std::size_t{dim}>;

template <int dim>
constexpr Held<dim> altogether() {
  Held<dim> held;
  held.fill(1);
  return held;
}

/// For all facets of the boundary that do not wear. A side slides along the coordinate directions
/// that lie in it: a plane, and a round cylinder, such as the wall of a hole, along its axis.
/// Those that `shape.slide` names need to be so to a hundredth only. Throws InputError where they
/// are not.
template <int dim>
std::map<typename Mesh<dim>::Facet, Held<dim>> held_by_sides(
    const Scene& scene, const ImportedBody<dim>& part,
    const std::vector<typename Mesh<dim>::Facet>& wearing);

}  // namespace gnomon::part
