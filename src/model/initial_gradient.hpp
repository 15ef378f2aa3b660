// How a node of a surface changes the volume of the body, at the initial shape.
#pragma once

#include <gnomon/mesh/mesh.hpp>
#include <gnomon/terms/contact_node.hpp>

namespace gnomon {

/// The derivative of the volume by the position of the node, along ContactPatch::shape_free; out of
/// the body [length^(dim-1)].
template <int dim>
Vector<dim> initial_volume_gradient(const Mesh<dim>& mesh, const ContactPatch<dim>& patch) {
  PatchNodal<dim> X(static_cast<Eigen::Index>(patch.nodes.size()), dim);
  for (Eigen::Index p = 0; p < X.rows(); ++p) X.row(p) = mesh.nodes[patch.nodes[p]].transpose();
  return free_volume_gradient<dim, double>(patch, X);
}

}  // namespace gnomon
