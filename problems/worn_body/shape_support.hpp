// Where the shape of a part is held, slides or is an unknown.
#pragma once

#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/model/worn_body.hpp>
#include <gnomon/scene/scene.hpp>

namespace gnomon::part {

/// shape.reach, shape.hold and shape.slide.
std::vector<Key> shape_support_keys();

/// Adds to shape_fixed and fills in shape_along. Beyond the `wearing` facets planar sides slide in
/// their plane and other sides are held, unless the scene says otherwise; beyond the reach all is
/// held (Remark 2). Returns the reach; infinite: all of the body.
template <int dim>
double read_shape_support(const Scene& scene, const ImportedBody<dim>& part,
                          const std::vector<typename Mesh<dim>::Facet>& wearing,
                          double expected_depth, WornBody<dim>& body);

}  // namespace gnomon::part
