#include "results/stored_steps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "results/hdf5_values.hpp"
#include "results/history_table.hpp"

namespace gnomon::layout {

using hdf5::Failure;
using hdf5::Handle;

namespace {

/// A row of "gnomon/stored".
struct StoredRow {
  double t;
  std::array<char, 32> path;  ///< "steps/0001/000123"
};

Handle stored_type() {
  return row_type(sizeof(StoredRow), {{"t", offsetof(StoredRow, t), H5T_NATIVE_DOUBLE},
                                      {"path", offsetof(StoredRow, path),
                                       hdf5::text_type(sizeof(StoredRow::path)).id()}});
}

/// A row of "gnomon/contact/...".
struct ContactRow {
  std::int64_t node;
  std::array<double, 3> initial;
  std::array<double, 3> worn;
  std::array<double, 3> current;
  double pressure;
  double wear_depth;
  std::int64_t active;
};

Handle contact_type() {
  std::vector<Member> members = {{"node", offsetof(ContactRow, node), H5T_NATIVE_INT64}};
  std::size_t offset = offsetof(ContactRow, initial);
  for (const char* name :
       {"X0", "Y0", "Z0", "X", "Y", "Z", "x", "y", "z", "pressure", "wear_depth"}) {
    members.push_back({name, offset, H5T_NATIVE_DOUBLE});
    offset += sizeof(double);
  }
  members.push_back({"active", offsetof(ContactRow, active), H5T_NATIVE_INT64});
  return row_type(sizeof(ContactRow), members);
}

void check_field(const GridField& field, const Grid& grid) {
  if (field.components != 1 && field.components != 3) {
    throw Error(
        fmt::format("field {} has {} components, not 1 or 3", field.name, field.components));
  }
  const std::size_t count =
      field.on == GridField::On::nodes ? grid.points.size() : grid.cell_count();
  if (field.values.size() != count * static_cast<std::size_t>(field.components)) {
    throw Error(fmt::format("field {} has {} values for {} places of {} components", field.name,
                            field.values.size(), count, field.components));
  }
}

void write_field(hid_t group, const GridField& field) {
  const auto components = static_cast<hsize_t>(field.components);
  std::vector<hsize_t> extents = {field.values.size() / components};
  if (components > 1) extents.push_back(components);
  const Handle dataset = hdf5::write_dataset(group, field.name, H5T_NATIVE_DOUBLE, extents,
                                             field.values.data(), hdf5::Storage::compressed);
  hdf5::write_attribute(dataset.id(), "unit", field.unit);
  hdf5::write_attribute(dataset.id(), "on",
                        std::string(field.on == GridField::On::nodes ? "nodes" : "cells"));
}

void write_surface(hid_t group, const std::string& name, const ContactSurface& contact) {
  std::vector<ContactRow> rows;
  for (std::size_t i = 0; i < contact.node.size(); ++i) {
    rows.push_back({contact.node[i], contact.initial.at(i), contact.worn.at(i),
                    contact.current.at(i), contact.pressure.at(i), contact.wear_depth.at(i),
                    contact.active.at(i)});
  }
  const Handle dataset = hdf5::write_dataset(group, name, contact_type().id(), {rows.size()},
                                             rows.data(), hdf5::Storage::compressed);
  hdf5::write_attribute(dataset.id(), "dim", contact.dim);
}

}  // namespace

StoredSteps::StoredSteps(hid_t file, hid_t gnomon)
    : gnomon_(gnomon),
      stored_(gnomon, "stored", stored_type()),
      contacts_(create_group(gnomon, "contact", kStepsPerGroup)),
      steps_(create_group(file, "steps", kStepsPerGroup)),
      counters_(create_group(file, "counter_body", kStepsPerGroup)) {}

/// The group that the next step goes to.
Handle StoredSteps::open_hundred(hid_t parent) const {
  const std::string name = group_path(stored_.rows());
  if (stored_.rows() % kStepsPerGroup == 0) return create_group(parent, name, kStepsPerGroup);
  return hdf5::open_group(parent, name, "open a group");
}

void StoredSteps::write_contact(hid_t hundred, const std::string& name,
                                const ContactSurface& contact) {
  write_surface(hundred, name, contact);
  if (contact.phase_position.empty()) return;
  if (!phases_) phases_ = create_phase_group(gnomon_, contact);
  write_phases(gnomon_, group_path(stored_.rows()), name, contact);
}

StoredStep StoredSteps::write(double t, const std::vector<GridField>& fields,
                              const std::optional<ContactSurface>& contact,
                              const std::optional<CounterSurface>& counter_body,
                              const std::optional<Grid>& grid) {
  const Grid none;
  for (const GridField& field : fields) check_field(field, grid ? *grid : none);
  const std::string path = step_path(stored_.rows());
  const std::string name = path.substr(path.find('/') + 1);
  const Handle hundred = open_hundred(steps_.id());
  const Handle step = create_group(hundred.id(), name, fields.size());
  hdf5::write_attribute(step.id(), "t", t);
  for (const GridField& field : fields) write_field(step.id(), field);
  const Handle contacts = open_hundred(contacts_.id());
  if (contact) write_contact(contacts.id(), name, *contact);
  const Handle counters = open_hundred(counters_.id());
  StoredStep written{t, "steps/" + path,
                     surfaces_.put(counters.id(), name, "/counter_body/" + path, counter_body)};
  if (written.surface) write_surface_names(step.id(), *written.surface);
  return written;
}

void StoredSteps::count(const StoredStep& step) {
  StoredRow row{step.t, {}};
  put(row.path, step.path);
  stored_.append(&row);
}

std::vector<double> read_stored_times(hid_t gnomon) {
  const Handle dataset = hdf5::open_dataset(gnomon, "stored", "read the stored steps");
  std::vector<double> times;
  for (const StoredRow& row : read_rows<StoredRow>(dataset, stored_type(), "read the stored steps"))
    times.push_back(row.t);
  return times;
}

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

GridField read_field(hid_t file, std::size_t number, const std::string& name) {
  const std::string step = "steps/" + step_path(number);
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

ContactSurface read_contact(hid_t gnomon, std::size_t step) {
  const std::string path = "contact/" + step_path(step);
  if (!hdf5::exists(gnomon, path)) throw Failure("the problem has no contact surface");
  const Handle dataset = hdf5::open_dataset(gnomon, path, "read the contact surface");
  const auto rows = read_rows<ContactRow>(dataset, contact_type(), "read the contact surface");
  ContactSurface contact;
  const double dim = hdf5::read_number_attribute(dataset.id(), "dim");
  if (dim != 2 && dim != 3)
    throw Failure(fmt::format("cannot read the contact surface: it has {} dimensions", dim));
  contact.dim = static_cast<int>(dim);
  for (const ContactRow& row : rows) {
    contact.node.push_back(static_cast<int>(row.node));
    contact.initial.push_back(row.initial);
    contact.worn.push_back(row.worn);
    contact.current.push_back(row.current);
    contact.pressure.push_back(row.pressure);
    contact.wear_depth.push_back(row.wear_depth);
    contact.active.push_back(static_cast<int>(row.active));
  }
  read_phases(gnomon, step_path(step), contact);
  return contact;
}

}  // namespace gnomon::layout
