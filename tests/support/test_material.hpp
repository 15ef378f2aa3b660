// What tests of materials and elements share: moduli, and differences of a cell's residual.
#pragma once

#include <gtest/gtest.h>

#include <gnomon/terms/solid.hpp>

namespace gnomon::testing {

/// E = 7, and some of the second invariant where a law has it (Mooney-Rivlin).
inline ElasticModuli test_moduli(double poisson_ratio = 0.4) {
  ElasticModuli moduli = ElasticModuli::from_young_poisson(7, poisson_ratio);
  moduli.ratios[0] = 0.3;
  return moduli;
}

/// Central differences of a cell's residual by the entries of `moved`, which is X or u.
template <int dim>
Eigen::MatrixXd residual_differences(const CellKernel<dim>& kernel, const ElasticModuli& moduli,
                                     const CellNodal<dim>& X, const CellNodal<dim>& u,
                                     CellNodal<dim>& moved) {
  constexpr int local = dim * (1 << dim);
  constexpr double h = 1e-6;
  Eigen::MatrixXd result(local, local);
  for (int k = 0; k < local; ++k) {
    CellNodal<dim> plus, minus;
    double& value = moved(k / dim, k % dim);
    const double start = value;
    value = start + h;
    EXPECT_TRUE(kernel.residual(moduli, X, u, plus));
    value = start - h;
    EXPECT_TRUE(kernel.residual(moduli, X, u, minus));
    value = start;
    result.col(k) = (plus - minus).transpose().reshaped() / (2 * h);
  }
  return result;
}

}  // namespace gnomon::testing
