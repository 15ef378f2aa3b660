#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <gnomon/results/results.hpp>

#include "results/crash_safe_file.hpp"
#include "results/epoch_groups.hpp"
#include "results/hdf5_values.hpp"
#include "results/history_table.hpp"
#include "results/layout.hpp"
#include "results/replaced_file.hpp"
#include "results/stored_mesh.hpp"
#include "results/stored_steps.hpp"
#include "results/xdmf_sidecar.hpp"

namespace gnomon {

using hdf5::check;
using hdf5::Handle;
using layout::create_group;

class ResultWriter::File {
public:
  File(const std::filesystem::path& path, const RunHeader& header, const std::optional<Grid>& grid,
       Earlier earlier, double from);
  ~File();

  void append(const HistoryRow& row);
  void append_phase_error(const PhaseError& error);
  void write_budget(const std::string& json);
  void store(double t, const std::vector<GridField>& fields,
             const std::optional<ContactSurface>& contact,
             const std::optional<CounterSurface>& counter_body);
  void begin_epoch(const EpochStart& start, const std::optional<Grid>& grid);
  void checkpoint(const Checkpoint& checkpoint);
  void end(const std::string& status, double wall_seconds, bool whole);
  // Runs an action of a public function: HDF5 prints nothing, and after a failure nothing more is
  // written to the disk, which keeps the last committed state.
  void guarded(const std::function<void()>& action);

private:
  void create(const RunHeader& header, const std::optional<Grid>& grid);
  void check_earlier() const;
  void publish();
  void discard() noexcept;
  void require_name();
  void withdraw();
  const char* what_is_left() const;
  void flush();

  std::filesystem::path path_;
  Earlier earlier_;
  double from_;
  bool published_ = false;
  bool has_rows_ = false;  // on the disk
  double reached_ = 0;
  std::optional<hdf5::CrashSafeFile> disk_;
  // Released in reverse order, the file last.
  Handle file_, gnomon_, epoch_, checkpoints_;
  layout::StoredSteps steps_;
  layout::GrowingTable history_, phase_errors_;
  std::vector<layout::Column> columns_;
  std::optional<XdmfSidecar> sidecar_;
  std::optional<Grid> grid_;
  std::size_t epochs_ = 0;  // after the first
  bool failed_ = false;
};

ResultWriter::File::File(const std::filesystem::path& path, const RunHeader& header,
                         const std::optional<Grid>& grid, Earlier earlier, double from)
    : path_(replaceable(path)), earlier_(earlier), from_(from) {
  const hdf5::Session session;
  try {
    if (sidecar_of(path_) == path_) throw Error("the suffix .xdmf is the sidecar's");
    disk_.emplace(part_of(path_));
    check_earlier();  // the part is claimed now, so no other run gives a file this name
    create(header, grid);
    // An earlier result stays until this run has a better one.
    if (!is_taken(path_) && !is_taken(sidecar_of(path_))) publish();
  } catch (const std::exception& error) {
    discard();
    throw InputError(fmt::format("cannot create {}: {}", path.string(), error.what()));
  }
}

void ResultWriter::File::flush() {
  check(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL), "flush the file");
  disk_->require_written();
}

void ResultWriter::File::check_earlier() const {
  const auto sidecar = sidecar_of(path_);
  if (earlier_ == Earlier::refused) {
    if (is_taken(path_)) throw Error("it exists");
    if (is_taken(sidecar)) throw Error(fmt::format("{} exists", sidecar.string()));
  }
  if (is_claimed(path_)) throw Error("another run is writing it");
}

void ResultWriter::File::create(const RunHeader& header, const std::optional<Grid>& grid) {
  file_ = layout::create_file(*disk_, part_of(path_));
  gnomon_ = create_group(file_.id(), "gnomon", 10);
  layout::write_header(gnomon_.id(), header);
  steps_ = {file_.id(), gnomon_.id()};
  grid_ = grid;
  if (grid) {
    layout::write_mesh(file_.id(), *grid);
    sidecar_.emplace(path_, *grid);
  }
  flush();
}

// The sidecar first: without steps it is valid for both files, and if it cannot be written, the
// earlier result still exists.
void ResultWriter::File::publish() {
  if (sidecar_) {
    sidecar_->publish(earlier_);
  } else {
    std::filesystem::remove(sidecar_of(path_));
  }
  publish_part(path_, earlier_);
  published_ = true;
  disk_->share();
}

void ResultWriter::File::discard() noexcept {
  if (!disk_) return;  // the part belongs to another run
  disk_->abandon();
  std::error_code ignored;
  std::filesystem::remove(part_of(path_), ignored);
}

ResultWriter::File::~File() {
  if (!published_) discard();
}

void ResultWriter::File::guarded(const std::function<void()>& action) {
  if (failed_) throw Error(fmt::format("{}: an earlier write failed", path_.string()));
  const hdf5::Session session;
  try {
    action();
  } catch (const std::exception& error) {
    failed_ = true;
    disk_->abandon();
    require_name();
    throw Error(fmt::format("{}: {} ({})", path_.string(), error.what(), what_is_left()));
  }
  require_name();
}

