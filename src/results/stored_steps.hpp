// The stored steps of a result, in groups of a hundred: fields over the mesh in "steps", the
// contact surface in "gnomon/contact", the counter-body in "counter_body". Those that are whole
// have a row in "gnomon/stored".
#pragma once

#include <hdf5.h>

#include <gnomon/results/results.hpp>
#include <optional>
#include <string>
#include <vector>

#include "results/hdf5_handles.hpp"
#include "results/layout.hpp"
#include "results/stored_mesh.hpp"

namespace gnomon::layout {

/// One that is written, but does not count yet.
struct StoredStep {
  double t = 0;
  std::string path;  ///< "steps/0001/000123"
  std::optional<StoredSurface> surface;
};

class StoredSteps {
public:
  StoredSteps() = default;
  /// Creates the empty groups; `gnomon` is a group of `file`, and both outlive the object.
  StoredSteps(hid_t file, hid_t gnomon);

  /// `grid`: of the fields. Throws Error for a field that is not one over it.
  StoredStep write(double t, const std::vector<GridField>& fields,
                   const std::optional<ContactSurface>& contact,
                   const std::optional<CounterSurface>& counter_body,
                   const std::optional<Grid>& grid);
  /// Once what was written has been flushed, and before the next one is written.
  void count(const StoredStep& step);

private:
  hdf5::Handle open_hundred(hid_t parent) const;
  void write_contact(hid_t hundred, const std::string& name, const ContactSurface& contact);

  hid_t gnomon_ = H5I_INVALID_HID;
  GrowingTable stored_;
  hdf5::Handle contacts_, steps_, counters_, phases_;
  CounterSurfaces surfaces_;
};

std::vector<double> read_stored_times(hid_t gnomon);
/// The step at t (without t, the last one): the nearest within 1e-9 of the run's length, or the
/// only one that agrees with t in the printed digits. Throws Failure if there is none.
std::size_t find_step(const std::vector<double>& times, std::optional<double> t);
/// Throws Failure if the step has no such field.
GridField read_field(hid_t file, std::size_t step, const std::string& name);
/// With its phases. Throws Failure if the step has none.
ContactSurface read_contact(hid_t gnomon, std::size_t step);

}  // namespace gnomon::layout
