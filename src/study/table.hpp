// A table of results, as CSV and JSON show it: the interface to all programs that read studies.
#pragma once

#include <functional>
#include <gnomon/study/study.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gnomon::study {

/// The value of a cell: a text, an integer, a real, or null if there is none.
using Cell = nlohmann::ordered_json;

inline Cell maybe(const std::optional<double>& value) {
  return value ? Cell(*value) : Cell();
}

struct Column {
  enum class Kind { text, integer, real };
  std::string name;
  std::string unit;
  Kind kind = Kind::text;
  std::string group;    ///< for programs that show some columns only: "error", "cost", ...
  std::string meaning;  ///< a few words
};

/// A column, and where its values come from.
template <class Row>
struct ColumnOf {
  Column column;
  std::function<Cell(const Row&)> value;
};

struct Table {
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows;  ///< a value for each column
};

template <class Row>
Table table_of(const std::vector<ColumnOf<Row>>& columns, const std::vector<Row>& rows) {
  Table table;
  for (const ColumnOf<Row>& from : columns) table.columns.push_back(from.column);
  for (const Row& row : rows) {
    std::vector<Cell>& values = table.rows.emplace_back();
    for (const ColumnOf<Row>& from : columns) values.push_back(from.value(row));
  }
  return table;
}

/// The table of a study: the columns that every study has, one for each swept key,
/// and one for each quantity that a run has observed.
Table results_of(const Study& study, const StudyTable& table);

/// Shortest exact text of a cell; empty when there is no value.
std::string cell_text(const Cell& value);

/// A field of CSV; quotes are doubled within quotes.
std::string csv_text(const std::string& text);
/// The names, then one line per row.
std::string csv_of(const Table& table);

/// The same, but a text where a number is not finite.
Cell finite(const Cell& value);
/// Name, unit, group and meaning of every column.
nlohmann::ordered_json columns_json(const Table& table);
/// The values of a row by the names of their columns.
nlohmann::ordered_json values_json(const Table& table, std::size_t row);
/// The text of a file; bytes that are not UTF-8 are replaced.
std::string json_text(const nlohmann::ordered_json& json);

/// The cheapest run whose shape error, together with that of its reference, is small enough.
struct Recommendation {
  std::size_t sweep = 0;
  double error = 0;                ///< at most, as a part of the wear: 1e-2, 1e-3, 1e-4
  std::optional<std::size_t> row;  ///< of the table, of the least CPU time; absent: none
};

/// For each combination of swept values that has a reference with a known error.
std::vector<Recommendation> recommendations(const StudyTable& table);

/// Says that most runs with a tolerance are stopped by the measured times at about every step, so
/// that their errors are those of these times; empty where they are not.
std::string hidden_tolerances(const Study& study, const StudyTable& table);

/// `recommendations` and `remark`, for study.json.
void add_advice(nlohmann::ordered_json& json, const Study& study, const StudyTable& table);

}  // namespace gnomon::study
