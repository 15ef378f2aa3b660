#include <fmt/format.h>

#include <chrono>
#include <gnomon/results/results.hpp>
#include <thread>

#include "results/epoch_groups.hpp"
#include "results/hdf5_values.hpp"
#include "results/history_table.hpp"
#include "results/layout.hpp"
#include "results/replaced_file.hpp"
#include "results/stored_mesh.hpp"
#include "results/stored_steps.hpp"

namespace gnomon {

using hdf5::check;
using hdf5::Failure;
using hdf5::Handle;
using hdf5::own;

namespace {

Handle open_file(const std::filesystem::path& path) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) throw Failure("there is no such file");
  if (!std::filesystem::is_regular_file(status)) throw Failure("it is not a file");
  const htri_t hdf5 = H5Fis_hdf5(path.c_str());
  if (hdf5 == 0) throw Failure("it is not an HDF5 file");
  const Handle access = own(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "open it");
  check(H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG), "open it");
  return own(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose, "open it");
}

std::vector<BlockSize> read_blocks(hid_t gnomon) {
  const Handle dataset = hdf5::open_dataset(gnomon, "blocks", "read the blocks");
  std::vector<BlockSize> blocks;
  for (const auto& row :
       layout::read_rows<layout::BlockRow>(dataset, layout::block_type(), "read the blocks")) {
    blocks.push_back({layout::text_of(row.name), layout::text_of(row.symbol),
                      layout::count_of(row.size, "read the blocks"), layout::text_of(row.where)});
  }
  return blocks;
}

RunHeader read_header(hid_t gnomon) {
  RunHeader header;
  header.problem = hdf5::read_text_attribute(gnomon, "problem");
  header.integrator = hdf5::read_text_attribute(gnomon, "integrator");
  header.scene = hdf5::read_text(gnomon, "scene");
  if (H5Aexists(gnomon, "model_end") > 0)
    header.model_end = hdf5::read_number_attribute(gnomon, "model_end");
  const Handle versions = hdf5::open_group(gnomon, "versions", "read the versions");
  for (const std::string& name : hdf5::attribute_names(versions.id())) {
    header.versions[name] = hdf5::read_text_attribute(versions.id(), name.c_str());
  }
  header.blocks = read_blocks(gnomon);
  return header;
}

}  // namespace

// ResultReader is not used, because it refuses damaged results, which are results too.
bool is_result(const std::filesystem::path& file) {
  const hdf5::Session session;
  try {
    const Handle opened = open_file(file);
    const Handle gnomon = hdf5::open_group(opened.id(), "gnomon", "open its results");
    return hdf5::read_text_attribute(gnomon.id(), "format") == layout::kFormat;
  } catch (const std::exception&) {
    return false;
  }
}

