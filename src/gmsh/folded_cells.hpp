// Whether cells of Gmsh's current model are folded, which the solution of no problem can take.
#pragma once

namespace gnomon::gmsh_reader {

/// Of quadrilaterals in the plane z = 0, or hexahedra: whether the Jacobian has both signs, or is
/// zero, at the corners of one of them.
bool has_folded_cells(int dimension);

}  // namespace gnomon::gmsh_reader
