// The fields and terms of a wearing assembly, of which its system is composed (docs/equations.md).
#pragma once

#include <array>
#include <gnomon/model/assembly.hpp>
#include <gnomon/system/composed_system.hpp>
#include <gnomon/system/state.hpp>
#include <gnomon/terms/contact_nodes.hpp>
#include <gnomon/terms/mortar_term.hpp>
#include <gnomon/terms/stick_term.hpp>
#include <memory>

namespace gnomon {

/// The positions of the fields in their FieldSet. Of a cycle each phase has its own u, lambda and
/// w; d and mu are those of all.
struct WornBodyFields {
  FieldId u = FieldId::none;       ///< displacement, all nodes
  FieldId d = FieldId::none;       ///< shape, all nodes; differential on the contact surface
  FieldId lambda = FieldId::none;  ///< contact multiplier, contact nodes
  FieldId mu = FieldId::none;      ///< shape multiplier, contact nodes; only in that form
  FieldId w =
      FieldId::none;  ///< rigid motion of the counter-body: a value for each guide that is free
  FieldId traction = FieldId::none;    ///< lambda_T, contact nodes; only where friction may stick
  FieldId place = FieldId::none;       ///< r, contact nodes; only there, in pairs
  FieldId creepage = FieldId::none;    ///< xi, of pairs that roll under a force along the contact
  FieldId spin = FieldId::none;        ///< of pairs under a moment, W (X - centre) of unit length
  FieldId memory = FieldId::none;      ///< s, that of all phases; differential; only there
  FieldId mean_power = FieldId::none;  ///< q_mean of each contact, of laws that read it in rolling

  /// Those of a phase alone.
  std::array<FieldId, 8> of_phase() const {
    return {u, lambda, w, traction, place, creepage, spin, mean_power};
  }
};

/// Copies what a phase has alone to a phase of other equations, of the same kind.
template <int dim>
void copy_phase(const FieldValues<dim>& values, const WornBodyFields& from, FieldValues<dim>& copy,
                const WornBodyFields& to) {
  for (std::size_t k = 0; k < to.of_phase().size(); ++k) {
    const FieldId own = from.of_phase()[k], other = to.of_phase()[k];
    if (other == FieldId::none) continue;
    copy.vector(other) = values.vector(own);
    copy.matrix(other) = values.matrix(own);
  }
}

/// What a term of the equations stands for.
enum class TermKind { body, press, mesh_motion, contact, evolution, spring, load };
struct KindOfTerm {
  TermKind kind;
  std::size_t phase;
  std::size_t number = 0;  ///< of springs: which
  bool operator==(const KindOfTerm&) const = default;
};

/// Of a condensed assembly: the equations in the displacements of the contact nodes alone, or in
/// all.
enum class Elasticity { as_assembled, whole };

/// Of an assembly of pairs: the phase at this position in the cycle, or the nearest one.
template <int dim>
std::size_t nearest_instant(const Assembly<dim>& assembly, double position);

/// Rows, in the order of their unknowns:
///   u                equilibrium, eq. 23-25: internal + contact force - load            [force]
///                    of a condensed assembly S u + contact force - g (condensation.hpp)
///   lambda           C_N, eq. 26                                                        [length]
///   lambda_T, r, s   where friction may stick: stick_node.hpp, stick_term.hpp, mortar_term.hpp
///   w                contact force on the counter-body - applied force, by guide        [force]
///   q_mean           sum A (s q_mean - q), s of contact_share.hpp; of laws that read it  [power]
///   d (interior)     auxiliary equilibrium, eq. 20                                      [force]
///   d (contact)      ddot + Wdot N, eq. 14                                        [length/time]
///   mu               auxiliary equilibrium minus A^ mu, eq. 22 (multiplier form)        [force]
/// With a cross-section, Wdot N of eq. 14 is averaged along the path (sec. 4.3). In a cycle the
/// first three are those of each phase, and Wdot N is the mean over the phases (docs/cycles.md).
template <int dim>
class WornBodyEquations {
public:
  explicit WornBodyEquations(std::shared_ptr<const Assembly<dim>> assembly,
                             Elasticity elasticity = Elasticity::as_assembled);
  /// The same in other phases of its cycle.
  WornBodyEquations(std::shared_ptr<const Assembly<dim>> assembly, std::vector<Phase<dim>> phases,
                    Elasticity elasticity = Elasticity::as_assembled);