class ResultReader::File {
public:
  // Runs an action of a public function and attributes every failure to the file. Every failure
  // that a damaged file causes, including a failed allocation, is reported in one line. A run in
  // progress may change the file between two reads of HDF5; then the action is repeated.
  template <class Action>
  auto guarded(Action action) {
    constexpr int most = 20;
    const hdf5::Session session;
    for (int attempt = 0;; ++attempt) {
      try {
        if (attempt > 0) open();
        return action();
      } catch (const std::exception& error) {
        if (attempt == most || !is_claimed(path_))
          throw InputError(fmt::format("cannot read {}: {}", path_.string(), error.what()));
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  }

  explicit File(const std::filesystem::path& path) : path_(path) {
    guarded([&] { open(); });
  }

  void open() {
    gnomon_ = {};
    file_ = {};
    file_ = open_file(path_);
    if (!hdf5::exists(file_.id(), "gnomon")) throw Failure("it is not a gnomon result");
    gnomon_ = hdf5::open_group(file_.id(), "gnomon", "open its results");
    const double version = hdf5::read_number_attribute(gnomon_.id(), "format_version");
    if (version != layout::kVersion) {
      throw Failure(
          fmt::format("its format is {}, this program reads {}", version, layout::kVersion));
    }
    header_ = read_header(gnomon_.id());
  }

  std::vector<double> times() const { return layout::read_stored_times(gnomon_.id()); }

  hid_t file() const { return file_.id(); }
  hid_t gnomon() const { return gnomon_.id(); }
  const RunHeader& header() const { return header_; }

private:
  std::filesystem::path path_;
  Handle file_, gnomon_;
  RunHeader header_;
};

ResultReader::ResultReader(const std::filesystem::path& file)
    : file_(std::make_unique<File>(file)) {}

ResultReader::~ResultReader() {
  const hdf5::Session session;
  file_.reset();
}

const RunHeader& ResultReader::header() const {
  return file_->header();
}

std::string ResultReader::status() const {
  return file_->guarded([&] { return hdf5::read_text_attribute(file_->gnomon(), "status"); });
}

std::string ResultReader::budget() const {
  return file_->guarded([&] {
    return H5Aexists(file_->gnomon(), "budget") > 0
               ? hdf5::read_text_attribute(file_->gnomon(), "budget")
               : std::string();
  });
}

double ResultReader::wall_seconds() const {
  return file_->guarded(
      [&] { return hdf5::read_number_attribute(file_->gnomon(), "wall_seconds"); });
}

std::vector<HistoryRow> ResultReader::history() const {
  return file_->guarded([&] { return layout::read_history(file_->gnomon()); });
}

std::vector<double> ResultReader::stored_times() const {
  return file_->guarded([&] { return file_->times(); });
}

std::vector<Checkpoint> ResultReader::checkpoints() const {
  return file_->guarded([&] {
    const std::size_t rows = layout::read_history(file_->gnomon()).size();
    const std::size_t stored = file_->times().size();
    auto checkpoints = layout::read_last_checkpoints(file_->gnomon());
    for (const Checkpoint& checkpoint : checkpoints)
      if (checkpoint.rows > long(rows) || checkpoint.stored > long(stored))
        throw Failure("it holds fewer steps than its checkpoint");
    return checkpoints;
  });
}

std::vector<EpochStart> ResultReader::epochs() const {
  return file_->guarded([&] { return layout::read_epochs(file_->gnomon()); });
}

std::vector<PhaseError> ResultReader::phase_errors() const {
  return file_->guarded([&] { return layout::read_phase_errors(file_->gnomon()); });
}

ContactSurface ResultReader::contact(std::optional<double> t) const {
  ContactSurface surface = file_->guarded(
      [&] { return layout::read_contact(file_->gnomon(), layout::find_step(file_->times(), t)); });
  const bool has_pairs = header().scene.find("\n[pair.") != std::string::npos;
  if (const std::optional<Grid> mesh = has_pairs ? grid() : std::nullopt)
    find_bodies(*mesh, surface);
  return surface;
}

bool ResultReader::has_contact() const {
  return file_->guarded(
      [&] { return hdf5::exists(file_->gnomon(), "contact/" + layout::step_path(0)); });
}

GridField ResultReader::field(std::size_t step, const std::string& name) const {
  return file_->guarded([&] {
    const std::size_t count = file_->times().size();
    if (step >= count)
      throw Failure(fmt::format("it has {} stored steps, not {}", count, step + 1));
    return layout::read_field(file_->file(), step, name);
  });
}

std::optional<CounterSurface> ResultReader::counter_surface(std::size_t step) const {
  return file_->guarded([&] {
    const Handle group =
        hdf5::open_group(file_->file(), "steps/" + layout::step_path(step), "read a step");
    return layout::read_surface(file_->file(), group.id());
  });
}

std::vector<std::string> ResultReader::field_names() const {
  return file_->guarded([&]() -> std::vector<std::string> {
    if (file_->times().empty()) return {};
    return hdf5::link_names(
        hdf5::open_group(file_->file(), "steps/" + layout::step_path(0), "list the fields").id());
  });
}

std::size_t ResultReader::epoch_of(std::size_t step) const {
  std::size_t epoch = 0;
  for (const EpochStart& start : epochs()) epoch += start.stored <= static_cast<long>(step);
  return epoch;
}

std::optional<Grid> ResultReader::grid(std::size_t epoch) const {
  return file_->guarded(
      [&] { return layout::read_grid_of_epoch(file_->file(), file_->gnomon(), epoch); });
}

}  // namespace gnomon
