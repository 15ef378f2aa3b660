// What ends a run whose numbers would be worthless, or which would not end: fixed steps that
// amplify the fastest mode, or hardly damp it; chattering, contact nodes that open and close again
// and again, as in steps above the critical one; a lack of progress, where every step succeeds,
// but needs ever more work for ever less time; and elements that are nearly worn away, or folded.
#pragma once

#include <gnomon/base/counters.hpp>
#include <gnomon/base/packed_numbers.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/model.hpp>
#include <gnomon/model/observation.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// Whether fixed steps of the method can be too long for stiff modes: explicit methods, and those
/// with |R| near one or above at infinity.
bool may_fail_to_damp(const Integrator& integrator, const IntegratorSettings& settings);

class DampingWatch {
public:
  /// Only if may_fail_to_damp(). Keeps references.
  DampingWatch(const Model& model, const Integrator& integrator,
               const IntegratorSettings& settings);
  /// Throws SolutionError if a step doubles the fastest mode at this state, or if more than half of
  /// it is left at the end of the run although it should have decayed. Does nothing if the spectrum
  /// cannot be computed.
  void require_damping(const State& state);
  /// The same check if contact is wider than at the last check: a single node in contact has no
  /// fast mode, a wide contact does.
  void require_damping_in_wider_contact(const State& state, const Observation& observed);
  /// Whether any of these states had a mode that decays. If contact is at a single node at every
  /// check, steps may still be far too long.
  bool has_seen_a_mode() const { return seen_; }

private:
  const Model& model_;
  const Integrator& integrator_;
  const IntegratorSettings& settings_;
  double widest_ = -1;  // contact nodes
  bool seen_ = false;
};

/// Throws SolutionError if nodes chatter.
void require_no_chattering(long chattering_nodes, const Integrator& integrator);

class ProgressWatch {
public:
  /// For a run that is at t, has done this work and ends at `end` [time].
  ProgressWatch(double t, const Counters& counters, double end);
  /// Called after every step. Throws SolutionError when the last most_newton_iterations
  /// (integrators/stop_times.hpp), steps among them, have advanced the run by less than 1e-5 of its
  /// length: at that rate the whole run would take 5e8 iterations, that is six days at a
  /// millisecond each.
  void require(double t, const Counters& counters);

private:
  double t_;   // time at which the present count of iterations began
  long work_;  // done by then
  double end_;
};

class Chattering {
public:
  /// Takes the contact surface after a step; a model without one never chatters.
  void add(const std::optional<ContactSurface>& surface);
  /// Called at a breakpoint of the load: a node may leave contact once more.
  void begin_anew();
  /// Nodes that have left contact twice or more between two breakpoints of the load.
  long nodes() const;

  void pack_into(std::vector<double>& numbers) const;
  void unpack_from(Unpacker& numbers);

private:
  std::vector<char> active_;
  std::vector<int> losses_;  // losses of contact, one entry per node
};

/// The part of its volume that an element keeps in every state of a run: with less, steps become
/// ever shorter without an end.
inline constexpr double least_element_volume = 0.01;
/// Why a run ends there.
std::string worn_away_text(double volume);

/// Throws SolutionError for a state with an element that is folded (element_quality not positive)
/// or has less than its least volume (element_volume), and for a body that is worn through
/// (thickness_left).
void require_sound_mesh(const Observation& observed);

struct MeshWarning {
  std::string about;  ///< subject; only one warning per subject is needed
  std::string text;
};

/// The least scaled Jacobian of a mesh before any wear; 1 without one.
double initial_quality(const std::optional<Grid>& grid);

/// Warnings when one of these limits is near (a tenth of the volume, a scaled Jacobian of 0.1), or
/// when small strains are not small (displacement_gradient above one half). `initial`: the
/// initial_quality() of the mesh; where it was below 0.1 already and wear has not halved it, the
/// warning is about the mesh, not about wear.
std::vector<MeshWarning> mesh_warnings(const Observation& observed, double initial);

/// Warns of an explicit method above its critical step, of wear that is missing in the shape by
/// more than `invisible`, of a worn volume of that size, and of a tolerance for much deeper wear
/// than there is.
std::vector<std::string> end_warnings(const Observation& last, double invisible,
                                      long chattering_nodes, const Integrator& integrator,
                                      const IntegratorSettings& settings);

/// Warns of an error of the mean over the phases of a cycle at the start that is larger than the
/// tolerance: about as large may that of the worn shape be; empty otherwise. At the end the shape
/// has the traces of the phases, so that the error of the mean there is several times that of the
/// shape.
std::string phase_warning(const PhaseError& at_start, double tolerance);

/// Size of the rounding errors of the worn volume, to an order of magnitude [mm^2 | mm^3]: a part
/// of the box around the mesh, or around the body of revolution that it is a section of (`dim` 3,
/// the axis being x = 0 of a mesh in the plane). Zero without a mesh: the volume is then a sum of
/// depths.
double invisible_volume(const std::optional<Grid>& grid, int dim);

/// Whether the worn volume differs from the wear integral by a tenth of it or more, and by more
/// than rounding errors; smaller differences may come from the mesh. False without wear.
bool has_lost_wear(const Observation& observed, double invisible);

}  // namespace gnomon
