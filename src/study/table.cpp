#include "study/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "study/text_file.hpp"

namespace gnomon::study {

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

std::string cell_text(const Cell& value) {
  if (value.is_null()) return {};
  if (value.is_string()) return value;
  return value.is_number_float() ? fmt::format("{}", value.get<double>()) : value.dump();
}

std::string csv_of(const Table& table) {
  std::vector<std::string> cells;
  for (const Column& column : table.columns) cells.push_back(csv_text(column.name));
  std::string text = fmt::format("{}\n", fmt::join(cells, ","));
  for (const std::vector<Cell>& row : table.rows) {
    cells.clear();
    for (const Cell& value : row) cells.push_back(csv_text(cell_text(value)));
    text += fmt::format("{}\n", fmt::join(cells, ","));
  }
  return text;
}

Cell finite(const Cell& value) {
  const bool is_finite = !value.is_number_float() || std::isfinite(value.get<double>());
  return is_finite ? value : Cell(cell_text(value));
}

Json columns_json(const Table& table) {
  Json columns = Json::array();
  for (const Column& column : table.columns)
    columns.push_back({{"name", column.name},
                       {"unit", column.unit},
                       {"group", column.group},
                       {"meaning", column.meaning}});
  return columns;
}

Json values_json(const Table& table, std::size_t row) {
  Json values = Json::object();
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    values[table.columns[i].name] = finite(table.rows[row][i]);
  return values;
}

std::string json_text(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gnomon::study
