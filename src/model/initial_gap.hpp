// How bodies come together before the load ramp of the start: until they touch, and from there into
// the first contact.
#pragma once

#include <functional>
#include <gnomon/model/worn_body_equations.hpp>
#include <vector>

namespace gnomon {

/// An unknown that changes where bodies go further into each other.
struct Approach {
  int number = 0;
  double touching = 0;  ///< its value where they touch
  double share = 0;     ///< of the way, in the unknown
};

/// Moves the bodies of all phases together, or apart, until they touch. Returns the unknowns by
/// which they go on from there. `contact`: of the equations at frozen shape. `touching`: called
/// where the bodies of pairs touch, before a node is in contact.
template <int dim>
std::vector<Approach> close_initial_gaps(const WornBodyEquations<dim>& equations,
                                         const ComposedSystem<dim>& contact,
                                         FieldValues<dim>& values,
                                         const std::function<void()>& touching);

/// The approximate approach of a counter-body under part of its force: proportional to F^(2/3), as
/// for a ball (Hertz). From there Newton's method begins with several active nodes. With a single
/// active node it would invert the elements at that node, and the more easily the finer they are.
template <int dim>
double indentation(const Assembly<dim>& body, double fraction);

}  // namespace gnomon
