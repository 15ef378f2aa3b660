// Forces and torques on the bodies of an assembly, from the rows of its equations.
#pragma once

#include <gnomon/model/wear_model.hpp>
#include <memory>
#include <vector>

namespace gnomon {

/// Means over the phases of a cycle.
struct ForceBalance {
  std::vector<ResultantForce> forces;     ///< Examination::forces
  std::vector<ResultantForce> reactions;  ///< Examination::reactions
  double idle_load = 0;                   ///< Examination::idle_load
};

template <int dim>
class Resultants {
public:
  explicit Resultants(const WornBodyEquations<dim>& equations);

  /// Of the equations that it was made of.
  ForceBalance balance(const WornBodyEquations<dim>& equations, const FieldValues<dim>& values,
                       double t, const std::vector<PhaseContact<dim>>& contacts) const;

private:
  NodalField<dim> of(const WornBodyEquations<dim>& equations, const FieldValues<dim>& values,
                     double t, KindOfTerm wanted) const;

  /// The inner forces are asked for only at supports, and so only the cells there are visited.
  const Numbering& of_kind(TermKind kind) const { return kind == TermKind::body ? held_ : all_; }

  Numbering all_, held_;  // of all values of u, and of those that supports hold
  std::vector<std::unique_ptr<Term<dim>>> terms_;  // null where a term exerts no force on a body
};

/// The balance without what the assembly does not have, as columns of a history. Of a part of a
/// symmetric body there are none: what is across the symmetry is not known.
template <int dim>
std::vector<Scalar> force_columns(const Assembly<dim>& assembly, const ForceBalance& balance);

}  // namespace gnomon
