// The fields and terms of a worn body, of which its system is composed (docs/equations.md).
#pragma once

#include <gnomon/model/worn_body.hpp>
#include <gnomon/system/composed_system.hpp>
#include <gnomon/system/state.hpp>
#include <gnomon/terms/contact_term.hpp>
#include <memory>

namespace gnomon {

/// Rows, in the order of their unknowns:
///   u                equilibrium, eq. 23-25: internal + contact force - load            [force]
///   lambda           C_N, eq. 26                                                        [length]
///   w                contact force on the counter-body - applied force                  [force]
///   d (interior)     auxiliary equilibrium, eq. 20                                      [force]
///   d (contact)      ddot + Wdot N, eq. 14                                        [length/time]
///   mu               auxiliary equilibrium minus A^ mu^, eq. 29 (multiplier form)       [force]
/// With a cross-section, Wdot N of eq. 14 is averaged along the path (sec. 4.3).
template <int dim>
class WornBodyEquations {
public:
  explicit WornBodyEquations(std::shared_ptr<const WornBody<dim>> body);

  const WornBody<dim>& body() const { return *body_; }
  const WornBodyFields& fields() const { return fields_; }
  const std::shared_ptr<const Composition<dim>>& composition() const { return composition_; }
  /// Equilibrium and contact at a frozen shape: rows 1-3.
  BlockSelection deformation() const;
  /// The contact term of a system of this composition.
  const ContactTerm<dim>& contact(const ComposedSystem<dim>& system) const;
  /// The contact law at every contact node, on the smooth branch of the point. `values`: those of
  /// its y.
  std::vector<ContactNode<dim>> contact_nodes(const ComposedSystem<dim>& system,
                                              const FieldValues<dim>& values,
                                              const Point& at) const;

private:
  FieldSet make_fields();
  void add_terms(std::vector<TermFactory<dim>>& terms);
  BlockSelection selection(bool deformation, bool mesh_motion) const;

  std::shared_ptr<const WornBody<dim>> body_;
  WornBodyFields fields_;
  std::size_t contact_term_ = 0;  // in the composition
  std::shared_ptr<const Composition<dim>> composition_;
};

}  // namespace gnomon
