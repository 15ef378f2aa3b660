#include "results/layout.hpp"

#include <fmt/format.h>

#include "results/hdf5_values.hpp"

namespace gnomon::layout {

using hdf5::check;
using hdf5::Handle;
using hdf5::own;

namespace {

Handle compound(std::size_t size) {
  return own(H5Tcreate(H5T_COMPOUND, size), H5Tclose, "describe a table");
}

void insert(const Handle& type, const std::string& name, std::size_t offset, hid_t member) {
  check(H5Tinsert(type.id(), name.c_str(), offset, member), "describe a table");
}

}  // namespace

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

}  // namespace gnomon::layout