// Without the file nobody will find what this run computes, and the sidecar refers to nothing.
void ResultWriter::File::require_name() {
  if (!published_ || disk_->has_name(path_)) return;
  failed_ = true;
  disk_->abandon();
  std::error_code ignored;
  if (is_sidecar(sidecar_of(path_))) std::filesystem::remove(sidecar_of(path_), ignored);
  throw Error(
      fmt::format("{}: somebody has deleted, moved or replaced it while this run wrote it; "
                  "the run ends",
                  path_.string()));
}

const char* ResultWriter::File::what_is_left() const {
  if (!published_) return "nothing of this run is left; earlier files are kept";
  if (!has_rows_) return "the result holds no step";
  return "the result holds everything up to the previous step";
}

void ResultWriter::File::append(const HistoryRow& row) {
  if (!history_) {
    columns_ = layout::columns_of(row);
    history_ = {gnomon_.id(), "history", layout::history_type(columns_)};
    std::vector<std::string> units;
    for (const layout::Column& column : columns_) units.push_back(column.unit);
    hdf5::write_attribute(history_.dataset(), "units", units);
  }
  if (!std::ranges::equal(columns_, layout::columns_of(row), {}, &layout::Column::name,
                          &layout::Column::name))
    throw Error("the scalars of a history row are not those of the first row");
  history_.append(layout::cells_of(row).data());
  flush();
  has_rows_ = true;
  reached_ = row.t;
  if (!published_ && reached_ > from_) publish();
}

void ResultWriter::File::store(double t, const std::vector<GridField>& fields,
                               const std::optional<ContactSurface>& contact,
                               const std::optional<CounterSurface>& counter_body) {
  const layout::StoredStep step = steps_.write(t, fields, contact, counter_body, grid_);
  flush();
  steps_.count(step);  // a separate commit: the step counts as stored when it is complete
  flush();
  if (sidecar_) sidecar_->add_step(t, "/" + step.path, fields, step.surface);
}

void ResultWriter::File::append_phase_error(const PhaseError& error) {
  if (!phase_errors_) phase_errors_ = layout::create_phase_errors(gnomon_.id());
  layout::append_phase_error(phase_errors_, error);
  flush();
}

void ResultWriter::File::write_budget(const std::string& json) {
  hdf5::write_attribute(gnomon_.id(), "budget", json);
  flush();
}

void ResultWriter::File::begin_epoch(const EpochStart& start, const std::optional<Grid>& grid) {
  const bool same = grid.has_value() == grid_.has_value() &&
                    (!grid || (grid->points == grid_->points && grid->cells == grid_->cells));
  epoch_ = layout::begin_epoch(gnomon_.id(), ++epochs_, start, same ? std::nullopt : grid);
  flush();
  layout::finish_epoch(epoch_);
  flush();
  checkpoints_ = {};
  if (same) return;
  grid_ = grid;
  if (sidecar_ && grid) sidecar_->set_mesh(*grid, "/gnomon/" + layout::epoch_path(epochs_));
}

void ResultWriter::File::checkpoint(const Checkpoint& checkpoint) {
  if (!checkpoints_)
    checkpoints_ =
        layout::create_checkpoints(epoch_ ? epoch_.id() : gnomon_.id(), checkpoint.numbers.size());
  layout::write_checkpoint(checkpoints_, checkpoint);
  flush();
}

// A run that has failed at its start holds nothing, and would be in the way of the next one.
void ResultWriter::File::withdraw() {
  disk_->abandon();
  published_ = false;
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
  if (sidecar_) std::filesystem::remove(sidecar_of(path_), ignored);
}

void ResultWriter::File::end(const std::string& status, double wall_seconds, bool whole) {
  if (published_ && !has_rows_) return withdraw();
  hdf5::write_attribute(gnomon_.id(), "wall_seconds", wall_seconds);
  hdf5::rewrite_attribute(gnomon_.id(), "status", status);
  flush();
  if (!published_ && whole && has_rows_ && reached_ >= from_) publish();
  disk_->sync();
}

ResultWriter::ResultWriter(const std::filesystem::path& file, const RunHeader& header,
                           const std::optional<Grid>& grid, Earlier earlier, double from)
    : file_(std::make_unique<File>(file, header, grid, earlier, from)) {}

ResultWriter::~ResultWriter() {
  const hdf5::Session session;
  file_.reset();
}

void ResultWriter::append(const HistoryRow& row) {
  file_->guarded([&] { file_->append(row); });
}

void ResultWriter::append_phase_error(const PhaseError& error) {
  file_->guarded([&] { file_->append_phase_error(error); });
}

void ResultWriter::write_budget(const std::string& json) {
  file_->guarded([&] { file_->write_budget(json); });
}

void ResultWriter::store(double t, const std::vector<GridField>& fields,
                         const std::optional<ContactSurface>& contact,
                         const std::optional<CounterSurface>& counter_body) {
  file_->guarded([&] { file_->store(t, fields, contact, counter_body); });
}

void ResultWriter::begin_epoch(const EpochStart& start, const std::optional<Grid>& grid) {
  file_->guarded([&] { file_->begin_epoch(start, grid); });
}

void ResultWriter::checkpoint(const Checkpoint& checkpoint) {
  file_->guarded([&] { file_->checkpoint(checkpoint); });
}

void ResultWriter::close(const std::string& status, double wall_seconds) {
  file_->guarded([&] { file_->end(status, wall_seconds, true); });
}

void ResultWriter::abandon(const std::string& status, double wall_seconds) {
  file_->guarded([&] { file_->end(status, wall_seconds, false); });
}

}  // namespace gnomon
