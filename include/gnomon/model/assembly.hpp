// All constants of wearing bodies that touch a rigid counter-body or each other, as plain data: a
// scene, a problem or a program declares them, and fields and terms are made from them.
#pragma once

#include <algorithm>
#include <gnomon/fields/nodal.hpp>
#include <gnomon/laws/friction_factor.hpp>
#include <gnomon/laws/load_history.hpp>
#include <gnomon/mesh/extrusion.hpp>
#include <gnomon/mesh/surface_lines.hpp>
#include <gnomon/model/condensation.hpp>
#include <gnomon/model/cyclic_phases.hpp>
#include <gnomon/system/linear_solver.hpp>
#include <gnomon/terms/contact_node.hpp>
#include <gnomon/terms/material.hpp>
#include <gnomon/terms/mortar_pair.hpp>
#include <gnomon/terms/rolling.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// How the auxiliary problem is connected to the worn surface: the rows of wear replace the
/// auxiliary equilibrium there, or the paper's multiplier mu carries the reaction (eq. 22).
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

/// A part of the boundary on springs, whose other ends may move.
template <int dim>
struct SpringSupport {
  std::string name{};  ///< for its reaction
  std::vector<typename Mesh<dim>::Facet> facets;
  Vector<dim> stiffness = Vector<dim>::Zero();     ///< traction by displacement [stress / length]
  Vector<dim> displacement = Vector<dim>::Zero();  ///< of the other ends, at factor one [length]
  LoadHistory history{};                           ///< of the displacement
};

/// What one support holds: its reaction is told by its name.
struct NamedSupport {
  std::string name;                       ///< "support_1"
  std::vector<std::pair<int, int>> held;  ///< nodes of the mesh, and directions
};

/// What holds the displacement.
template <int dim>
struct Supports {
  NodalFlags<dim> held;                   ///< 1 where u is held, by node of the mesh
  std::vector<PrescribedValues> moved{};  ///< at other values than zero, among those held
  std::vector<SpringSupport<dim>> springs{};
  /// They share nothing that they hold; not all that is held has a name.
  std::vector<NamedSupport> named{};
};

/// A load on the bodies: dead forces at nodes, or a pressure that follows the deformed surface.
template <int dim>
struct Load {
  NodalField<dim> forces{};  ///< at factor one, nodes x dim [force]; empty: a pressure
  std::vector<typename Mesh<dim>::Facet> facets{};
  double pressure = 0;  ///< on these, at factor one; positive pushes on the body [stress]
  /// Of an acceleration: of the material that weighs most, at factor one [force / volume]. The
  /// forces are those of the unworn bodies.
  double weight = 0;
  LoadHistory history{};
  bool presses = false;  ///< it alone keeps the bodies together, so that it may not vanish
  /// Its own factor over the cycle; only where friction may stick.
  std::optional<CycleFunction> swing{};
};

/// Where the material of a surface passes its partner once in a turn: each of its lines along the
/// track wears by the mean along it, and recedes as a whole (sec. 4.3). The nodes of a circle move
/// alike along its radius and its axis, in one direction.
template <int dim>
struct Track {
  Streamlines<dim> along;
  double path = 0;  ///< L, of which the mesh is a part; on circles of their mean radius [length]
};

/// A part of the boundary that can touch the counter-body.
template <int dim>
struct Surface {
  std::string name;
  std::vector<typename Mesh<dim>::Facet> facets;
  WearLaw wear;
  bool wears = true;  ///< else its shape follows the mesh motion, like that of the other boundary
  std::optional<Track<dim>> track{};
};

/// On the way of the first loading of a path: parts of the forces where the path begins.
struct LoadingStep {
  double press = 1;   ///< of loads and what presses
  double others = 1;  ///< of forces along other guides, and of swinging loads
};

