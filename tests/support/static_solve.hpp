// Equilibrium of elastic cells under nodal loads, some values held: Newton's method with a sparse
// factor.
#pragma once

#include <gtest/gtest.h>

#include <gnomon/linear/sparse_lu.hpp>
#include <gnomon/terms/cell_assembly.hpp>
#include <vector>

namespace gnomon::testing {

/// `u` begins with the held values, and ends as the solution. Fails without convergence.
template <int dim>
void solve_statically(const Mesh<dim>& mesh, const Material& material, const Element& element,
                      const NodalFlags<dim>& held, const NodalField<dim>& load,
                      NodalField<dim>& u) {
  NodalNumbers<dim> numbers = NodalNumbers<dim>::Constant(u.rows(), dim, -1);
  std::vector<int> group;
  for (Eigen::Index k = 0; k < u.size(); ++k)
    if (!held.data()[k]) {
      numbers.data()[k] = static_cast<int>(group.size());
      group.push_back(static_cast<int>(k / dim));
    }
  CellAssembly<dim> cells(mesh, {{.material = material, .element = element}}, numbers, numbers);
  PatternBuilder builder(static_cast<int>(group.size()));
  cells.add_to_pattern(builder);
  const SparsePattern pattern = builder.build();
  cells.map_to(pattern);
  SparseLu lu(pattern, group);
  double largest = 1;
  for (int iteration = 0; iteration < 12 && largest > 1e-13 * u.cwiseAbs().maxCoeff();
       ++iteration) {
    std::vector<double> F(group.size()), values(pattern.nonzeros()), step(group.size());
    cells.add_residual(nullptr, u, F);
    cells.add_jacobian(nullptr, u, values);
    for (Eigen::Index k = 0; k < u.size(); ++k)
      if (const int row = numbers.data()[k]; row >= 0) F[row] -= load.data()[k];
    ASSERT_TRUE(lu.factorize(values));
    lu.solve(F, step);
    largest = 0;
    for (Eigen::Index k = 0; k < u.size(); ++k)
      if (const int number = numbers.data()[k]; number >= 0) {
        u.data()[k] -= step[number];
        largest = std::max(largest, std::abs(step[number]));
      }
  }
  EXPECT_LT(largest, 1e-10 * u.cwiseAbs().maxCoeff()) << "Newton does not converge";
}

}  // namespace gnomon::testing
