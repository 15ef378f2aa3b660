// Which directions of the shape the sides of a part hold: the geometry decides, or the scene.
#pragma once

#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/scene/scene.hpp>
#include <map>
#include <vector>

#include "part/groups.hpp"

namespace gnomon::part {

/// Sides are planar, or round, to this part of their size where `shape.slide` names them.
inline constexpr double nearly = 1e-2;

/// Orthogonal projector on the directions in which a side holds the shape.
template <int dim>
using Held = Tensor<dim>;

template <int dim>
Held<dim> altogether() {
  return Held<dim>::Identity();
}

/// For all facets of the boundary that do not wear. A plane slides in itself, a round cylinder
/// along a coordinate direction, such as the wall of a hole, along its axis. Those that
/// `shape.slide` names need to be `nearly` so. Throws InputError where they are not.
template <int dim>
std::map<typename Mesh<dim>::Facet, Held<dim>> held_by_sides(const Scene& scene,
                                                             const ImportedBody<dim>& part,
                                                             const Facets<dim>& wearing);

/// For the facets at which bodies are bonded, likewise; a curved bond holds the shape altogether.
template <int dim>
std::map<typename Mesh<dim>::Facet, Held<dim>> held_by_bonds(const Mesh<dim>& mesh,
                                                             const Facets<dim>& bonded);

}  // namespace gnomon::part
