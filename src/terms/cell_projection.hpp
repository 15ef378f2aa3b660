// Equations of a cell some nodes of which keep to a plane or line: P R(P u) + k (1 - P) u = 0, with
// the derivative P K P + k (1 - P), symmetric where K is. R and K have no part across, so that k,
// a stiffness of the cell, does not change the solution.
#pragma once

#include <cmath>
#include <gnomon/fields/field.hpp>
#include <gnomon/mesh/mesh.hpp>
#include <gnomon/terms/solid.hpp>
#include <vector>

namespace gnomon {

template <int dim>
class CellProjection {
public:
  /// `X`: reference positions of the nodes of `cell`. `along` must outlive the object.
  CellProjection(const typename Mesh<dim>::Cell& cell, const NodalProjectors<dim>& along,
                 const ElasticModuli& moduli, const CellNodal<dim>& X)
      : stiffness_((moduli.lambda + 2 * moduli.mu) * std::pow(cell_volume<dim>(X), 1 - 2.0 / dim)) {
    for (int a = 0; a < Mesh<dim>::cell_nodes; ++a)
      if (const auto found = along.find(cell[a]); found != along.end())
        corners_.push_back({a, found->second});
  }

  void of_displacement(CellNodal<dim>& u) const {
    for (const auto& [a, P] : corners_) u.row(a) = (u.row(a) * P).eval();
  }

  /// `u`: the displacement before its projection.
  void of_residual(const CellNodal<dim>& u, CellNodal<dim>& R) const {
    for (const auto& [a, P] : corners_)
      R.row(a) = (R.row(a) * P + stiffness_ * (u.row(a) - u.row(a) * P)).eval();
  }

  void of_tangent(CellMatrix<dim>& K) const {
    for (const auto& [a, P] : corners_) {
      auto rows = K.template middleRows<dim>(dim * a);
      rows = (P * rows).eval();
      auto columns = K.template middleCols<dim>(dim * a);
      columns = (columns * P).eval();
      K.template block<dim, dim>(dim * a, dim * a) += stiffness_ * (Tensor<dim>::Identity() - P);
    }
  }

private:
  struct Corner {
    int corner;
    Tensor<dim> P;
  };
  double stiffness_;
  std::vector<Corner> corners_;
};

}  // namespace gnomon
