// The table "gnomon/history": rows of a run as cells of eight bytes, and back.
#pragma once

#include <hdf5.h>

#include <cstdint>
#include <gnomon/results/results.hpp>
#include <string>
#include <vector>

#include "results/hdf5_handles.hpp"

namespace gnomon::layout {

struct Column {
  std::string name;
  std::string unit;
  bool integer = false;
};
/// One cell of the history in memory and on file, whichever it holds.
union Cell {
  double real;
  std::int64_t integer;
};

/// The columns of a row: fixed ones, then its scalars.
std::vector<Column> columns_of(const HistoryRow& row);
std::vector<Cell> cells_of(const HistoryRow& row);
/// The type of a row of these columns. Throws hdf5::Failure when two share a name.
hdf5::Handle history_type(const std::vector<Column>& columns);
/// All rows of the history below the group "gnomon"; none when the run has not begun.
std::vector<HistoryRow> read_history(hid_t gnomon);

}  // namespace gnomon::layout
