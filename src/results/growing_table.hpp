// A one-dimensional dataset that grows row by row.
#pragma once

#include <string>

#include "results/hdf5_handles.hpp"

namespace gnomon::hdf5 {

class GrowingTable {
public:
  GrowingTable() = default;
  /// Creates an empty table; `row_type` is the type of a row in memory and on file.
  static GrowingTable create(hid_t parent, const std::string& name, Handle row_type);

  /// Appends a row, which a reader sees after the next flush of the file.
  void append(const void* row);
  hid_t dataset() const { return dataset_.id(); }
  hsize_t rows() const { return rows_; }
  explicit operator bool() const { return static_cast<bool>(dataset_); }

private:
  Handle dataset_;
  Handle type_;
  hsize_t rows_ = 0;
};

}  // namespace gnomon::hdf5
