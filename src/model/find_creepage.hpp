// The creepages of a start in steady rolling that forces determine.
#pragma once

#include <gnomon/base/counters.hpp>
#include <gnomon/model/worn_body_equations.hpp>

namespace gnomon {

/// From the equilibrium at the given creepages, `values`, that with those that forces determine.
/// Throws SolutionError where friction balances these forces at none.
template <int dim>
void find_creepage(const WornBodyEquations<dim>& equations, FieldValues<dim>& values,
                   Counters& counters);

}  // namespace gnomon
