// How wrong a result is, and by what: its error budget, from further runs of the same scene in each
// of which one thing is finer.
#pragma once

#include <functional>
#include <gnomon/model/model.hpp>
#include <gnomon/scene/scene.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// An error that is not known.
inline constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// What a run is made for: numbers of its end, and the worn surface.
struct Goals {
  double time = 0;      ///< end of the run [s]
  long nodes = 0;       ///< of the mesh; without one, unknowns
  double ledger = 0;    ///< |wear_difference| as a part of worn_volume
  double nonzeros = 0;  ///< of its Jacobian
  /// What the last closed nodes leave open of contact_area, as a part of it: half of
  /// contact_area_error, which is a bound, in space a quarter. None in plane strain without a
  /// cycle, where the ends of contact are found between nodes.
  double area = 0;
  /// In plane strain, where pressure reaches to the edges: nodal pressures times this are those
  /// over the distance of the ends of contact, in the place of the whole shares of the last closed
  /// nodes; and what these leave open of inner_pressure, as a part of it.
  double pressure_by_ends = 1, pressure_open = 0;
  /// Whether mean_pressure is over the distance of the ends of contact.
  bool by_ends = false;
  /// What of max_pressure a last closed node has more than all inside of the contact, as a part.
  double peak_at_edge = 0;
  /// What of wear_depth the end of a surface in the plane has more than what the depths beside it
  /// go on to, as a part, where two bodies touch: beside it, the other one wears by half an element
  /// on any mesh.
  double depth_at_edge = 0;
  /// Those that the problem has of worn_volume, wear_depth, profile, contact_half_width or (bodies
  /// in space and of revolution) contact_area, mean_pressure, inner_pressure, max_pressure,
  /// approach. profile is the paper's norm of the change of shape. mean_pressure is contact_force
  /// over contact_area, in plane strain over the distance of the ends of contact where it is
  /// straight; inner_pressure the root mean square over the nodes within 0.9 of each connected
  /// patch of the contact, from its middle to its edge.
  std::vector<Scalar> values;
  ContactSurface surface;
  std::vector<std::size_t> inner{};  ///< nodes of the surface to which inner_pressure belongs
  // Of the nodes of the surface:
  std::vector<double> edge{};  ///< the shortest to another one in its cells [length]
  std::vector<int> body{};     ///< its connected body
};

long nodes_of(const Model& model);

/// Of the state at the end of a run. Nothing without a worn surface.
std::optional<Goals> goals_of(const Model& model, const State& state, const Observation& observed);

/// The values minus those of another result, relative to themselves. Of profile the paper's norm of
/// the distances between the worn surfaces along the normal, of inner_pressure the root mean square
/// of differences of pressures over the distance of the ends; another mesh is interpolated linearly
/// to the nodes of `goals`. not_known where the value is zero, or the other result does not have
/// it.
std::vector<double> differences(const Goals& goals, const Goals& other);

/// Of the pressures of nodes as they are, for differences() between a result and a reference.
inline Goals with_nodal_pressures(Goals goals) {
  goals.pressure_by_ends = 1;
  return goals;
}

/// Whether the difference of this value is a norm, which has no sign: profile, inner_pressure.
bool is_norm(const std::string& value);

/// One part of the error.
struct BudgetPart {
  ErrorSource source = ErrorSource::time;
  std::string key;  ///< that governs it: "integrator.rtol"
  std::string how;  ///< "integrator.rtol 1e-04 against 1e-05, with mesh.factor = 2"
  /// Relative, one for each of Goals::values, or not_known.
  std::vector<double> errors;
  std::string unknown{};  ///< why none is known; empty: some are
  std::string doubt{};    ///< of which values meshes show that errors may be large, and why
};

struct Budget {
  std::vector<Scalar> values;  ///< Goals::values
  std::vector<BudgetPart> parts;
  double run_seconds = 0;        ///< CPU time of the run that is judged [s]
  double companion_seconds = 0;  ///< of the others [s]

  /// Sum of the known parts, relative; not_known where none is known, or one is in doubt.
  double total(std::size_t value) const;
};

struct BudgetHooks {
  /// Before each run: what differs in it.
  std::function<void(const std::string&)> on_run = [](const std::string&) {};
  /// Asked after each step; true ends with a SolutionError.
  std::function<bool()> interrupted = [] { return false; };
  /// Newton iterations times nonzeros of all companions after which the rest is not known.
  double limit = std::numeric_limits<double>::infinity();
  /// The same of their CPU time [s], which counts that factors fill in.
  double seconds = std::numeric_limits<double>::infinity();
  /// The parts to find.
  std::vector<ErrorSource> sources = {ErrorSource::time, ErrorSource::mesh, ErrorSource::model,
                                      ErrorSource::phases, ErrorSource::solves};

  bool wants(ErrorSource source) const;
};

/// Runs the scene, and with it companions: twice and four times as large elements, from which
/// Richardson's extrapolation with the observed order tells the error of the mesh; one with a finer
/// tolerance or step; and on the mesh of twice as large elements one with a finer value of every
/// other key that controls an error (Key::controls). Throws InputError where the scene has nothing
/// to judge, and SolutionError where its own run fails; what fails of a companion is in
/// BudgetPart::unknown.
Budget find_budget(const Scene& scene, const BudgetHooks& hooks);
/// The same of a run that has ended, with the error in time on the mesh of twice as large elements,
/// too. `scene` as Setup::scene has it.
Budget find_budget(const Scene& scene, const Goals& goals, const BudgetHooks& hooks);

/// That of a run that has ended, from companions on meshes of twice and four times as large
/// elements (after much work four and eight times), with simpler models where the scene allows
/// them: less sure, and for a fifth of the run's work, Newton iterations times nonzeros, or some
/// two seconds.
Budget quick_budget(const Scene& scene, const Goals& goals, double work, const BudgetHooks& hooks);

/// A table for a terminal, a line for each value, and why a part is not known.
std::string budget_table(const Budget& budget);
/// The same, and how each part was found.
std::string budget_text(const Budget& budget);
/// BudgetPart::doubt of each part that has one, in a line.
std::vector<std::string> budget_warnings(const Budget& budget);
/// As JSON, an object; and such text again. Throws InputError for another one.
std::string budget_json(const Budget& budget);
Budget budget_of_json(const std::string& text);

/// "integrator.rtol = 1e-05": keys that the second scene has otherwise.
std::string change_text(const Scene& from, const Scene& to);

/// "time", "mesh", "model", "phases", "solves".
std::string name_of(ErrorSource source);

}  // namespace gnomon
