// Sizes far too small for a geometry.
#pragma once

namespace gnomon::gmsh_reader {

/// Before the current model is meshed: throws Refusal where edges of `size` times the factor that
/// is set give more cells than this computer can hold, with an estimate of their number from the
/// area or volume: that of OpenCASCADE, or of the outlines of a plane geometry, or of the box
/// around it. Structured meshes, which sizes do not change, are not refused.
void check_number_of_cells(int dimension, double size);

/// The number of elements on all curves of the current model, which is left without a mesh.
double elements_on_curves();

}  // namespace gnomon::gmsh_reader
