// The derivative of a cell's elastic energy with respect to the positions of its nodes in the
// undeformed configuration, at constant displacements (J. D. Eshelby; "configurational force"):
//
//   E = sum_g det(dX/dxi) phi(H),   C_b = dE/dX_b = sum_g det(dX/dxi) (phi I - H^T sigma) n_b
//
// of the plain element with small strains, whose forces sum_g det(dX/dxi) sigma n_a are dE/du_a.
#pragma once

#include <gnomon/base/error.hpp>
#include <gnomon/laws/linear_elastic.hpp>
#include <gnomon/terms/cell_point.hpp>

namespace gnomon::stressed {

/// E, per thickness [stress length^2].
inline double elastic_energy(const ElasticModuli& moduli, const CellNodal<2>& X,
                             const CellNodal<2>& u) {
  double energy = 0;
  for (const CellNodal<2>& dN : CellBasis<2>::instance().gauss) {
    const CellPoint<2> point(dN, X, u);
    energy += point.volume * LinearElasticPoint<2>(moduli, point.H).energy();
  }
  return energy;
}

/// C, one row per node [stress length]. Throws RecoverableError where the cell is inverted.
template <class Scalar = double>
CellNodal<2, Scalar> configurational_force(const ElasticModuli& moduli,
                                           const CellNodal<2, Scalar>& X,
                                           const CellNodal<2, Scalar>& u) {
  CellNodal<2, Scalar> C = CellNodal<2, Scalar>::Zero();
  for (const CellNodal<2>& dN : CellBasis<2>::instance().gauss) {
    const CellPoint<2, Scalar> point(dN, X, u);
    if (!(point.volume > Scalar(0))) throw RecoverableError("an element of the body is inverted");
    const LinearElasticPoint<2, Scalar> law(moduli, point.H);
    const Tensor<2, Scalar> eshelby =
        law.energy() * Tensor<2, Scalar>::Identity() - point.H.transpose() * law.stress();
    C += point.volume * (point.n * eshelby.transpose());
  }
  return C;
}

}  // namespace gnomon::stressed
