// What src/linear/multigrid.cpp finds in this module.

#include "multigrid/multigrid.hpp"

extern "C" gnomon::InnerSolver* gnomon_new_multigrid(
    const gnomon::StiffnessLayout& layout, const std::vector<gnomon::SparseRows>& interpolations) {
  return (interpolations.empty() ? gnomon::make_algebraic_multigrid(layout)
                                 : gnomon::make_geometric_multigrid(layout, interpolations))
      .release();
}
