// The boundary parts of a mesh by the names that a scene gives.
#pragma once

#include <gnomon/mesh/mesh.hpp>
#include <string>
#include <vector>

namespace gnomon {

/// The facets of a boundary part. Throws InputError with the names that there are.
template <int dim>
const std::vector<typename Mesh<dim>::Facet>& named_part(const Mesh<dim>& mesh,
                                                         const std::string& name);

}  // namespace gnomon
