// Names, limits and table rows of the result file, shared by its writer and its reader.
// docs/results.md describes them for users.
#pragma once

#include <hdf5.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <gnomon/model/model.hpp>
#include <string>
#include <vector>

#include "results/hdf5_handles.hpp"

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

/// A row of "gnomon/stored".
struct StoredRow {
  double t;
  std::array<char, 32> path;  ///< "steps/0001/000123"
};
hdf5::Handle stored_type();

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
hdf5::Handle contact_type();

/// A row of "gnomon/blocks".
struct BlockRow {
  std::array<char, 64> name;
  std::array<char, 16> symbol;
  std::int64_t size;
  std::array<char, 64> where;
};
hdf5::Handle block_type();

}  // namespace gnomon::layout
