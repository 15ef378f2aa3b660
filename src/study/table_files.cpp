// study.csv, study.json and study.h5.

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <gnomon/base/error.hpp>
#include <gnomon/results/versions.hpp>
#include <gnomon/study/study.hpp>
#include <limits>

#include "results/hdf5_handles.hpp"
#include "results/hdf5_values.hpp"
#include "results/layout.hpp"
#include "results/replaced_file.hpp"
#include "study/run_warnings.hpp"
#include "study/table.hpp"
#include "study/text_file.hpp"

namespace gnomon {

namespace {

using namespace study;
using hdf5::check;
using hdf5::Handle;
using hdf5::own;

/// The type of a column; a text is as long as the longest.
Handle type_of(const Table& table, std::size_t column) {
  const auto native = [](hid_t type) { return own(H5Tcopy(type), H5Tclose, "describe a table"); };
  const Column::Kind kind = table.columns[column].kind;
  if (kind == Column::Kind::integer) return native(H5T_NATIVE_INT64);
  if (kind == Column::Kind::real) return native(H5T_NATIVE_DOUBLE);
  std::size_t size = 1;
  for (const auto& row : table.rows) size = std::max(size, cell_text(row[column]).size());
  return hdf5::text_type(size);
}

/// A missing value is written as NaN, or as -1 for counts.
void put(char* target, Column::Kind kind, const Cell& value) {
  const auto put_number = [&](auto number) {
    if (!value.is_null()) value.get_to(number);
    std::memcpy(target, &number, sizeof number);
  };
  if (kind == Column::Kind::integer) return put_number(std::int64_t{-1});
  if (kind == Column::Kind::real) return put_number(std::numeric_limits<double>::quiet_NaN());
  const std::string text = cell_text(value);
  std::copy(text.begin(), text.end(), target);
}

void write_table(hid_t file, const Table& table) {
  std::vector<Handle> types;
  std::vector<layout::Member> members;
  std::size_t row_size = 0;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    types.push_back(type_of(table, i));
    members.push_back({table.columns[i].name.c_str(), row_size, types.back().id()});
    row_size += H5Tget_size(types.back().id());
  }
  const Handle type = layout::row_type(row_size, members);
  std::vector<char> bytes(row_size * table.rows.size(), '\0');
  std::vector<std::string> units;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const Column& column = table.columns[i];
    for (std::size_t row = 0; row < table.rows.size(); ++row)
      put(&bytes[row * row_size + members[i].offset], column.kind, table.rows[row][i]);
    units.push_back(column.unit);
  }
  const Handle dataset = hdf5::create_dataset(file, "study", type.id(), {table.rows.size()});
  check(H5Dwrite(dataset.id(), type.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()),
        "write a table");
  hdf5::write_attribute(dataset.id(), "units", units);
}

Json reference_json(const StudyReference& reference, bool closed_form) {
  return {{"text", reference.text},
          {"closed_form", closed_form},
          {"error", finite(maybe(reference.error))},
          {"error_max", finite(maybe(reference.error_max))},
          {"pressure_error", finite(maybe(reference.pressure_error))}};
}

Json sweep_json(const SweepPoint& point) {
  Json json = {{"label", point.label}, {"values", Json::object()}, {"times", point.times}};
  for (const auto& [key, value] : point.values) json["values"][key] = value;
  return json;
}

Json warnings_json(const RunWarnings& warnings) {
  Json json = {{"runs", warnings.runs}, {"each", Json::array()}};
  for (const RunWarning& each : warnings.each)
    json["each"].push_back({{"runs", each.runs}, {"run", each.run}, {"text", each.text}});
  return json;
}

/// The columns of a row whose errors its reference cannot resolve.
Json marked_of(const StudyRow& row) {
  Json marked = Json::array();
  if (row.shape_error && row.marked_shape) marked.push_back("shape_error");
  if (row.shape_error_max && row.marked_max) marked.push_back("shape_error_max");
  if (row.pressure_error && row.marked_pressure) marked.push_back("pressure_error");
  return marked;
}

}  // namespace

std::string study_csv(const Study& study, const StudyTable& table) {
  return csv_of(results_of(study, table));
}

std::string study_json(const Study& study, const StudyTable& table) {
  const Table results = results_of(study, table);
  Json json = {{"gnomon", library_versions().at("gnomon")},
               {"study", study.name},
               {"title", study.title},
               {"scene", study.scene.filename().string()},
               {"compared", study.compared},
               {"self_reference", study.self_reference},
               {"sweep", Json::array()},
               {"columns", columns_json(results)},
               {"rows", Json::array()},
               {"warnings", warnings_json(warnings_of(study, table))},
               {"text", study.text}};
  for (std::size_t i = 0; i < study.sweep.size(); ++i) {
    const SweepPoint& point = study.sweep[i];
    Json& written = json["sweep"].emplace_back(sweep_json(point));
    if (study.compared)
      written["reference"] = reference_json(table.references[i], point.has_closed_form());
  }
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    json["rows"].push_back({{"sweep", table.rows[i].point.sweep},
                            {"marked", marked_of(table.rows[i])},
                            {"warnings", table.rows[i].warnings},
                            {"values", values_json(results, i)}});
  if (study.compared) add_advice(json, study, table);
  return json_text(json);
}

void write_study_hdf5(const std::filesystem::path& file, const Study& study,
                      const StudyTable& table) try {
  {
    const hdf5::Session session;
    const Handle handle =
        own(H5Fcreate(part_of(file).c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose,
            "create the file");
    write_table(handle.id(), results_of(study, table));
    hdf5::write_dataset(handle.id(), "text", study.text);
    check(H5Fflush(handle.id(), H5F_SCOPE_LOCAL), "write the file");
  }
  publish_part(file, Earlier::replaced);
} catch (const hdf5::Failure& failure) {
  throw Error(fmt::format("{}: {}", file.string(), failure.what()));
}

}  // namespace gnomon
