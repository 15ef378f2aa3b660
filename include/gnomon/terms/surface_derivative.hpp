// The derivatives of NodalSurface with respect to the undeformed positions of a patch.
#pragma once

#include <array>
#include <gnomon/mesh/corner_derivatives.hpp>
#include <gnomon/terms/nodal_surface.hpp>

namespace gnomon {

/// dA/dX (rows) and dN/dX of every patch node.
template <int dim>
struct SurfaceDerivative {
  std::array<Vector<dim>, max_patch_nodes> area;
  std::array<Tensor<dim>, max_patch_nodes> normal;

  SurfaceDerivative(const ContactPatch<dim>& patch, const PatchNodal<dim>& X, NormalRule rule) {
    const std::size_t count = patch.nodes.size();
    for (std::size_t p = 0; p < count; ++p) area[p].setZero(), normal[p].setZero();
    const bool conserves = rule == NormalRule::conservative;
    Vector<dim> mean = Vector<dim>::Zero();
    double total = 0;
    for (const auto& corner : patch.corners) {
      const Vector<dim> S = corner_area_vector<dim, double>(corner, X);
      const double size = S.norm();
      const Vector<dim> N = S / size;
      const double weight = corner.initial_area / patch.initial_area;
      total += corner.share * size;
      mean += weight * N;
      const Tensor<dim> tangential = (Tensor<dim>::Identity() - N * N.transpose()) * weight / size;
      const auto dS = area_vector_derivative<dim>(corner, X);
      for (int k = 0; k < dim; ++k) {
        area[corner.nodes[k]] += corner.share * dS[k].transpose() * N;
        if (!conserves) normal[corner.nodes[k]] += tangential * dS[k];
      }
    }
    if (conserves) conserve(patch, X, total);
    if (rule != NormalRule::normalised) return;
    const double length = mean.norm();
    const Vector<dim> unit = mean / length;
    const Tensor<dim> project = (Tensor<dim>::Identity() - unit * unit.transpose()) / length;
    for (std::size_t p = 0; p < count; ++p) normal[p] = project * normal[p];
  }

private:
  /// For N = A a/|a|^2: dN = a/|a|^2 dA + A/|a|^2 (1 - 2 a a'/|a|^2) da.
  void conserve(const ContactPatch<dim>& patch, const PatchNodal<dim>& X, double total) {
    const Vector<dim> a = free_volume_gradient<dim, double>(patch, X);
    const double square = a.squaredNorm();
    if (!determines_motion(square, total)) return;
    Tensor<dim> by_a = total / square * (Tensor<dim>::Identity() - 2 / square * a * a.transpose());
    by_a *= patch.shape_free;
    for (const auto* corners : {&patch.corners, &patch.corners_beyond})
      for (const auto& corner : *corners) {
        const auto da = volume_gradient_derivative<dim>(corner, X);
        for (std::size_t k = 0; k < da.size(); ++k) normal[corner.nodes[k]] += by_a * da[k];
      }
    for (std::size_t p = 0; p < patch.nodes.size(); ++p)
      normal[p] += a / square * area[p].transpose();
  }
};

}  // namespace gnomon
