// The coupled deformation-and-wear residual as a DAE (docs/equations.md), or a part of it with the
// other blocks frozen.
#pragma once

#include <gnomon/fields/unknowns.hpp>
#include <gnomon/system/system.hpp>
#include <gnomon/terms/cell_assembly.hpp>
#include <gnomon/terms/contact_assembly.hpp>
#include <gnomon/terms/mesh_motion.hpp>
#include <memory>
#include <optional>

namespace gnomon {

/// Rows, in the order of their unknowns:
///   u                equilibrium, eq. 23-25: internal + contact force - load          [force]
///   lambda           C_N, eq. 26                                                      [length]
///   w                contact force on the counter-body - what presses it              [force]
///   d (interior)     auxiliary equilibrium, eq. 20                                    [force]
///   d (contact)      ddot + Wdot N, eq. 14 [length/time] mu               auxiliary equilibrium
///   minus A^ mu^, eq. 29 (multiplier form)     [force]
/// With a cross-section, Wdot N of eq. 14 is averaged along the path (sec. 4.3).
/// Not safe for concurrent calls on one object (shared workspace).
template <int dim>
class WearSystem : public System {
public:
  WearSystem(std::shared_ptr<const WornBody<dim>> body, const Selection& selection);

  const Structure& structure() const override { return structure_; }
  void residual(const Point& at, std::span<double> F) const override;
  void jacobian(const Point& at, double alpha, std::span<double> values) const override;
  /// lambda + rho g of every contact node [stress].
  void switching(std::span<const double> y, std::span<double> values) const override;
  /// Mesh motion (interior d, and mu where present), then contact (u, lambda, w).
  std::vector<Stage> make_stages() const override;

  const Unknowns<dim>& unknowns() const { return unknowns_; }
  const WornBody<dim>& body() const { return *body_; }
  /// For another system of the same body.
  const std::shared_ptr<const WornBody<dim>>& shared_body() const { return body_; }
  const ContactAssembly<dim>& contact() const { return contact_; }

  /// Nodal values of y; frozen blocks as last given to freeze() (zero before).
  const NodalState<dim>& nodal(std::span<const double> y) const;
  /// Gives the blocks that this system does not solve for.
  void freeze(const NodalState<dim>& state) { state_ = state; }
  /// Factor of the load in place of that of the history: in a load ramp, and where time is frozen.
  void set_load_factor(double factor) { load_factor_ = factor; }

private:
  void build_structure();
  double load_factor(const Point& at) const;
  void label_blocks();

  std::shared_ptr<const WornBody<dim>> body_;
  Selection selection_;
  Unknowns<dim> unknowns_;
  CellAssembly<dim> solid_;  // body: rows u, columns u and d
  MeshMotion<dim> mesh_motion_;
  ContactAssembly<dim> contact_;
  Structure structure_;
  std::optional<double> load_factor_;
  mutable NodalState<dim> state_;
};

}  // namespace gnomon
