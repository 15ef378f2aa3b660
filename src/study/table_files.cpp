// study.csv and study.h5.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/study/study.hpp>
#include <limits>

#include "results/hdf5_handles.hpp"
#include "results/hdf5_values.hpp"
#include "results/replaced_file.hpp"
#include "study/columns.hpp"

namespace gnomon {

namespace {

using namespace study;
using hdf5::check;
using hdf5::Handle;
using hdf5::own;

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

/// A column in HDF5: its position in a row and its type.
struct Placed {
  Column column;
  std::size_t offset;
  std::size_t size;  // of a text
};

std::size_t longest(const Study& study, const StudyTable& table, const Column& column) {
  std::size_t size = 1;
  for (const StudyRow& row : table.rows)
    size = std::max(size, cell_text(column.value(study, table, row)).size());
  return size;
}

std::vector<Placed> place(const Study& study, const StudyTable& table, std::size_t& row_size) {
  std::vector<Placed> placed;
  row_size = 0;
  for (const Column& column : columns(study, table)) {
    const bool text = column.kind == Column::Kind::text;
    const std::size_t size = text ? longest(study, table, column) : 8;
    placed.push_back({column, row_size, size});
    row_size += size;
  }
  return placed;
}

Handle row_type(const std::vector<Placed>& placed, std::size_t row_size) {
  Handle type = own(H5Tcreate(H5T_COMPOUND, row_size), H5Tclose, "describe a table");
  for (const Placed& place : placed) {
    const Handle text = hdf5::text_type(place.size);
    const hid_t member = place.column.kind == Column::Kind::text      ? text.id()
                         : place.column.kind == Column::Kind::integer ? H5T_NATIVE_INT64
                                                                      : H5T_NATIVE_DOUBLE;
    check(H5Tinsert(type.id(), place.column.name.c_str(), place.offset, member),
          "describe a table");
  }
  return type;
}

/// A missing value is written as NaN, or as -1 for counts.
void put(char* target, const Placed& place, const CellValue& value) {
  if (place.column.kind == Column::Kind::text) {
    const std::string text = cell_text(value);
    std::copy(text.begin(), text.end(), target);
  } else if (place.column.kind == Column::Kind::integer) {
    const auto* given = std::get_if<std::int64_t>(&value);
    const std::int64_t number = given ? *given : -1;
    std::copy_n(reinterpret_cast<const char*>(&number), sizeof number, target);
  } else {
    const auto* given = std::get_if<double>(&value);
    const double number = given ? *given : std::numeric_limits<double>::quiet_NaN();
    std::copy_n(reinterpret_cast<const char*>(&number), sizeof number, target);
  }
}

void write_table(hid_t file, const Study& study, const StudyTable& table) {
  std::size_t row_size = 0;
  const std::vector<Placed> placed = place(study, table, row_size);
  std::vector<char> bytes(row_size * table.rows.size(), '\0');
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    for (const Placed& place : placed)
      put(&bytes[i * row_size + place.offset], place,
          place.column.value(study, table, table.rows[i]));
  const Handle type = row_type(placed, row_size);
  const Handle dataset = hdf5::create_dataset(file, "study", type.id(), {table.rows.size()});
  check(H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()),
        "write a table");
  std::vector<std::string> units;
  for (const Placed& place : placed) units.push_back(place.column.unit);
  hdf5::write_attribute(dataset.id(), "units", units);
}

}  // namespace

std::string study_csv(const Study& study, const StudyTable& table) {
  const std::vector<Column> all = columns(study, table);
  std::vector<std::string> names;
  for (const Column& column : all) names.push_back(quoted(column.name));
  std::string text = fmt::format("{}\n", fmt::join(names, ","));
  for (const StudyRow& row : table.rows) {
    std::vector<std::string> cells;
    for (const Column& column : all)
      cells.push_back(quoted(cell_text(column.value(study, table, row))));
    text += fmt::format("{}\n", fmt::join(cells, ","));
  }
  return text;
}

void write_study_hdf5(const std::filesystem::path& file, const Study& study,
                      const StudyTable& table) try {
  {
    const hdf5::Session session;
    const Handle handle =
        own(H5Fcreate(part_of(file).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
            "create the file");
    write_table(handle.id(), study, table);
    hdf5::write_dataset(handle.id(), "text", study.text);
    check(H5Fflush(handle.id(), H5F_SCOPE_LOCAL), "write the file");
  }
  publish_part(file, Earlier::replaced);
} catch (const hdf5::Failure& failure) {
  throw Error(fmt::format("{}: {}", file.string(), failure.what()));
}

}  // namespace gnomon
