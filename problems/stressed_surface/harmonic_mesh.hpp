// A mesh motion that is linear: every component of d is harmonic in the initial configuration, with
// a weight for each direction. With the weights (0, 1) nodes on lines along y keep their order
// there, however sharp the surface becomes.
#pragma once

#include <gnomon/terms/material.hpp>

namespace gnomon::stressed {

/// For MeshMotion: the law P = (F - I) diag(weights), whose plain elements have the matrix of
/// harmonic_matrix().
Material harmonic_material(const Vector<2>& weights);

/// K_ab = sum_g det(dX^/dxi) n_a . diag(weights) n_b of a cell, for each component.
Eigen::Matrix4d harmonic_matrix(const Vector<2>& weights, const CellNodal<2>& initial);

}  // namespace gnomon::stressed
