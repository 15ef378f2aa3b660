// The result file of a run: one HDF5 file that is readable at every moment, and an XDMF sidecar
// over the same datasets. Layout: docs/results.md.
#pragma once

#include <filesystem>
#include <gnomon/base/counters.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/model.hpp>
#include <gnomon/results/result_files.hpp>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// Facts about a run that are known before its first step.
struct RunHeader {
  std::string problem;
  std::string integrator;
  std::string scene;                            ///< Scene::resolved()
  std::map<std::string, std::string> versions;  ///< "gnomon", "SUNDIALS", "HDF5", ...
  std::vector<BlockSize> blocks;
  /// time.end of which the model was made, where it is not that of the scene: a run that went on to
  /// a later one; 0: that of the scene [time].
  double model_end = 0;
};

/// One line of the history: the start (step 0) or an accepted step.
struct HistoryRow {
  double t = 0;
  StepReport step;
  Counters counters;            ///< totals so far
  std::vector<Scalar> scalars;  ///< Model::observe and wear_integral; same names in every row
};

/// The data from which a run can continue: its position in the result, and everything on which its
/// next steps depend.
struct Checkpoint {
  long number = 0;  ///< 0, 1, ... within the run
  long rows = 0;    ///< rows of the history up to here
  long stored = 0;  ///< steps stored up to here
  std::vector<double>
      numbers;     ///< made and read by the run loop; their count is constant in an epoch
  long epoch = 0;  ///< in which it was written
};

/// The beginning of an epoch (Succession): what the run had done until then, and its state, from
/// which the model that follows is made again.
struct EpochStart {
  long rows = 0;    ///< rows of the history up to here
  long stored = 0;  ///< steps stored up to here
  std::vector<double>
      numbers;  ///< the last state of the model before; made and read by the run loop
};

/// Writes a result step by step. Several threads may each use their own writers and readers. When a
/// call has returned, its data are in the file, and every HDF5 reader can open the file even if
/// this process is killed at any later instant, also during a write (docs/results.md explains why).
/// A call that cannot write throws Error; the file then keeps everything up to the previous call,
/// and later calls throw as well.
class ResultWriter {
public:
  /// Creates the file and its sidecar (same name, .xdmf). Earlier ones are refused, or replaced by
  /// the first append() of a row later than `from` [time], or by close() when one at `from` has
  /// been the last: until then the new file is FILE.part, which is removed if this does not happen.
  /// Calls throw Error when somebody has deleted, moved or replaced the file.
  /// Throws InputError when the file cannot be created there, when an earlier one is refused, and
  /// while another run is writing it; an earlier file is then untouched.
  ResultWriter(const std::filesystem::path& file, const RunHeader& header,
               const std::optional<Grid>& grid, Earlier earlier = Earlier::refused,
               double from = -std::numeric_limits<double>::infinity());
  ~ResultWriter();
  ResultWriter(const ResultWriter&) = delete;
  ResultWriter& operator=(const ResultWriter&) = delete;

  /// Appends a history row (every step).
  void append(const HistoryRow& row);
  /// Stores fields (nodal or cell values of the grid, 1 or 3 components), contact surface and
  /// counter-body of a state: the steps that the scene requests, in order of time.
  void store(double t, const std::vector<GridField>& fields,
             const std::optional<ContactSurface>& contact,
             const std::optional<CounterSurface>& counter_body = {});
  /// Of a cycle: an error of the mean over its phases.
  void append_phase_error(const PhaseError& error);
  /// The error budget of a finished run, as JSON: once, before close().
  void write_budget(const std::string& json);
  /// A new epoch begins: fields and contact surfaces that follow belong to this grid; checkpoints
  /// have another size.
  void begin_epoch(const EpochStart& start, const std::optional<Grid>& grid);
  /// Stores a checkpoint; it replaces the one before the last of its epoch.
  void checkpoint(const Checkpoint& checkpoint);
  /// Records how the run ended: "finished", "interrupted", "failed: ..." (the first 1024 bytes),
  /// with wall seconds, and brings the file to the medium (fsync). A file without any row is
  /// removed.
  void close(const std::string& status, double wall_seconds);
  /// The same after an exception: it never replaces an earlier result.
  void abandon(const std::string& status, double wall_seconds);

private:
  class File;
  std::unique_ptr<File> file_;
};

/// Reads a result, finished or not. Every member throws InputError for a file that is missing, not
/// HDF5, damaged, or not a gnomon result.
class ResultReader {
public:
  explicit ResultReader(const std::filesystem::path& file);
  ~ResultReader();

  const RunHeader& header() const;
  std::string status() const;   ///< as given to close(), or "running or crashed"
  double wall_seconds() const;  ///< 0 when not closed
  /// The history, one row per step, the start first.
  std::vector<HistoryRow> history() const;
  std::vector<double> stored_times() const;
  /// Of a cycle: the errors of the mean over its phases, in ascending order of time.
  std::vector<PhaseError> phase_errors() const;
  std::string budget() const;  ///< its error budget as JSON; empty: it has none
  /// The beginnings of the epochs after the first.
  std::vector<EpochStart> epochs() const;
  /// The complete checkpoints of the last epoch that has one, in ascending order: two, one or none.
  std::vector<Checkpoint> checkpoints() const;
  /// Contact surface of the stored step at `t`, or of the last one. The step must be within 1e-9 of
  /// the run's length, or be the only one within 1e-5 of its own time (times are printed with six
  /// digits); otherwise throws InputError that names the stored times next to `t`.
  ContactSurface contact(std::optional<double> t) const;
  /// A field of the stored step with index `step`.
  GridField field(std::size_t step, const std::string& name) const;
  /// The counter-body at that step; none in results of problems, or of versions, without one.
  std::optional<CounterSurface> counter_surface(std::size_t step) const;
  bool has_contact() const;                      ///< whether the problem has a contact surface
  std::vector<std::string> field_names() const;  ///< of the first stored step, sorted
  /// The epoch of a stored step; 0 is the first.
  std::size_t epoch_of(std::size_t step) const;
  std::optional<Grid> grid(std::size_t epoch = 0) const;

private:
  class File;
  std::unique_ptr<File> file_;
};

/// Of a cycle: the error of the mean over its phases at the start, if there is one. That of the end
/// does not belong to a run that goes on.
std::vector<PhaseError> start_errors(const ResultReader& from);

/// Writes to `to` the contents that a result had at its last checkpoint, in their original order,
/// and its checkpoints. `fields`: the names in the order in which fields are written. Throws like
/// the reader and the writer.
void copy_to_last_checkpoint(const ResultReader& from, const std::vector<std::string>& fields,
                             ResultWriter& to);

/// A spatial collection of grids: "body", its cells, and one grid with the name of each part, its
/// facets or points. Each has the nodes that it uses. All numbers are in the file itself. `axes`:
/// names of the coordinates, "x y".
std::string mesh_view(const Grid& grid, const std::string& axes);

/// Whether the file begins like those of mesh_view.
bool is_mesh_view(const std::filesystem::path& file);

}  // namespace gnomon
