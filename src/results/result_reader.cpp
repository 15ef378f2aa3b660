#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <gnomon/results/results.hpp>
#include <thread>

#include "results/epoch_groups.hpp"
#include "results/hdf5_values.hpp"
#include "results/history_table.hpp"
#include "results/layout.hpp"
#include "results/replaced_file.hpp"
#include "results/stored_mesh.hpp"

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

ContactSurface read_contact(hid_t file, const std::string& path) {
  if (!hdf5::exists(file, path)) throw Failure("the problem has no contact surface");
  const Handle dataset = hdf5::open_dataset(file, path, "read the contact surface");
  const auto rows = layout::read_rows<layout::ContactRow>(dataset, layout::contact_type(),
                                                          "read the contact surface");
  ContactSurface contact;
  const double dim = hdf5::read_number_attribute(dataset.id(), "dim");
  if (dim != 2 && dim != 3)
    throw Failure(fmt::format("cannot read the contact surface: it has {} dimensions", dim));
  contact.dim = static_cast<int>(dim);
  for (const layout::ContactRow& row : rows) {
    contact.node.push_back(static_cast<int>(row.node));
    contact.initial.push_back(row.initial);
    contact.worn.push_back(row.worn);
    contact.current.push_back(row.current);
    contact.pressure.push_back(row.pressure);
    contact.wear_depth.push_back(row.wear_depth);
    contact.active.push_back(static_cast<int>(row.active));
  }
  return contact;
}

GridField read_field(hid_t file, const std::string& step, const std::string& name) {
  if (name.empty() || name.find('/') != std::string::npos || !hdf5::exists(file, step) ||
      !hdf5::exists(file, step + "/" + name)) {
    throw Failure(fmt::format("it has no field {}", name));
  }
  const std::string path = step + "/" + name;
  const Handle dataset = hdf5::open_dataset(file, path, "read a field");
  GridField field;
  field.name = name;
  field.unit = hdf5::read_text_attribute(dataset.id(), "unit");
  field.on = hdf5::read_text_attribute(dataset.id(), "on") == "cells" ? GridField::On::cells
                                                                      : GridField::On::nodes;
  auto data = hdf5::read_numbers<double>(file, path);
  field.components = data.extents.size() == 2 ? static_cast<int>(data.extents[1]) : 1;
  field.values = std::move(data.values);
  return field;
}

// The stored step at t (without t, the last one): the nearest within 1e-9 of the run's length, or
// the only one that agrees with t in the printed digits.
std::size_t find_step(const std::vector<double>& times, std::optional<double> t) {
  if (times.empty()) throw Failure("it has no stored step");
  if (!t) return times.size() - 1;
  if (!std::isfinite(*t)) throw Failure(fmt::format("it has no stored step at t = {}", *t));
  const auto distance = [&](double time) { return std::abs(time - *t); };
  const auto nearest = std::min_element(
      times.begin(), times.end(), [&](double a, double b) { return distance(a) < distance(b); });
  const double length = times.back() - times.front();
  if (distance(*nearest) <= 1e-9 * length || *nearest == *t) {
    return static_cast<std::size_t>(nearest - times.begin());
  }
  const auto alike = [&](double time) { return distance(time) <= 1e-5 * std::abs(time); };
  if (std::count_if(times.begin(), times.end(), alike) == 1) {
    return static_cast<std::size_t>(std::find_if(times.begin(), times.end(), alike) -
                                    times.begin());
  }
  const auto above = std::upper_bound(times.begin(), times.end(), *t);
  std::string next;
  if (above != times.begin()) next += fmt::format("{}", *(above - 1));
  if (above != times.begin() && above != times.end()) next += " and ";
  if (above != times.end()) next += fmt::format("{}", *above);
  throw Failure(fmt::format("it has no stored step at t = {}; next to it are t = {}", *t, next));
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

  std::vector<layout::StoredRow> stored() const {
    const Handle dataset = hdf5::open_dataset(gnomon_.id(), "stored", "read the stored steps");
    auto rows = layout::read_rows<layout::StoredRow>(dataset, layout::stored_type(),
                                                     "read the stored steps");
    for (layout::StoredRow& row : rows) row.path.back() = '\0';
    return rows;
  }

  std::vector<double> times() const {
    std::vector<double> times;
    for (const layout::StoredRow& row : stored()) times.push_back(row.t);
    return times;
  }

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
  ContactSurface surface = file_->guarded([&] {
    const std::size_t step = find_step(file_->times(), t);
    const std::string path = layout::step_path(step);
    ContactSurface contact = read_contact(file_->gnomon(), "contact/" + path);
    layout::read_phases(file_->gnomon(), path, contact);
    return contact;
  });
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
    return read_field(file_->file(), "steps/" + layout::step_path(step), name);
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
