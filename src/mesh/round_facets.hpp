// The facets of a mesh that stand for pieces of smooth surfaces, and how far off these they are.
#pragma once

#include <gnomon/mesh/imported_body.hpp>

namespace gnomon {

/// Of the boundary, and of interfaces between groups of cells, seen from one of these; flat ones
/// are left out.
std::vector<RoundFacet> round_facets(const ImportedMesh& mesh);

}  // namespace gnomon
