// What a problem builds from a scene: the differential-algebraic system to integrate, its start,
// and the observations of a state. Integrators, results and the run loop use only this interface.
#pragma once

#include <array>
#include <functional>
#include <gnomon/base/counters.hpp>
#include <gnomon/mesh/mesh.hpp>
#include <gnomon/model/examination.hpp>
#include <gnomon/model/observation.hpp>
#include <gnomon/system/state.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// The mesh in its initial configuration, in the form for files. In 2D, z is zero.
struct Grid {
  enum class Cell { quadrilateral, hexahedron };
  Cell cell = Cell::quadrilateral;
  std::vector<std::array<double, 3>> points;  ///< [length]
  std::vector<int> cells;                     ///< node indices, 4 or 8 per cell, VTK order
  std::vector<MeshPart> parts{};              ///< of a mesh from a file

  std::size_t corners() const { return cell == Cell::quadrilateral ? 4 : 8; }  ///< of a cell
  std::size_t cell_count() const { return cells.size() / corners(); }
};

/// A field over the grid. `values` is row-major, with `components` values per point (or cell).
struct GridField {
  enum class On { nodes, cells };
  std::string name;
  std::string unit;
  On on = On::nodes;
  int components = 1;  ///< 1, or 3 for a vector (z = 0 in 2D)
  std::vector<double> values;
};

/// The potential contact surface; all arrays have one entry per contact node, in surface order.
struct ContactSurface {
  int dim = 2;
  std::vector<int> node;                       ///< index of the node in the grid
  std::vector<std::array<double, 3>> initial;  ///< X^, initial configuration [length]
  std::vector<std::array<double, 3>> worn;     ///< X, undeformed (worn) configuration [length]
  std::vector<std::array<double, 3>> current;  ///< x, deformed configuration [length]
  std::vector<double> pressure;                ///< nominal contact pressure, >= 0 [stress]; over a
                                               ///< cycle its mean
  std::vector<double> wear_depth;              ///< |X - X^| [length]
  std::vector<int> active;                     ///< 1 where in contact, in any phase of a cycle
  // Of a cycle:
  std::vector<double> phase_position{};  ///< tau of each phase
  std::vector<double> phase_weight{};    ///< its part of the mean
  std::vector<double> phase_pressure{};  ///< phases x contact nodes [stress]
  // Where friction may stick:
  std::vector<double> phase_traction{};  ///< phases x contact nodes x dim: of friction on the body,
                                         ///< per nominal area [stress]
  std::vector<double> phase_slip{};      ///< the same: of the body on its partner, since the phase
                                         ///< before [length]
  /// Phases x 2 dim: how far the partner is from its place [length], and the force that drives and
  /// presses it [force].
  std::vector<double> phase_loop{};
  /// Phases x 2, where the partner turns: its angle, and the moment about its axis [force length].
  std::vector<double> phase_turn{};
  std::vector<int> body{};  ///< of pairs: the number of the connected body of each node
};

/// By node of the grid: the number of the connected body that it belongs to, from 0 in the order of
/// their first nodes.
std::vector<int> connected_bodies(const Grid& grid);
/// Sets ContactSurface::body where the grid has several.
void find_bodies(const Grid& grid, ContactSurface& surface);

/// The surface of the counter-body near the body, for figures and viewers. A facet has the
/// counter-body on its left (2D), or corners that are anticlockwise as seen from outside of it
/// (3D).
struct CounterSurface {
  int dim = 2;
  std::vector<std::array<double, 3>> points;  ///< current positions [length]; in 2D, z is zero
  std::vector<int> facets;                    ///< indices of points, 2 (2D) or 4 (3D) per facet
};

/// Names and sizes of the unknown blocks, for `gnomon check` and the summary.
struct BlockSize {
  std::string name;    ///< "displacement", "shape", "contact_multiplier", ...
  std::string symbol;  ///< "u", "d", "lambda", ...
  long size = 0;       ///< number of unknowns
  std::string where;   ///< "all nodes", "contact nodes", ...
};

/// The error of the mean over the phases of a cycle (docs/cycles.md).
struct PhaseError {
  double t = 0;      ///< of the state [time]
  long phases = 0;   ///< P
  double error = 0;  ///< of the mean wear rate over P phases, relative
};

