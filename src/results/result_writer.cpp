#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <gnomon/results.hpp>

#include "results/crash_safe_file.hpp"
#include "results/growing_table.hpp"
#include "results/hdf5_values.hpp"
#include "results/history_table.hpp"
#include "results/layout.hpp"
#include "results/replaced_file.hpp"
#include "results/xdmf_sidecar.hpp"

namespace gnomon {

using hdf5::check;
using hdf5::Handle;
using hdf5::own;

namespace {

// A group that keeps its links in its own header, with room for `links` of them: one structure of
// less than a page, which is what changes when a step is added.
Handle create_group(hid_t parent, const std::string& name, std::size_t links) {
  constexpr unsigned kAlwaysCompact = 65535, kNameLength = 6;
  const Handle properties = own(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "create a group");
  check(H5Pset_link_phase_change(properties.id(), kAlwaysCompact, 0), "create a group");
  check(H5Pset_est_link_info(properties.id(), static_cast<unsigned>(links), kNameLength),
        "create a group");
  check(H5Pset_obj_track_times(properties.id(), false), "create a group");
  return own(H5Gcreate2(parent, name.c_str(), H5P_DEFAULT, properties.id(), H5P_DEFAULT), H5Gclose,
             "create a group");
}

Handle create_file(hdf5::CrashSafeFile& disk, const std::filesystem::path& path) {
  const Handle access = disk.access_list();
  const Handle creation = own(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "prepare the file");
  check(H5Pset_obj_track_times(creation.id(), false), "prepare the file");
  return own(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose,
             "create the file");
}

void write_mesh(hid_t file, const Grid& grid) {
  const Handle mesh = create_group(file, "mesh", 2);
  const hsize_t corners = grid.cell == Grid::Cell::quadrilateral ? 4 : 8;
  hdf5::write_dataset(mesh.id(), "points", {grid.points.size(), 3},
                      grid.points.empty() ? nullptr : grid.points.front().data());
  hdf5::write_dataset(mesh.id(), "cells", {grid.cells.size() / corners, corners},
                      grid.cells.data());
}

void write_header(hid_t gnomon, const RunHeader& header) {
  hdf5::write_attribute(gnomon, "format", std::string(layout::kFormat));
  hdf5::write_attribute(gnomon, "format_version", layout::kVersion);
  hdf5::write_attribute(gnomon, "problem", header.problem);
  hdf5::write_attribute(gnomon, "integrator", header.integrator);
  hdf5::write_attribute(gnomon, "wall_seconds", 0.0);
  hdf5::rewrite_attribute(gnomon, "status", layout::kRunning);
  hdf5::write_dataset(gnomon, "scene", header.scene);

  const Handle versions = create_group(gnomon, "versions", 0);
  for (const auto& [name, version] : header.versions) {
    hdf5::write_attribute(versions.id(), name.c_str(), version);
  }
  std::vector<layout::BlockRow> rows;
  for (const BlockSize& block : header.blocks) {
    layout::BlockRow& row = rows.emplace_back();
    layout::put(row.name, block.name);
    layout::put(row.symbol, block.symbol);
    layout::put(row.where, block.where);
    row.size = block.size;
  }
  const Handle type = layout::block_type();
  const Handle blocks = hdf5::create_dataset(gnomon, "blocks", type.id(), {rows.size()});
  if (rows.empty()) return;
  check(H5Dwrite(blocks.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()),
        "write the blocks");
}

void write_field(hid_t group, const Field& field) {
  const bool vector = field.components != 1;
  const auto components = static_cast<hsize_t>(field.components);
  const hsize_t count = field.values.size() / components;
  std::vector<hsize_t> extents = {count};
  if (vector) extents.push_back(components);
  const Handle dataset = hdf5::create_dataset(group, field.name, H5T_NATIVE_DOUBLE, extents);
  check(
      H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, field.values.data()),
      "write a field");
  hdf5::write_attribute(dataset.id(), "unit", field.unit);
  hdf5::write_attribute(dataset.id(), "on",
                        std::string(field.on == Field::On::nodes ? "nodes" : "cells"));
}

void write_contact(hid_t group, const std::string& name, const ContactSurface& contact) {
  std::vector<layout::ContactRow> rows;
  for (std::size_t i = 0; i < contact.node.size(); ++i) {
    rows.push_back({contact.node[i], contact.initial.at(i), contact.worn.at(i),
                    contact.current.at(i), contact.pressure.at(i), contact.wear_depth.at(i),
                    contact.active.at(i)});
  }
  const Handle type = layout::contact_type();
  const Handle dataset = hdf5::create_dataset(group, name, type.id(), {rows.size()});
  check(H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()),
        "write the contact surface");
  hdf5::write_attribute(dataset.id(), "dim", contact.dim);
}

}  // namespace

