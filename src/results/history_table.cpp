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

namespace {

/// What is stored of the phases at a step, and its extents; empty where there is none.
struct PhaseArray {
  const char* group;
  std::vector<double> ContactSurface::*values;
  std::vector<hsize_t> (*extents)(hsize_t phases, hsize_t nodes, hsize_t dim);
};

constexpr PhaseArray phase_arrays[] = {
    {kPressure, &ContactSurface::phase_pressure,
     [](hsize_t phases, hsize_t nodes, hsize_t) {
       return std::vector{phases, nodes};
     }},
    {"phase_traction", &ContactSurface::phase_traction,
     [](hsize_t phases, hsize_t nodes, hsize_t dim) {
       return std::vector{phases, nodes, dim};
     }},
    {"phase_slip", &ContactSurface::phase_slip,
     [](hsize_t phases, hsize_t nodes, hsize_t dim) {
       return std::vector{phases, nodes, dim};
     }},
    {"phase_loop", &ContactSurface::phase_loop,
     [](hsize_t phases, hsize_t, hsize_t dim) {
       return std::vector{phases, 2 * dim};
     }},
    {"phase_turn", &ContactSurface::phase_turn, [](hsize_t phases, hsize_t, hsize_t) {
       return std::vector{phases, hsize_t{2}};
     }}};

std::vector<hsize_t> extents_of(const PhaseArray& array, const ContactSurface& contact) {
  return array.extents(contact.phase_position.size(), contact.node.size(),
                       static_cast<hsize_t>(contact.dim));
}

}  // namespace

void write_phases(hid_t gnomon, const std::string& hundred, const std::string& name,
                  const ContactSurface& contact) {
  for (const PhaseArray& array : phase_arrays) {
    const std::vector<double>& values = contact.*array.values;
    if (values.empty()) continue;
    const std::vector<hsize_t> extents = extents_of(array, contact);
    hsize_t size = 1;
    for (const hsize_t extent : extents) size *= extent;
    if (values.size() != size)
      throw Failure(std::string("cannot write ") + array.group +
                    ": its size is not that of phases and nodes");
    const auto open = [](hid_t parent, const std::string& group) {
      return hdf5::exists(parent, group) ? hdf5::open_group(parent, group, "open a group")
                                         : create_group(parent, group, kStepsPerGroup);
    };
    const Handle all = open(gnomon, array.group);
    const Handle steps = open(all.id(), hundred);
    hdf5::write_dataset(steps.id(), name, H5T_NATIVE_DOUBLE, extents, values.data(),
                        hdf5::Storage::compressed);
  }
}

void read_phases(hid_t gnomon, const std::string& step, ContactSurface& contact) {
  if (!hdf5::exists(gnomon, kPressure) ||
      !hdf5::exists(gnomon, std::string(kPressure) + "/" + step))
    return;
  contact.phase_position = read_of_phases(gnomon, "position");
  contact.phase_weight = read_of_phases(gnomon, "weight");
  for (const PhaseArray& array : phase_arrays) {
    const std::string path = std::string(array.group) + "/" + step;
    if (!hdf5::exists(gnomon, array.group) || !hdf5::exists(gnomon, path)) continue;
    auto read = hdf5::read_numbers<double>(gnomon, path);
    if (read.extents != extents_of(array, contact) ||
        contact.phase_weight.size() != contact.phase_position.size())
      throw Failure(std::string("cannot read ") + array.group +
                    ": its size is not that of phases and nodes");
    contact.*array.values = std::move(read.values);
  }
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