/// A state at or beside the last one that there is.
struct Limit {
  std::string reason;   ///< for the user
  bool passed = false;  ///< the state means nothing any more
};

class Model;

/// The beginning of an epoch: a model that follows another one in the same run, because its
/// structure had to change (other candidates of contact, a new mesh).
struct Succession {
  std::shared_ptr<const Model> model;
  State state;  ///< the last state, in the unknowns of `model`; consistent
  /// Whether the unknowns and switching functions keep their number and order, so that only the
  /// pattern of J is new: then every method goes on. Otherwise those of several steps restart.
  bool same_unknowns = false;
};

/// What is known of a model before it is solved.
struct ModelFacts {
  /// Their sizes sum to system().structure().size.
  std::vector<BlockSize> blocks;
  /// Typical size of the differential components over the run, for absolute tolerances: the mean
  /// wear depth.
  double differential_scale = 1;
  std::optional<Grid> grid{};  ///< the mesh, if there is one
  /// What was repaired, chosen or is doubtful in what the scene gives, in sentences for the user.
  std::vector<std::string> remarks{};
  /// Simpler models that would do, in sentences for the user.
  std::vector<std::string> proposals{};
  double memory = 0;  ///< estimate of the peak of a run [bytes]; 0: there is none
  long phases = 1;    ///< of a cycle, at which the deformation is taken
  /// Bound of steps that are chosen by the error, which may step over a motion [time]; 0: none.
  double longest_step = 0;
};

/// What a model can do beyond its contract; empty is what it cannot. The functions keep a reference
/// to the model, and take consistent states.
struct Abilities {
  /// The volume that wears per time as a function of a point of system(), on its branch; its
  /// integral over time is wear_integral. Throws like residual().
  std::function<double(const Point&)> wear_flux{};
  /// Of a cycle: the error of the mean over its phases, estimated with others, as a part of the
  /// mean wear rate now or until now, whichever is larger; absent where nothing wears. Throws
  /// InputError or SolutionError where other phases have no deformation.
  std::function<std::optional<PhaseError>(const State&)> phase_error{};
  /// The consistent state with this worn shape and time, found phase by phase as at the start,
  /// behind a jump that is too far for Newton's method. Throws SolutionError.
  std::function<State(const State&)> behind_jump{};
  /// Asked after every accepted step: the model that goes on from there instead of this one, a pure
  /// function of the state, so that a result can be read again from the states at which epochs
  /// began. Observations go on across it: worn volumes and depths are those since the start of the
  /// run. Nothing: this model goes on. Throws SolutionError where it cannot.
  std::function<std::optional<Succession>(const State&)> succeed{};
  /// Whether a step has gone beyond where another model should have followed: it is repeated in
  /// shorter ones.
  std::function<bool(const State&)> overdue{};
  /// Facts by which the numbers of a state can be believed or not.
  std::function<Examination(const State&)> examine{};
  std::function<CounterSurface(const State&)> counter_surface{};
  /// The solution at time t in closed form, where it is known: y of the differential components
  /// (zero elsewhere), and the state's time.
  std::function<std::optional<State>(double t)> exact{};
  /// Asked after every accepted step, where no step would succeed soon: the run ends, and steps
  /// that have passed the limit are repeated in shorter ones. Nothing: it goes on.
  std::function<std::optional<Limit>(const State&)> limit{};
};

class Model : public ModelFacts, public Abilities {
public:
  Model() = default;
  Model(const Model&) = delete;
  virtual ~Model() = default;

  /// The DAE and its algebraic stages.
  virtual const System& system() const = 0;
  /// Consistent state at t = 0. Throws SolutionError with the reason if there is none.
  virtual State start(Counters& counters) const = 0;
  /// The scalars of a state; always the same names in the same order.
  virtual Observation observe(const State& state) const = 0;
  /// Fields over the grid; always the same names in the same order. Empty without a grid.
  virtual std::vector<GridField> fields(const State& state) const = 0;
  /// The contact surface, if the problem has one.
  virtual std::optional<ContactSurface> contact(const State& state) const = 0;
};

}  // namespace gnomon