class ResultWriter::File {
public:
  File(const std::filesystem::path& path, const RunHeader& header, const std::optional<Grid>& grid);
  ~File();

  void append(const HistoryRow& row);
  void store(double t, const std::vector<Field>& fields,
             const std::optional<ContactSurface>& contact);
  void close(const std::string& status, double wall_seconds);
  // Runs an action at the border of the room: HDF5 stays silent, and after a failure nothing more
  // reaches the disk, which keeps the last committed state.
  void guarded(const std::function<void()>& action);

private:
  void flush() { check(H5Fflush(file_.id(), H5F_SCOPE_GLOBAL), "flush the file"); }
  void check_field(const Field& field) const;
  Handle open_steps(hid_t parent);

  std::filesystem::path path_;
  std::optional<hdf5::CrashSafeFile> disk_;
  Handle file_, gnomon_, steps_, contacts_;  // released in reverse order, the file last
  hdf5::GrowingTable history_, stored_;
  std::vector<layout::Column> columns_;
  std::optional<XdmfSidecar> sidecar_;
  std::size_t points_ = 0, cells_ = 0;
  bool failed_ = false;
};

ResultWriter::File::File(const std::filesystem::path& path, const RunHeader& header,
                         const std::optional<Grid>& grid)
    : path_(replaceable(path)) {
  const hdf5::QuietErrors quiet;
  try {
    if (XdmfSidecar::path_for(path_) == path_) throw Error("the suffix .xdmf is the sidecar's");
    disk_.emplace(part_of(path_));
    file_ = create_file(*disk_, part_of(path_));
    gnomon_ = create_group(file_.id(), "gnomon", 8);
    write_header(gnomon_.id(), header);
    stored_ = hdf5::GrowingTable::create(gnomon_.id(), "stored", layout::stored_type());
    contacts_ = create_group(gnomon_.id(), "contact", layout::kStepsPerGroup);
    steps_ = create_group(file_.id(), "steps", layout::kStepsPerGroup);
    if (grid) {
      const std::size_t corners = grid->cell == Grid::Cell::quadrilateral ? 4 : 8;
      points_ = grid->points.size();
      cells_ = grid->cells.size() / corners;
      write_mesh(file_.id(), *grid);
    }
    flush();
    // The sidecar first: without a step it is right for either file, and if it cannot be written,
    // the earlier result is still there.
    if (grid) {
      sidecar_.emplace(path_, *grid);
    } else {
      std::filesystem::remove(XdmfSidecar::path_for(path_));
    }
    publish_part(path_);
  } catch (const std::exception& error) {
    if (disk_) disk_->abandon();
    std::error_code ignored;
    if (disk_) std::filesystem::remove(part_of(path_), ignored);
    throw InputError(fmt::format("cannot create {}: {}", path.string(), error.what()));
  }
}

ResultWriter::File::~File() {
  const hdf5::QuietErrors quiet;
  stored_ = {};
  history_ = {};
  contacts_ = {};
  steps_ = {};
  gnomon_ = {};
  file_ = {};
}

