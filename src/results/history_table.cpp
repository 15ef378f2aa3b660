#include "results/history_table.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <gnomon/base/counter_names.hpp>

#include "results/hdf5_values.hpp"

namespace gnomon::layout {

using hdf5::Failure;
using hdf5::Handle;
using hdf5::own;

namespace {

const std::vector<Column>& fixed_columns() {
  static const std::vector<Column> columns = [] {
    std::vector<Column> all = {{"t", "s", false},       {"step_size", "s", false},
                               {"order", "", true},     {"step_newton_iterations", "", true},
                               {"restarted", "", true}, {"switched", "", true}};
    for (const NamedCounter& counter : named_counters) all.push_back({counter.name, "", true});
    return all;
  }();
  return columns;
}

// Columns of the history with their names in the file. Throws Failure unless the fixed ones come
// first.
std::vector<Column> read_columns(const Handle& dataset) {
  const Handle type = own(H5Dget_type(dataset.id()), H5Tclose, "read the history");
  const auto units = hdf5::read_texts_attribute(dataset.id(), "units");
  const auto& fixed = fixed_columns();
  const int count = H5Tget_class(type.id()) == H5T_COMPOUND ? H5Tget_nmembers(type.id()) : 0;
  std::vector<Column> columns = fixed;
  for (int i = 0; i < count; ++i) {
    const auto index = static_cast<std::size_t>(i);
    char* text = H5Tget_member_name(type.id(), static_cast<unsigned>(i));
    const std::string name = text ? text : "";
    H5free_memory(text);
    if (index >= fixed.size()) {
      columns.push_back({name, index < units.size() ? units[index] : "", false});
    } else if (name != fixed[index].name) {
      throw Failure(fmt::format("cannot read the history: unknown column {}", name));
    }
  }
  if (count < static_cast<int>(fixed.size())) throw Failure("cannot read the history: no columns");
  return columns;
}

HistoryRow row_of(const Cell* cell, const std::vector<Column>& columns) {
  HistoryRow row;
  row.t = (cell++)->real;
  row.step.step = (cell++)->real;
  row.step.order = static_cast<int>((cell++)->integer);
  row.step.newton_iterations = (cell++)->integer;
  row.step.restarted = (cell++)->integer != 0;
  row.step.switched = static_cast<int>((cell++)->integer);
  for (const NamedCounter& counter : named_counters)
    row.counters.*counter.value = count_of((cell++)->integer, "read the history");
  for (std::size_t i = fixed_columns().size(); i < columns.size(); ++i) {
    row.scalars.push_back({columns[i].name, columns[i].unit, (cell++)->real});
  }
  return row;
}

constexpr const char* kPressure = "phase_pressure";
constexpr const char* kErrors = "phase_errors";

/// A row of "gnomon/phase_errors".
struct ErrorRow {
  double t;
  std::int64_t phases;
  double error;
};

Handle error_type() {
  return row_type(sizeof(ErrorRow), {{"t", offsetof(ErrorRow, t), H5T_NATIVE_DOUBLE},
                                     {"phases", offsetof(ErrorRow, phases), H5T_NATIVE_INT64},
                                     {"error", offsetof(ErrorRow, error), H5T_NATIVE_DOUBLE}});
}

/// One number for each phase.
std::vector<double> read_of_phases(hid_t gnomon, const char* name) {
  auto read = hdf5::read_numbers<double>(gnomon, std::string(kPressure) + "/" + name);
  if (read.extents.size() != 1) throw Failure("cannot read the phases: they are not a list");
  return std::move(read.values);
}

}  // namespace

std::vector<Column> columns_of(const HistoryRow& row) {
  std::vector<Column> columns = fixed_columns();
  for (const Scalar& scalar : row.scalars) columns.push_back({scalar.name, scalar.unit, false});
  return columns;
}

std::vector<Cell> cells_of(const HistoryRow& row) {
  std::vector<Cell> cells = {{.real = row.t},
                             {.real = row.step.step},
                             {.integer = row.step.order},
                             {.integer = row.step.newton_iterations},
                             {.integer = row.step.restarted},
                             {.integer = row.step.switched}};
  for (const NamedCounter& counter : named_counters)
    cells.push_back({.integer = row.counters.*counter.value});
  for (const Scalar& scalar : row.scalars) cells.push_back({.real = scalar.value});
  return cells;
}

Handle history_type(const std::vector<Column>& columns) {
  std::vector<Member> members;
  for (const Column& column : columns)
    members.push_back({column.name.c_str(), members.size() * sizeof(Cell),
                       column.integer ? H5T_NATIVE_INT64 : H5T_NATIVE_DOUBLE});
  return row_type(columns.size() * sizeof(Cell), members);
}

std::vector<HistoryRow> read_history(hid_t gnomon) {
  if (!hdf5::exists(gnomon, "history")) return {};
  const Handle dataset = hdf5::open_dataset(gnomon, "history", "read the history");
  const auto columns = read_columns(dataset);
  const auto cells =
      read_rows<Cell>(dataset, history_type(columns), "read the history", columns.size());
  std::vector<HistoryRow> rows;
  for (std::size_t i = 0; i < cells.size(); i += columns.size()) {
    rows.push_back(row_of(&cells[i], columns));
  }
  return rows;
}

Handle create_phase_group(hid_t gnomon, const ContactSurface& contact) {
  const hsize_t phases = contact.phase_position.size();
  if (contact.phase_weight.size() != phases)
    throw Failure("cannot write the phases: positions and weights are not equally many");
  Handle group = create_group(gnomon, kPressure, kStepsPerGroup);
  hdf5::write_dataset(group.id(), "position", H5T_NATIVE_DOUBLE, {phases},
                      contact.phase_position.data());
  hdf5::write_dataset(group.id(), "weight", H5T_NATIVE_DOUBLE, {phases},
                      contact.phase_weight.data());
  return group;
}

void write_phases(hid_t group, const std::string& name, const ContactSurface& contact) {
  const hsize_t phases = contact.phase_position.size(), nodes = contact.node.size();
  if (contact.phase_pressure.size() != phases * nodes)
    throw Failure("cannot write the pressures of phases: they are not phases times nodes");
  hdf5::write_dataset(group, name, H5T_NATIVE_DOUBLE, {phases, nodes},
                      contact.phase_pressure.data(), hdf5::Storage::compressed);
}

void read_phases(hid_t gnomon, const std::string& step, ContactSurface& contact) {
  const std::string path = std::string(kPressure) + "/" + step;
  if (!hdf5::exists(gnomon, kPressure) || !hdf5::exists(gnomon, path)) return;
  contact.phase_position = read_of_phases(gnomon, "position");
  contact.phase_weight = read_of_phases(gnomon, "weight");
  auto pressure = hdf5::read_numbers<double>(gnomon, path);
  const std::vector<hsize_t> expected = {contact.phase_position.size(), contact.node.size()};
  if (pressure.extents != expected || contact.phase_weight.size() != expected[0])
    throw Failure("cannot read the pressures of phases: they are not phases times nodes");
  contact.phase_pressure = std::move(pressure.values);
}

GrowingTable create_phase_errors(hid_t gnomon) {
  return {gnomon, kErrors, error_type()};
}

void append_phase_error(GrowingTable& table, const PhaseError& error) {
  const ErrorRow row{error.t, error.phases, error.error};
  table.append(&row);
}

std::vector<PhaseError> read_phase_errors(hid_t gnomon) {
  if (!hdf5::exists(gnomon, kErrors)) return {};
  constexpr const char* what = "read the errors of the mean";
  const Handle dataset = hdf5::open_dataset(gnomon, kErrors, what);
  std::vector<PhaseError> errors;
  for (const ErrorRow& row : read_rows<ErrorRow>(dataset, error_type(), what))
    errors.push_back({row.t, count_of(row.phases, what), row.error});
  return errors;
}

}  // namespace gnomon::layout
