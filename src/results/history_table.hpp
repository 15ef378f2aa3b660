// The table "gnomon/history": conversion of rows to cells of eight bytes, and back; and of a cycle
// the pressures in its phases, and the errors of the mean over them.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <gnomon/results/results.hpp>
#include <string>
#include <vector>

#include "results/layout.hpp"

namespace gnomon::layout {

struct Column {
  std::string name;
  std::string unit;
  bool integer = false;
};
/// One cell of the history, in memory and in the file; its type depends on the column.
union Cell {
  double real;
  std::int64_t integer;
};

/// The columns of a row: fixed ones, then its scalars.
std::vector<Column> columns_of(const HistoryRow& row);
std::vector<Cell> cells_of(const HistoryRow& row);
/// The type of a row of these columns. Throws hdf5::Failure when two share a name.
hdf5::Handle history_type(const std::vector<Column>& columns);
/// All rows of the history in the group "gnomon"; none if the run has not begun.
std::vector<HistoryRow> read_history(hid_t gnomon);

/// "gnomon/phase_pressure", with the positions and weights of the phases.
hdf5::Handle create_phase_group(hid_t gnomon, const ContactSurface& contact);
/// "gnomon/phase_pressure", and where friction may stick phase_traction, phase_slip and phase_loop
/// beside: `name` in their groups of a hundred steps.
void write_phases(hid_t gnomon, const std::string& hundred, const std::string& name,
                  const ContactSurface& contact);
/// Fills in the phases of a contact surface, if it has any; `step`: its path below the group.
void read_phases(hid_t gnomon, const std::string& step, ContactSurface& contact);

/// "gnomon/phase_errors".
GrowingTable create_phase_errors(hid_t gnomon);
void append_phase_error(GrowingTable& table, const PhaseError& error);
/// Empty where there is no such table.
std::vector<PhaseError> read_phase_errors(hid_t gnomon);

}  // namespace gnomon::layout
