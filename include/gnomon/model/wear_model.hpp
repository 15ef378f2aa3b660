// The model of a wearing assembly: consistent start, observations and fields.
#pragma once

#include <gnomon/model/joining_boundary.hpp>
#include <gnomon/model/physics.hpp>
#include <gnomon/model/worn_body_equations.hpp>
#include <gnomon/shapes/counter_surface.hpp>
#include <memory>

namespace gnomon {

/// The contact law at every contact node in a phase.
template <int dim>
struct PhaseContact {
  double weight;  ///< of the phase
  std::vector<ContactNode<dim>> nodes;
};

/// Where the partner is in a phase of a path, and the force that moves it; of a counter-body that
/// turns also its angle, and the moment about its axis.
template <int dim>
struct PlaceAndForce {
  Vector<dim> place = Vector<dim>::Zero();     ///< [length]
  Vector<dim> force = Vector<dim>::Zero();     ///< that moves it there
  Vector<dim> contact = Vector<dim>::Zero();   ///< what the contact carries of it
  Vector<dim> friction = Vector<dim>::Zero();  ///< the part of that along the contact
  double angle = 0;                            ///< [rad]
  double moment = 0;                           ///< [force length]
};

template <int dim>
class Resultants;

template <int dim>
class WearModel : public Physics<dim> {
public:
  explicit WearModel(std::shared_ptr<const Assembly<dim>> assembly);
  /// Throws InputError where the parts do not fit together.
  explicit WearModel(AssemblyParts<dim> parts)
      : WearModel(std::make_shared<const Assembly<dim>>(std::move(parts))) {}

  using Physics<dim>::system;
  /// Equilibrium at the initial shape by a load ramp (rows 1-2 of the system, shape frozen). The
  /// SolutionError names the largest fraction of the load with an equilibrium.
  State start(Counters& counters) const override;
  /// All common scalars; only some bodies have groove_section (a groove), approach (w, if the
  /// counter-body moves), displacement_gradient (small strains) and contact_half_width (2D, one
  /// pair). Forces and volumes are those of the whole body, of which only a part may be modelled
  /// because of symmetry. Over a cycle: nodes that touch in any phase, mean force, wear flux and
  /// approach, largest pressure, displacement gradient and half width.
  Observation observe(const State& state) const override;
  std::vector<GridField> fields(const State& state) const override;
  std::optional<ContactSurface> contact(const State& state) const override;

  const Assembly<dim>& assembly() const { return equations_.assembly(); }
  const WornBodyEquations<dim>& equations() const { return equations_; }

private:
  explicit WearModel(WornBodyEquations<dim> equations);
  std::optional<PhaseError> phase_error(const State& state) const;
  State behind_jump(const State& state) const;
  /// Without stick: deformation at the shape that `shape` has, phase by phase, from bodies without
  /// load. Throws SolutionError.
  FieldValues<dim> equilibrium(const FieldValues<dim>& shape, double t, Counters& counters) const;
  /// With these values, and their rates.
  State at_rest(double t, const FieldValues<dim>& values) const;
  Examination examine(const State& state) const;
  /// Of a state with these values and contacts, where wear is a gap (Examination::gap_error).
  std::optional<GapError> gap_error(const State& state, const FieldValues<dim>& values,
                                    const std::vector<PhaseContact<dim>>& contacts) const;
  /// Boundary that the counter-body comes near to joins the contact (Interface::reach).
  std::optional<Succession> succeed(const State& state) const;
  /// Where friction may stick: what has joined since `before` remembers where it is.
  void remember_joined(const Assembly<dim>& before, double t, FieldValues<dim>& values) const;
  std::optional<Succession> succeed_pairs(const State& state) const;
  /// By phase, of the nodes of the mesh, deformed, in the frames of the bodies [length].
  std::vector<std::vector<Vector<dim>>> positions(const State& state) const;
  /// Whether surfaces of pairs have by this part of the margin of their candidates.
  bool have_moved(const std::vector<std::vector<Vector<dim>>>& x, double part) const;
  /// Boundary that would join lies inside of the counter-body.
  bool overdue(const State& state) const;
  /// Within the box of the initial body, widened by a quarter of its longest side.
  CounterSurface counter_surface(const State& state) const;
  /// How far the shape of a contact node has moved; where wear is a gap, along its initial normal.
  double wear_depth(std::size_t contact_node, const NodalField<dim>& d) const;
  /// By phase of a path.
  std::vector<PlaceAndForce<dim>> loop(const FieldValues<dim>& values, double t,
                                       const std::vector<PhaseContact<dim>>& phases) const;
  void follow_loads(const FieldValues<dim>& values, double t,
                    std::vector<PlaceAndForce<dim>>& loop) const;
  /// Of all fields at a state, also of displacements that are condensed.
  FieldValues<dim> values(const State& state) const;
  /// The contact law at every contact node, phase by phase; on the state's own smooth branch.
  std::vector<PhaseContact<dim>> contacts(const FieldValues<dim>& values, const Point& at) const;
  std::vector<PhaseContact<dim>> contacts(const FieldValues<dim>& values, const State& state) const;

  Box<dim> surroundings_;  ///< in which the counter-body is shown
  WornBodyEquations<dim> equations_;
  std::optional<OtherBoundary<dim>> others_;  ///< where boundary may join the contact
  std::shared_ptr<const Resultants<dim>> resultants_;
  std::vector<double> thickness_;  // by contact node, where wear is a gap
};

/// Half the distance between the edges of the contact zone [length], across the approach, in the
/// current configuration; 0 without contact. 2D, contact nodes ascending. In a body of revolution a
/// zone that begins on the axis goes on beyond it: then it is the distance of its edge from the
/// axis.
///
/// An edge lies between the last active node and the next open one. If the pressure falls towards
/// it like a Hertzian edge (p^2 linear in the position), the edge is where p^2 extrapolates to
/// zero; if it does not reach zero before the open node (a flat, worn profile), the edge is where
/// the gap of the next two open nodes extrapolates to zero.
double contact_half_width(const Assembly<2>& body, const WornBodyFields& fields,
                          const FieldValues<2>& values, const std::vector<ContactNode<2>>& nodes);

}  // namespace gnomon
