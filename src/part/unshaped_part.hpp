// What a scene says of a part, but for scales and the shape, which follow from it.
#pragma once

#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/model/assembly.hpp>
#include <gnomon/scene/scene.hpp>

namespace gnomon::part {

/// All parts but the scales and where the shape is held. Throws InputErrors with all mistakes in
/// them.
template <int dim>
AssemblyParts<dim> read_unshaped_part(const Scene& scene, const ImportedBody<dim>& part);

}  // namespace gnomon::part
