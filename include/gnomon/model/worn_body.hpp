// All constants of one worn body in contact with a rigid counter-body: a problem declares them, and
// fields and terms are made from them.
#pragma once

#include <algorithm>
#include <functional>
#include <gnomon/cycles/phase_mean.hpp>
#include <gnomon/laws/load_history.hpp>
#include <gnomon/mesh/mesh_part.hpp>
#include <gnomon/system/composed_system.hpp>
#include <gnomon/system/linear_solver_choice.hpp>
#include <gnomon/terms/contact_node.hpp>
#include <gnomon/terms/mesh_motion.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// How the auxiliary problem is connected to the worn surface: the rows of wear replace the
/// auxiliary equilibrium there, or the paper's augmented multiplier mu carries the reaction (eq.
/// 22, 29).
enum class ConstraintForm { eliminated, multiplier };

/// Typical magnitudes over a run; they scale residuals and unknowns, and do not change the
/// solution.
struct Scales {
  double force = 1;            ///< applied load, as in the rows of u
  double displacement = 1;     ///< elastic approach of the bodies [length]
  double stress = 1;           ///< mean contact pressure
  double wear_depth = 1;       ///< mean wear depth over the contact surface at the end [length]
  double duration = 1;         ///< of the run [time]
  double auxiliary_force = 1;  ///< of the mesh-motion rows
};

/// Unit of rho [stress / length]: Young's modulus divided by facet length, or, under a light load,
/// a limit from the tractions and gaps that occur. If rho is hundreds of times their ratio, gaps
/// alone determine the active set, and Newton's method cycles; a small rho does no harm.
inline double regularization_unit(double young, double facet, const Scales& scales) {
  constexpr double far_above = 1000;  // times the default of contact.regularization: 10
  const double occurring = scales.stress / (scales.displacement + scales.wear_depth);
  return std::min(young / facet, far_above * occurring);
}

/// The positions of the fields of a worn body in its FieldSet. Of a cycle each phase has its own u,
/// lambda and w; d and mu are those of all.
struct WornBodyFields {
  FieldId u = FieldId::none;       ///< displacement, all nodes
  FieldId d = FieldId::none;       ///< shape, all nodes; differential on the contact surface
  FieldId lambda = FieldId::none;  ///< contact multiplier, contact nodes
  FieldId mu = FieldId::none;      ///< shape multiplier, contact nodes; only in that form
  FieldId w =
      FieldId::none;  ///< rigid motion of the counter-body, a single value; only under a force
  double load = 1;    ///< factor of the loads on the body in the phase of u, lambda and w
};

/// A contact state: one of the phases of a cycle, or the only one.
template <int dim>
struct Phase {
  double position = 0;              ///< tau, in the cycle
  double weight = 1;                ///< omega, part of the mean over the cycle
  CounterBody<dim> counter_body{};  ///< where it is in this phase, and how it moves
  /// The force that presses the counter-body along its `approach`, at factor one of the history;
  /// without it the counter-body does not move.
  std::optional<double> force{};
  double load = 1;  ///< factor of the loads on the body
};

template <int dim>
struct WornBody;

/// Makes an additional term (added_term.hpp). The body outlives the term.
template <int dim>
using AddedTermFactory = std::function<std::unique_ptr<Term<dim>>(
    const WornBody<dim>&, const WornBodyFields&, const Numbering&)>;

template <int dim>
struct WornBody {
  Mesh<dim> mesh;
  std::vector<ContactPatch<dim>> contact_nodes;  ///< the potential contact surface
  NodalFlags<dim> displacement_fixed;            ///< 1 where u is held at zero
  NodalFlags<dim> shape_fixed;                   ///< 1 where d is held at zero
  /// Of the nodes whose d keeps to a plane or line oblique to the coordinate directions: the
  /// projector on it, zero in the components that `shape_fixed` holds.
  NodalProjectors<dim> shape_along;
  /// Where u is held at other values, among those that `displacement_fixed` holds.
  std::vector<PrescribedValues> prescribed_displacement;
  NodalField<dim> load;  ///< nodal dead loads at factor one
  Material material;
  /// Its `section` says whether the body is one of revolution about r = 0, in coordinates (r, z);
  /// then forces, areas and volumes are those of the whole circumference, `contact_nodes` are made
  /// for the same section, and the nodes on the axis are held (hold_on_axis).
  Element element;
  MeshMotionLaw mesh_motion;  ///< eq. (20)
  ContactParameters<dim> contact;
  /// Wearing surfaces: `contact.wear` is the law of surface 0, further_wear[k - 1] that of surface
  /// k.
  std::vector<WearLaw> further_wear;
  std::vector<int> wear_surface;  ///< that each contact node belongs to; empty: 0
  /// The force that presses the counter-body along its `approach`, at factor one; without it the
  /// counter-body does not move.
  std::optional<double> counter_force;
  LoadHistory load_history;       ///< factor of `load` and of `counter_force`
  std::vector<Phase<dim>> cycle;  ///< its phases; empty: one steady state
  /// Other phases of a cycle of this body, by its position and force, for the error of the mean
  /// over `cycle`. Throws InputError. Empty: there is no cycle.
  std::function<std::vector<Phase<dim>>(const WornBody& body, const PhaseSet& set)> phase_set;
  std::optional<double> sliding_speed;  ///< that a scene gives, for nominal_speed()
  std::optional<CrossSection> section;  ///< 3D only: uniform along x
  /// One entry per contact node: its part in the wear rate of its shape unknowns, by default 1;
  /// with a section, the length that it represents divided by the length of the path.
  std::vector<double> wear_weight;
  std::vector<std::string> remarks;  ///< Model::remarks()
  std::vector<MeshPart> parts;       ///< of a mesh from a file, for its result to keep
  double copies = 1;                 ///< number of modelled parts in the whole body (symmetry)
  ConstraintForm constraint = ConstraintForm::eliminated;
  double augmentation = 0;  ///< of mu: mu^ = mu + augmentation (ddot + Wdot N) [stress time/length]
  std::vector<AddedTermFactory<dim>> added_terms;
  Scales scales;
  LinearSolverChoice solver;
  double memory = 0;  ///< Model::memory()

  /// The contact states: the phases of the cycle, or the steady state.
  std::vector<Phase<dim>> phases() const {
    if (!cycle.empty()) return cycle;
    return {{.counter_body = contact.counter_body, .force = counter_force}};
  }
  /// With which the sliding distance is counted, s = speed t: `sliding_speed`, or that of the
  /// motion, its mean over the phases [length / time].
  double nominal_speed() const {
    if (sliding_speed) return *sliding_speed;
    return mean_over(phases(), [this](const Phase<dim>& phase) {
      return phase.counter_body.motion.nominal_speed(contact.streaming);
    });
  }
  /// Projector on the directions in which the shape of a node may move.
  Tensor<dim> shape_free(int node) const {
    if (const auto along = shape_along.find(node); along != shape_along.end()) return along->second;
    return (1 - shape_fixed.row(node).template cast<double>().array()).matrix().asDiagonal();
  }
  /// The node that carries the shape unknowns of `node`.
  int shape_node(int node) const { return section ? section->node[section->of[node]] : node; }
};

}  // namespace gnomon
