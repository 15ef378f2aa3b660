// Where the shape of a part is held, slides or is an unknown.
#pragma once

#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/model/assembly.hpp>
#include <gnomon/scene/scene.hpp>

#include "part/groups.hpp"

namespace gnomon::part {

/// shape.reach, shape.hold and shape.slide.
std::vector<Key> shape_support_keys();

/// ShapeMotion::held and along; beyond `reach` all is held; infinite: all of the body may move.
template <int dim>
struct ShapeSupport {
  NodalFlags<dim> held;
  NodalProjectors<dim> along{};
  double reach = 0;
};

/// Bonds of bodies stay where they are: planar ones slide in themselves, so that a coating gets
/// thinner, not what it is on. Beyond the `wearing` surfaces planar sides slide in their plane and
/// other sides are held, unless the scene says otherwise; beyond the reach all is held (Remark 2).
/// The nodes of a line of a track do what all of them may, and do not move along it; those of a
/// circle move in one direction, across it.
template <int dim>
ShapeSupport<dim> read_shape_support(const Scene& scene, const ImportedBody<dim>& part,
                                     const std::vector<Surface<dim>>& wearing,
                                     const Facets<dim>& bonded, double expected_depth);

}  // namespace gnomon::part