/// Contact of the bodies with a rigid counter-body, or with each other by AssemblyParts::pairs.
template <int dim>
struct Interface {
  /// They share no facet. A node of two of them wears by the law of the first.
  std::vector<Surface<dim>> surfaces;
  /// Facets of the boundary, among them those beside the surfaces, which their nodes move when
  /// they wear; read by the conservative rule alone.
  std::vector<typename Mesh<dim>::Facet> boundary{};
  /// Other boundary that comes nearer to the partner than half of this joins the contact, with all
  /// that is within it; 0: none does [length].
  double reach = 0;
  CounterBody<dim> partner{};
  /// The force that presses the partner along the first of its guides, at factor one; without it
  /// the partner does not move there.
  std::optional<double> force{};
  LoadHistory history{};                        ///< of the force
  Vector<dim> streaming = Vector<dim>::Zero();  ///< V of eq. (7) [length / time]
  NormalRule normal_rule = NormalRule::averaged;
  /// Friction may stick: the phases are a path through a cycle, whose end is that of the last one
  /// (docs/fretting.md); nothing streams.
  bool sticks = false;
  bool memory_follows = false;                          ///< for explicit methods (slip_memory.hpp)
  std::vector<LoadingStep> loading = {{1, 0}, {1, 1}};  ///< of a path; at its end both are 1
  double friction = 0;                                  ///< Coulomb's coefficient mu of eq. (10)
  /// Of the coefficient, also of pairs, where friction may stick.
  FrictionFactor friction_factor{};
  /// Material streams past the partner, and friction may stick (docs/rolling.md); surfaces without
  /// a track have no friction.
  std::optional<Rolling<dim>> rolling{};
  double rho = 1;                 ///< [stress / length]
  std::optional<double> speed{};  ///< that the scene gives, for nominal_speed() [length / time]
};

/// Where the shape is an unknown, and how the mesh follows the worn surface.
template <int dim>
struct ShapeMotion {
  NodalFlags<dim> held;  ///< 1 where d is held at zero, by node of the mesh
  /// Of the nodes whose d keeps to a plane or line oblique to the coordinate directions: the
  /// projector on it, zero in the components that `held` holds.
  NodalProjectors<dim> along{};
  MeshMotionLaw law{};  ///< eq. (20)
  ConstraintForm constraint = ConstraintForm::eliminated;
  /// Wear is a gap (gap_motion.hpp): cells keep their initial shape.
  bool gap = false;

  /// Projector on the directions in which the shape of a node may move.
  Tensor<dim> free(int node) const {
    if (const auto found = along.find(node); found != along.end()) return found->second;
    return (1 - held.row(node).template cast<double>().array()).matrix().asDiagonal();
  }
};

/// What an assembly is made of; whoever makes one gives all that is not defaulted.
template <int dim>
struct AssemblyParts {
  Mesh<dim> mesh;
  /// Groups of its cells, together all of them. Those that share nodes are bonded. Their section
  /// says whether they are bodies of revolution about r = 0, in coordinates (r, z): then forces,
  /// areas and volumes are those of the whole circumference, and nodes on the axis are held
  /// (held_on_axis()).
  std::vector<Body> bodies;
  Supports<dim> supports;
  std::vector<Load<dim>> loads{};
  std::vector<Load<dim>> swinging_loads{};  ///< with a swing, beside what presses the bodies
  Interface<dim> interface;
  /// Contact of the bodies with each other: then they have no rigid partner, of which the approach
  /// alone is read, and the facets of the pairs are those of the interface's surfaces.
  std::vector<MortarPair<dim>> pairs{};
  /// Of pairs, by phase: positions of the nodes where facets that may meet are found, in the frames
  /// of the bodies [length]; empty: where the bodies first touch each other.
  std::vector<std::vector<Vector<dim>>> near{};
  ShapeMotion<dim> shape;
  std::optional<CyclicContact<dim>> cycle{};
  std::vector<Phase<dim>> phases{};             ///< of the cycle; empty: one steady state
  std::optional<CrossSection> cross_section{};  ///< 3D only: uniform along x
  double copies = 1;  ///< number of modelled parts in the whole body (symmetry)
  Scales scales{};
  LinearSolverMaker solver{};
  /// Where wear is a gap: how the mesh would follow it, for an estimate of the difference.
  std::optional<ShapeMotion<dim>> following{};
  bool condensed = false;  ///< the elasticity is condensed to the contact nodes (condensation.hpp)
  /// Of a `condensed` assembly, which makes it where there is none yet of its contact nodes.
  std::shared_ptr<const Condensation<dim>> condensation{};
  double memory = 0;                     ///< ModelFacts::memory
  std::vector<std::string> remarks{};    ///< ModelFacts::remarks
  std::vector<std::string> proposals{};  ///< ModelFacts::proposals
  std::vector<MeshPart> named_parts{};   ///< of a mesh from a file, for its result to keep

