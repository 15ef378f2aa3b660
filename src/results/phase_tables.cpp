#include "results/phase_tables.hpp"

#include <cstddef>
#include <cstdint>

#include "results/hdf5_values.hpp"

namespace gnomon::layout {

using hdf5::Failure;
using hdf5::Handle;

namespace {

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
