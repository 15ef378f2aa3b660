// The table "gnomon/history": conversion of rows to cells of eight bytes, and back.
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

}  // namespace gnomon::layout
