// Names, limits and table rows of the result file, shared by its writer and its reader.
// docs/results.md describes them for users.
#pragma once

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <gnomon/model/model.hpp>
#include <gnomon/results/results.hpp>
#include <string>
#include <vector>

#include "results/crash_safe_file.hpp"
#include "results/hdf5_handles.hpp"
#include "results/hdf5_values.hpp"

namespace gnomon::layout {

inline constexpr int kVersion = 1;
inline constexpr const char* kFormat = "gnomon result";
inline constexpr const char* kRunning = "running or crashed";

/// Stored steps lie in groups of this many, so that a group's list of links fits into a page.
inline constexpr std::size_t kStepsPerGroup = 100;

/// Text in a row: truncated to fit, padded with zeros.
template <std::size_t size>
void put(std::array<char, size>& field, const std::string& text) {
  field.fill('\0');
  std::copy_n(text.begin(), std::min(text.size(), size), field.begin());
}
template <std::size_t size>
std::string text_of(const std::array<char, size>& field) {
  return {field.begin(), std::find(field.begin(), field.end(), '\0')};
}

/// A count in a table, small enough to be added to others. Throws Failure if it is not a count.
long count_of(std::int64_t value, const char* what);

/// "0001/000123" for the stored step 123, below "steps" and "gnomon/contact".
std::string step_path(std::size_t step);
std::string group_path(std::size_t step);

/// The type of a row in memory and in the file, of these members.
struct Member {
  const char* name;
  std::size_t offset;
  hid_t type;
};
hdf5::Handle row_type(std::size_t size, const std::vector<Member>& members);

/// All rows of a table, described by `type`, one after the other in `per_row` objects each.
template <class Row>
std::vector<Row> read_rows(const hdf5::Handle& dataset, const hdf5::Handle& type,
                           const std::string& what, std::size_t per_row = 1) {
  const auto extents = hdf5::extents_of(dataset.id());
  if (extents.size() != 1) throw hdf5::Failure("cannot " + what + ": it is not a table");
  std::vector<Row> rows(extents.front() * per_row);
  if (!rows.empty())
    hdf5::check(H5Dread(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data()),
                what.c_str());
  return rows;
}

class GrowingTable {
public:
  GrowingTable() = default;
  /// Creates an empty table; `row_type` is the type of a row in memory and on file.
  GrowingTable(hid_t parent, const std::string& name, hdf5::Handle row_type);

  /// Appends a row, which a reader sees after the next flush of the file.
  void append(const void* row);
  hid_t dataset() const { return dataset_.id(); }
  hsize_t rows() const { return rows_; }
  explicit operator bool() const { return static_cast<bool>(dataset_); }

private:
  hdf5::Handle type_, dataset_;
  hsize_t rows_ = 0;
};

/// A row of "gnomon/blocks".
struct BlockRow {
  std::array<char, 64> name;
  std::array<char, 16> symbol;
  std::int64_t size;
  std::array<char, 64> where;
};
hdf5::Handle block_type();

hdf5::Handle create_file(hdf5::CrashSafeFile& disk, const std::filesystem::path& path);

/// A group that keeps its links in its own header, with space for `links` of them: a single
/// structure of less than a page changes when a step is added.
hdf5::Handle create_group(hid_t parent, const std::string& name, std::size_t links);

void write_header(hid_t gnomon, const RunHeader& header);

}  // namespace gnomon::layout