  Section section() const { return bodies.front().element.section; }
  /// The contact states: the phases of the cycle, or the steady state.
  std::vector<Phase<dim>> instants() const {
    if (!phases.empty()) return phases;
    return {{.counter_body = interface.partner, .force = interface.force, .places = {}}};
  }
  /// With which the sliding distance is counted, s = speed t: the given one, or that of the motion,
  /// its mean over the phases [length / time].
  double nominal_speed() const {
    if (interface.speed) return *interface.speed;
    return mean_over(instants(), [this](const Phase<dim>& phase) {
      return phase.counter_body.motion.nominal_speed(interface.streaming);
    });
  }
  /// The same of a surface: that of the first of the pairs that touch it.
  double nominal_speed(const Surface<dim>& surface) const;
};

/// Parts that fit together, and what follows from them.
template <int dim>
struct Assembly : AssemblyParts<dim> {
  /// Throws InputError where the parts do not fit: bodies that are not all cells, flags that are
  /// not for all nodes, a surface without facets, a track whose nodes lie on no lines or are not
  /// held alike, elements that are too long, a load too small to strain the bodies; what
  /// Condensation throws.
  explicit Assembly(AssemblyParts<dim> parts);

  std::vector<ContactPatch<dim>> contact_nodes;  ///< of all surfaces
  std::vector<int> surface_of;                   ///< by contact node: the surface that wears it
  bool wears(int contact_node) const {
    return this->interface.surfaces[surface_of[contact_node]].wears;
  }
  /// The contact node at a mesh node that has one.
  int contact_node(int node) const {
    const auto at = std::ranges::lower_bound(contact_nodes, node, {}, &ContactPatch<dim>::node);
    return static_cast<int>(at - contact_nodes.begin());
  }
  /// By contact node: whether it carries a multiplier. Sums over the contact are taken over these:
  /// the nodes of masters meet the same pressures a second time.
  std::vector<char> carries;
  /// By node: that which carries its shape unknowns. Of a cross-section, and of tracks; empty: each
  /// has its own.
  std::vector<int> carrier;
  /// By node: along which its shape moves where that differs along a line, out of the body, unit;
  /// of others zero; empty: of all.
  NodalField<dim> shape_direction;
  /// By contact node: its part in the wear rate of its shape unknowns; empty: 1. Where it shares
  /// them, the length that it represents divided by the length of the path.
  std::vector<double> wear_weight;
  std::vector<double>
      track_length;          ///< by surface: of the mesh of its track; empty: none has one [length]
  std::vector<int> body_of;  ///< by cell
};

/// The force k A^ u^ of the moved ends of springs, at factor one, nodes x dim [force].
template <int dim>
NodalField<dim> pull_of(const SpringSupport<dim>& springs, const AssemblyParts<dim>& parts);

/// The forces of a load at factor one on the unworn bodies, nodes x dim [force].
template <int dim>
NodalField<dim> forces_of(const Load<dim>& load, const AssemblyParts<dim>& parts);

/// Of all surfaces, one after the other.
template <int dim>
std::vector<typename Mesh<dim>::Facet> facets_of(const std::vector<Surface<dim>>& surfaces);

/// The contact nodes of the surfaces of an assembly.
template <int dim>
std::vector<ContactPatch<dim>> contact_nodes_of(const AssemblyParts<dim>& parts);

/// Flags of what a body of revolution cannot do: on the axis u_r = d_r = 0. Throws InputError like
/// axis_nodes().
NodalFlags<2> held_on_axis(const Mesh<2>& mesh);

}  // namespace gnomon
