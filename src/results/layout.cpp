#include "results/layout.hpp"

#include <fmt/format.h>

#include "results/hdf5_values.hpp"

namespace gnomon::layout {

using hdf5::check;
using hdf5::Handle;
using hdf5::own;

Handle compound(std::size_t size) {
  return own(H5Tcreate(H5T_COMPOUND, size), H5Tclose, "describe a table");
}

void insert(const Handle& type, const std::string& name, std::size_t offset, hid_t member) {
  check(H5Tinsert(type.id(), name.c_str(), offset, member), "describe a table");
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

Handle stored_type() {
  Handle type = compound(sizeof(StoredRow));
  insert(type, "t", offsetof(StoredRow, t), H5T_NATIVE_DOUBLE);
  insert(type, "path", offsetof(StoredRow, path), hdf5::text_type(sizeof(StoredRow::path)).id());
  return type;
}

Handle contact_type() {
  Handle type = compound(sizeof(ContactRow));
  insert(type, "node", offsetof(ContactRow, node), H5T_NATIVE_INT64);
  const std::array<const char*, 9> coordinates = {"X0", "Y0", "Z0", "X", "Y", "Z", "x", "y", "z"};
  for (std::size_t i = 0; i < coordinates.size(); ++i) {
    insert(type, coordinates[i], offsetof(ContactRow, initial) + i * sizeof(double),
           H5T_NATIVE_DOUBLE);
  }
  insert(type, "pressure", offsetof(ContactRow, pressure), H5T_NATIVE_DOUBLE);
  insert(type, "wear_depth", offsetof(ContactRow, wear_depth), H5T_NATIVE_DOUBLE);
  insert(type, "active", offsetof(ContactRow, active), H5T_NATIVE_INT64);
  return type;
}

Handle block_type() {
  Handle type = compound(sizeof(BlockRow));
  insert(type, "name", offsetof(BlockRow, name), hdf5::text_type(sizeof(BlockRow::name)).id());
  insert(type, "symbol", offsetof(BlockRow, symbol),
         hdf5::text_type(sizeof(BlockRow::symbol)).id());
  insert(type, "size", offsetof(BlockRow, size), H5T_NATIVE_INT64);
  insert(type, "where", offsetof(BlockRow, where), hdf5::text_type(sizeof(BlockRow::where)).id());
  return type;
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
  const Handle type = block_type();
  const Handle blocks = hdf5::create_dataset(gnomon, "blocks", type.id(), {rows.size()});
  if (rows.empty()) return;
  check(H5Dwrite(blocks.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()),
        "write the blocks");
}

void write_field(hid_t group, const GridField& field) {
  const bool vector = field.components != 1;
  const auto components = static_cast<hsize_t>(field.components);
  const hsize_t count = field.values.size() / components;
  std::vector<hsize_t> extents = {count};
  if (vector) extents.push_back(components);
  const Handle dataset = hdf5::create_dataset(group, field.name, H5T_NATIVE_DOUBLE, extents,
                                              hdf5::Storage::compressed);
  check(
      H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, field.values.data()),
      "write a field");
  hdf5::write_attribute(dataset.id(), "unit", field.unit);
  hdf5::write_attribute(dataset.id(), "on",
                        std::string(field.on == GridField::On::nodes ? "nodes" : "cells"));
}

void write_contact(hid_t group, const std::string& name, const ContactSurface& contact) {
  std::vector<ContactRow> rows;
  for (std::size_t i = 0; i < contact.node.size(); ++i) {
    rows.push_back({contact.node[i], contact.initial.at(i), contact.worn.at(i),
                    contact.current.at(i), contact.pressure.at(i), contact.wear_depth.at(i),
                    contact.active.at(i)});
  }
  const Handle type = contact_type();
  const Handle dataset =
      hdf5::create_dataset(group, name, type.id(), {rows.size()}, hdf5::Storage::compressed);
  check(H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()),
        "write the contact surface");
  hdf5::write_attribute(dataset.id(), "dim", contact.dim);
}

}  // namespace gnomon::layout
