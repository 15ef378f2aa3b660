#include "study/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "study/text_file.hpp"

namespace gnomon::study {

namespace {

struct TextOf {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& value) const { return value; }
};

struct JsonOf {
  Json operator()(std::monostate) const { return nullptr; }
  Json operator()(std::int64_t value) const { return value; }
  Json operator()(double value) const {
    return std::isfinite(value) ? Json(value) : Json(fmt::format("{}", value));
  }
  Json operator()(const std::string& value) const { return value; }
};

}  // namespace

std::string csv_text(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c;
  }
  return result + '"';
}

std::string cell_text(const CellValue& value) {
  return std::visit(TextOf{}, value);
}

std::string csv_of(const Table& table) {
  std::vector<std::string> cells;
  for (const Column& column : table.columns) cells.push_back(csv_text(column.name));
  std::string text = fmt::format("{}\n", fmt::join(cells, ","));
  for (const std::vector<CellValue>& row : table.rows) {
    cells.clear();
    for (const CellValue& value : row) cells.push_back(csv_text(cell_text(value)));
    text += fmt::format("{}\n", fmt::join(cells, ","));
  }
  return text;
}

Json value_json(const CellValue& value) {
  return std::visit(JsonOf{}, value);
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
    values[table.columns[i].name] = value_json(table.rows[row][i]);
  return values;
}

std::string json_text(const Json& json) {
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace gnomon::study
