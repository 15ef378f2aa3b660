// Kinematics of an elastic cell at one reference point.
#pragma once

#include <gnomon/laws/elastic_law.hpp>
#include <gnomon/mesh/cell_basis.hpp>

namespace gnomon {

template <int dim, class Scalar = double>
struct CellPoint {
  Scalar volume;             ///< det(dX/dxi)
  CellNodal<dim, Scalar> n;  ///< rows n_a
  Tensor<dim, Scalar> H;     ///< displacement gradient
  Tensor<dim, Scalar> F;     ///< deformation gradient
  Scalar J;                  ///< det F

  CellPoint(const CellNodal<dim>& dN, const CellNodal<dim, Scalar>& X,
            const CellNodal<dim, Scalar>& u) {
    const Tensor<dim, Scalar> A = X.transpose() * dN.template cast<Scalar>();
    volume = A.determinant();
    n = dN.template cast<Scalar>() * A.inverse();
    // F from the displacement gradient: rounding errors are then proportional to the strain, not to
    // the position.
    H = u.transpose() * n;
    F = Tensor<dim, Scalar>::Identity() + H;
    J = F.determinant();
  }

  Scalar trace() const { return H.trace(); }
  /// Whether the cell is not inverted at this point; with small strains only its reference can be
  /// inverted.
  bool valid(Kinematics kinematics) const {
    return volume > Scalar(0) && (kinematics == Kinematics::small || J > Scalar(0));
  }

  /// Rows g_a = F^-T n_a.
  CellNodal<dim, Scalar> spatial_gradients() const { return n * F.inverse(); }
};

}  // namespace gnomon
