// A path with twice as many phases, beside one whose phases are known.
#pragma once

#include <gnomon/model/wear_model.hpp>
#include <gnomon/model/worn_body_equations.hpp>
#include <gnomon/newton/newton_options.hpp>
#include <vector>

namespace gnomon {

/// Contact over the next cycle of a path with each phase in two halves, at this shape and time;
/// over the one after it where this one does not end as it began. Throws SolutionError.
template <int dim>
std::vector<PhaseContact<dim>> contacts_of_halves(const WornBodyEquations<dim>& equations,
                                                  const FieldValues<dim>& values, double t,
                                                  const NewtonOptions& newton);

}  // namespace gnomon