  const Assembly<dim>& assembly() const { return *assembly_; }
  const std::shared_ptr<const Assembly<dim>>& shared_assembly() const { return assembly_; }
  /// The contact states: the phases of a cycle, or a single one.
  const std::vector<Phase<dim>>& phases() const { return phases_; }
  const WornBodyFields& fields(std::size_t phase = 0) const { return fields_[phase]; }
  const std::shared_ptr<const Composition<dim>>& composition() const { return composition_; }
  /// Of each term of the composition.
  const std::vector<KindOfTerm>& kinds() const { return kinds_; }
  /// Equilibrium and contact at a frozen shape: rows 1-3.
  BlockSelection deformation() const;
  /// The same without unknown creepages: where all nodes slip, these are not determined.
  BlockSelection without_creepage() const;
  /// q of the counter-body in a phase: the given part and its unknowns.
  PartnerMotion<> partner_motion(const FieldValues<dim>& values, double t,
                                 std::size_t phase = 0) const {
    PartnerMotion<> q = phases_[phase].counter_body.given(t, t);
    if (const FieldId w = fields_[phase].w; w != FieldId::none) q += values.scalar(w);
    return q;
  }
  /// The shape that the cells have: d, or, where wear is a gap, none.
  NodalField<dim> shape_of_cells(const FieldValues<dim>& values) const {
    const NodalField<dim>& d = values.vector(fields().d);
    return assembly_->shape.gap ? NodalField<dim>::Zero(d.rows(), dim) : d;
  }
  /// Adds the displacements that are condensed to the values of a state at t.
  void complete(FieldValues<dim>& values, double t) const {
    for (std::size_t p = 0; condensation_ && p < phases_.size(); ++p) {
      NodalField<dim>& u = values.vector(fields_[p].u);
      u = condensation_->whole(u, t, phases_[p]);
    }
  }
  /// The contact term of a phase, in a system of this composition.
  const ContactNodes<dim>& contact(const ComposedSystem<dim>& system, std::size_t phase = 0) const;
  /// Where friction may stick: the place of every contact node on the partner, r of stick_node.hpp.
  NodalField<dim> places(const ComposedSystem<dim>& system, const FieldValues<dim>& values,
                         double t, std::size_t phase = 0) const;
  /// In steady rolling: what the partner is passed by beside rigid motion, displacements, of pairs
  /// their places on the partner, by node of the mesh [length].
  NodalField<dim> moved_on_partner(const FieldValues<dim>& values) const;
  /// In steady rolling: with the given creepage and what forces and a moment determine of it, of
  /// pairs the slave's.
  Rolling<dim> rolling(const FieldValues<dim>& values) const;
  /// The same, of pairs with the creepage of the first body relative to the second.
  Rolling<dim> rolling_of_first(const FieldValues<dim>& values) const;
  /// How far the partner's surface at every contact node is carried by a phase of a path, where the
  /// bodies stay as they are.
  NodalField<dim> carried(const Phase<dim>& phase) const;
  /// The contact law at every contact node in a phase, on the smooth branch of the point. `values`:
  /// those of its y.
  std::vector<ContactNode<dim>> contact_nodes(const ComposedSystem<dim>& system,
                                              const FieldValues<dim>& values, const Point& at,
                                              std::size_t phase = 0) const;

private:
  FieldSet make_fields();
  void add_friction(const Scales& scales, FieldSet& set);
  void add_memory(double slip, const Scales& scales, FieldSet& set);
  void add_places(double slip, FieldSet& set);
  SlipMemory memory() const;
  void let_memory_follow(Composition<dim>& composition) const;
  PartOfPlace part_of_place(std::size_t phase, int node, double factor = 1) const;
  StickingFriction<dim> friction_on_path(std::size_t phase) const;
  PathOfPartner<dim> path_of_partner(std::size_t phase) const;
  StickingFriction<dim> friction_in_rolling() const;
  std::vector<MortarCandidates> candidates_in(const Phase<dim>& phase) const;
  TermFactory<dim> contact_of(std::size_t phase, double nominal_speed) const;
  void add_terms(std::vector<TermFactory<dim>>& terms);
  void add(std::vector<TermFactory<dim>>& terms, TermKind kind, std::size_t phase,
           TermFactory<dim> make);
  void add_condensed(std::size_t phase, std::vector<TermFactory<dim>>& terms);
  void add_equilibrium(std::size_t phase, std::vector<TermFactory<dim>>& terms);
  void add_springs(const SpringSupport<dim>& springs, std::vector<TermFactory<dim>>& terms);
  void add_forces_of_rolling(std::vector<TermFactory<dim>>& terms);
  void add_load(const Load<dim>& load, std::vector<TermFactory<dim>>& terms);
  BlockSelection selection(bool deformation, bool mesh_motion) const;

  std::shared_ptr<const Assembly<dim>> assembly_;
  std::vector<Phase<dim>> phases_;
  std::shared_ptr<const Condensation<dim>> condensation_;
  std::vector<WornBodyFields> fields_;                                    // of each phase
  FieldId memory_before_ = FieldId::none, memory_stuck_ = FieldId::none;  // of SlipMemory
  std::vector<std::size_t> contact_terms_;  // in the composition, of each phase
  std::vector<KindOfTerm> kinds_;
  std::shared_ptr<const Composition<dim>> composition_;
};

}  // namespace gnomon
