#include "results/layout.hpp"

#include <fmt/format.h>

#include "results/hdf5_values.hpp"

namespace gnomon::layout {

using hdf5::check;
using hdf5::Handle;
using hdf5::own;

Handle row_type(std::size_t size, const std::vector<Member>& members) {
  Handle type = own(H5Tcreate(H5T_COMPOUND, size), H5Tclose, "describe a table");
  for (const Member& member : members)
    check(H5Tinsert(type.id(), member.name, member.offset, member.type), "describe a table");
  return type;
}

GrowingTable::GrowingTable(hid_t parent, const std::string& name, Handle row_type)
    : type_(std::move(row_type)),
      dataset_(hdf5::create_dataset(parent, name, type_.id(), {0}, hdf5::Storage::growing)) {}

void GrowingTable::append(const void* row) {
  const hsize_t size = rows_ + 1;
  check(H5Dset_extent(dataset_.id(), &size), "append to a table");
  hdf5::write_part(dataset_.id(), type_.id(), {rows_}, {1}, row);
  rows_ = size;
}

std::string group_path(std::size_t step) {
  return fmt::format("{:04}", step / kStepsPerGroup);
}

long count_of(std::int64_t value, const char* what) {
  constexpr std::int64_t most = std::int64_t{1} << 53;
  if (value < 0 || value > most)
    throw hdf5::Failure(fmt::format("cannot {}: {} is not a count", what, value));
  return value;
}

std::string step_path(std::size_t step) {
  return fmt::format("{}/{:06}", group_path(step), step);
}

Handle block_type() {
  const Handle name = hdf5::text_type(sizeof(BlockRow::name));  // also of `where`
  const Handle symbol = hdf5::text_type(sizeof(BlockRow::symbol));
  return row_type(sizeof(BlockRow), {{"name", offsetof(BlockRow, name), name.id()},
                                     {"symbol", offsetof(BlockRow, symbol), symbol.id()},
                                     {"size", offsetof(BlockRow, size), H5T_NATIVE_INT64},
                                     {"where", offsetof(BlockRow, where), name.id()}});
}

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

void write_header(hid_t gnomon, const RunHeader& header) {
  hdf5::write_attribute(gnomon, "format", std::string(kFormat));
  hdf5::write_attribute(gnomon, "format_version", kVersion);
  hdf5::write_attribute(gnomon, "problem", header.problem);
  hdf5::write_attribute(gnomon, "integrator", header.integrator);
  if (header.model_end > 0) hdf5::write_attribute(gnomon, "model_end", header.model_end);
  hdf5::write_attribute(gnomon, "wall_seconds", 0.0);
  hdf5::rewrite_attribute(gnomon, "status", kRunning);
  hdf5::write_dataset(gnomon, "scene", header.scene);

  const Handle versions = create_group(gnomon, "versions", 0);
  for (const auto& [name, version] : header.versions) {
    hdf5::write_attribute(versions.id(), name.c_str(), version);
  }
  std::vector<BlockRow> rows;
  for (const BlockSize& block : header.blocks) {
    BlockRow& row = rows.emplace_back();
    put(row.name, block.name);
    put(row.symbol, block.symbol);
    put(row.where, block.where);
    row.size = block.size;
  }
  hdf5::write_dataset(gnomon, "blocks", block_type().id(), {rows.size()}, rows.data());
}

}  // namespace gnomon::layout
