// Forces and torques on the bodies of an assembly, from the rows of its equations; and how far
// contact reaches: between which nodes it ends, and what a mesh cannot know of it.
#pragma once

#include <gnomon/model/wear_model.hpp>
#include <memory>
#include <vector>

namespace gnomon {

/// Means over the phases of a cycle.
struct ForceBalance {
  std::vector<ResultantForce> forces;     ///< Examination::forces
  std::vector<ResultantForce> reactions;  ///< Examination::reactions
  std::vector<ResultantForce> pairs{};    ///< Examination::pairs
  double idle_load = 0;                   ///< Examination::idle_load
};

/// What presses a counter-body along the guides on which it is free, by straight lines of the
/// histories that are valid after `within` [force]. `first`: the history of the first guide.
template <int dim>
Vector<dim> pressing_force(const Phase<dim>& phase, const LoadHistory& first, double t,
                           double within);

template <int dim>
class Resultants {
public:
  /// Of all displacements, also of a condensed assembly.
  explicit Resultants(WornBodyEquations<dim> equations);

  ForceBalance balance(const FieldValues<dim>& values, double t,
                       const std::vector<PhaseContact<dim>>& contacts) const;

private:
  NodalField<dim> of(const FieldValues<dim>& values, double t, KindOfTerm wanted) const;

  /// The inner forces are asked for only at supports, and so only the cells there are visited.
  const Numbering& of_kind(TermKind kind) const { return kind == TermKind::body ? held_ : all_; }

  WornBodyEquations<dim> equations_;
  Numbering all_, held_;         // of all values of u, and of those that supports hold
  std::vector<int> body_of_;     // by node of the mesh
  std::vector<int> pair_of_;     // by contact node: the pair whose slave it belongs to, or -1
  std::vector<int> undeformed_;  // by node: the part of the mesh whose travel places it, or -1
  std::vector<std::unique_ptr<Term<dim>>> terms_;  // null where a term exerts no force on a body
};

/// The balance without what the assembly does not have, as columns of a history. Of a part of a
/// symmetric body there are none: what is across the symmetry is not known.
template <int dim>
std::vector<Scalar> force_columns(const Assembly<dim>& assembly, const ForceBalance& balance);

struct ContactArea {
  double area = 0;     ///< of the nodes in contact, along the worn surface; in 2D a width
  double unknown = 0;  ///< half of the facets of which only some nodes are
};

template <int dim>
ContactArea contact_area(const Assembly<dim>& body, const NodalField<dim>& d,
                         const std::vector<ContactNode<dim>>& nodes);

/// Volume that wears off per time, mean over the cycle [length^dim / time].
template <int dim>
double wear_flux_of(const std::vector<PhaseContact<dim>>& phases, double copies);

/// The largest pressure of the phases, if it is at a node beside an open one.
template <int dim>
std::optional<EdgePressure> edge_pressure(const Assembly<dim>& body,
                                          const std::vector<PhaseContact<dim>>& phases);

}  // namespace gnomon