void ResultWriter::File::guarded(const std::function<void()>& action) {
  if (failed_) throw Error(fmt::format("{}: an earlier write failed", path_.string()));
  const hdf5::QuietErrors quiet;
  try {
    action();
  } catch (const std::exception& error) {
    failed_ = true;
    disk_->abandon();
    throw Error(fmt::format("{}: {} (the result holds everything up to the step before)",
                            path_.string(), error.what()));
  }
}

void ResultWriter::File::append(const HistoryRow& row) {
  if (!history_) {
    columns_ = layout::columns_of(row);
    history_ = hdf5::GrowingTable::create(gnomon_.id(), "history", layout::history_type(columns_));
    std::vector<std::string> units;
    for (const layout::Column& column : columns_) units.push_back(column.unit);
    hdf5::write_attribute(history_.dataset(), "units", units);
  }
  const auto same = [](const layout::Column& a, const layout::Column& b) {
    return a.name == b.name;
  };
  const auto columns = layout::columns_of(row);
  if (!std::equal(columns.begin(), columns.end(), columns_.begin(), columns_.end(), same)) {
    throw Error("the scalars of a history row are not those of the first row");
  }
  history_.append(layout::cells_of(row).data());
  flush();
}

void ResultWriter::File::check_field(const Field& field) const {
  if (field.components != 1 && field.components != 3) {
    throw Error(
        fmt::format("field {} has {} components, not 1 or 3", field.name, field.components));
  }
  const std::size_t count = field.on == Field::On::nodes ? points_ : cells_;
  if (field.values.size() != count * static_cast<std::size_t>(field.components)) {
    throw Error(fmt::format("field {} has {} values for {} places of {} components", field.name,
                            field.values.size(), count, field.components));
  }
}

// The group of a hundred steps that the next stored step goes to.
Handle ResultWriter::File::open_steps(hid_t parent) {
  const std::string name = layout::group_path(stored_.rows());
  if (stored_.rows() % layout::kStepsPerGroup == 0) {
    return create_group(parent, name, layout::kStepsPerGroup);
  }
  return own(H5Gopen2(parent, name.c_str(), H5P_DEFAULT), H5Gclose, "open a group");
}

void ResultWriter::File::store(double t, const std::vector<Field>& fields,
                               const std::optional<ContactSurface>& contact) {
  for (const Field& field : fields) check_field(field);
  const std::string path = layout::step_path(stored_.rows());
  const std::string name = path.substr(path.find('/') + 1);
  {
    const Handle hundred = open_steps(steps_.id());
    const Handle step = create_group(hundred.id(), name, fields.size());
    hdf5::write_attribute(step.id(), "t", t);
    for (const Field& field : fields) write_field(step.id(), field);
    const Handle contacts = open_steps(contacts_.id());
    if (contact) write_contact(contacts.id(), name, *contact);
  }
  flush();
  // A commit of its own: the step counts as stored once it is all there.
  layout::StoredRow row{t, {}};
  const std::string whole = "steps/" + path;
  layout::put(row.path, whole);
  stored_.append(&row);
  flush();
  if (sidecar_) sidecar_->add_step(t, "/" + whole, fields);
}

void ResultWriter::File::close(const std::string& status, double wall_seconds) {
  hdf5::write_attribute(gnomon_.id(), "wall_seconds", wall_seconds);
  hdf5::rewrite_attribute(gnomon_.id(), "status", status);
  flush();
  disk_->sync();
}

ResultWriter::ResultWriter(const std::filesystem::path& file, const RunHeader& header,
                           const std::optional<Grid>& grid)
    : file_(std::make_unique<File>(file, header, grid)) {}

ResultWriter::~ResultWriter() = default;

void ResultWriter::append(const HistoryRow& row) {
  file_->guarded([&] { file_->append(row); });
}

void ResultWriter::store(double t, const std::vector<Field>& fields,
                         const std::optional<ContactSurface>& contact) {
  file_->guarded([&] { file_->store(t, fields, contact); });
}

void ResultWriter::close(const std::string& status, double wall_seconds) {
  file_->guarded([&] { file_->close(status, wall_seconds); });
}

}  // namespace gnomon
