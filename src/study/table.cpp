#include "study/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/counter_names.hpp>
#include <gnomon/base/number_text.hpp>

#include "study/declaration.hpp"
#include "study/text_file.hpp"

namespace gnomon::study {

namespace {

using Type = Column::Kind;
using StudyColumn = ColumnOf<StudyRow>;

StudyColumn text(const std::string& name, const std::string& meaning,
                 std::function<std::string(const StudyRow&)> get) {
  return {{name, "", Type::text, "setting", meaning}, std::move(get)};
}

StudyColumn real(const std::string& name, const std::string& unit, const std::string& group,
                 std::optional<double> StudyRow::*member, const std::string& meaning) {
  return {{name, unit, Type::real, group, meaning},
          [member](const StudyRow& row) { return maybe(row.*member); }};
}

StudyColumn of_process(const std::string& name, const std::string& unit, double ProcessEnd::*member,
                       const std::string& meaning) {
  return {{name, unit, Type::real, "cost", meaning},
          [member](const StudyRow& row) { return row.end ? Cell((*row.end).*member) : Cell(); }};
}

StudyColumn count(const std::string& name, long Counters::*member, const std::string& meaning) {
  return {{name, "", Type::integer, "cost", meaning}, [member](const StudyRow& row) {
            return row.counters ? Cell((*row.counters).*member) : Cell();
          }};
}

std::vector<StudyColumn> setting_columns(const Study& study) {
  return {
      text("study", "name of the study", [&](const StudyRow&) { return study.name; }),
      text("sweep", "swept keys and their values", [](const StudyRow& row) { return row.sweep; }),
      text("method", "name of the method in the study",
           [](const StudyRow& row) { return row.point.method; }),
      text("integrator", "name of the integrator",
           [](const StudyRow& row) { return row.point.integrator; }),
      text("setting_kind", "step or rtol",
           [](const StudyRow& row) { return kind_name(row.point.setting.kind); }),
      {{"setting", "s for step", Type::real, "setting", "fixed step, or relative tolerance"},
       [](const StudyRow& row) { return row.point.setting.value; }},
      text("run", "stem of its files in runs/",
           [&](const StudyRow& row) { return study.runs[row.point.run].name; }),
      text("status", "finished, failed or missing", [](const StudyRow& row) { return row.status; }),
      text("reason", "why it failed", [](const StudyRow& row) { return row.reason; }),
  };
}

std::vector<StudyColumn> error_columns() {
  return {
      real("shape_error", "mm", "error", &StudyRow::shape_error,
           "Euclidean norm of the differences of the positions of the contact nodes in the "
           "undeformed (worn) configuration, at the end of the run"),
      real("shape_error_max", "mm", "error", &StudyRow::shape_error_max,
           "the largest of the shape errors at the measured times"),
      real("shape_error_self", "mm", "error", &StudyRow::shape_error_self,
           "shape error at the end against a run of the study itself; it does not contain the "
           "error that both have in common"),
      real("pressure_error", "MPa", "error", &StudyRow::pressure_error,
           "largest difference of a nodal contact pressure at the end"),
  };
}

std::vector<StudyColumn> reference_columns(const StudyTable& table) {
  return {
      {{"reference", "", Type::text, "reference", "what the errors refer to"},
       [&](const StudyRow& row) { return table.references[row.point.sweep].text; }},
      {{"reference_error", "mm", Type::real, "reference",
        "error of the reference itself at the end; 0 for a closed form"},
       [&](const StudyRow& row) { return maybe(table.references[row.point.sweep].error); }},
      {{"marked", "", Type::integer, "reference",
        "1 if a shape error is less than ten times that of its reference, or the latter is "
        "unknown"},
       [](const StudyRow& row) { return int{row.marked_shape || row.marked_max}; }},
  };
}

std::vector<StudyColumn> cost_columns() {
  std::vector<StudyColumn> columns;
  for (const NamedCounter& counter : named_counters) {
    const std::string name = counter.name;  // the column of rejected steps is older
    columns.push_back(
        count(name == "rejected_steps" ? "rejected" : name, counter.value, counter.meaning));
  }
  columns.push_back(
      real("wall_seconds", "s", "cost", &StudyRow::wall_seconds,
           "wall time of the integration; runs at the same time slow each other down"));
  columns.push_back(of_process("cpu_seconds", "s", &ProcessEnd::cpu_seconds,
                               "CPU time of the whole process, user and system"));
  columns.push_back(of_process("peak_memory_mb", "MB", &ProcessEnd::peak_memory_mb,
                               "peak resident memory of the whole process"));
  return columns;
}

/// One for each swept key; every point of a sweep has the same keys.
std::vector<StudyColumn> sweep_columns(const Study& study) {
  std::vector<StudyColumn> columns;
  for (std::size_t i = 0; i < study.sweep.front().values.size(); ++i) {
    const bool numbers = std::ranges::all_of(study.sweep, [i](const SweepPoint& point) {
      return parsed_number<double>(point.values[i].second).has_value();
    });
    const std::string& key = study.sweep.front().values[i].first;
    const auto unit = study.units.find(key);
    columns.push_back({{key, unit == study.units.end() ? "" : unit->second,
                        numbers ? Type::real : Type::text, "sweep", "swept key of the scene"},
                       [&study, i, numbers](const StudyRow& row) {
                         const std::string& value = study.sweep[row.point.sweep].values[i].second;
                         return numbers ? maybe(parsed_number<double>(value)) : Cell(value);
                       }});
  }
  return columns;
}

std::vector<StudyColumn> observed_columns(const StudyTable& table) {
  std::vector<StudyColumn> columns = {
      real("time", "s", "observation", &StudyRow::reached, "time that the run has reached")};
  const auto is_new = [&](const std::string& name) {
    return std::ranges::none_of(
        columns, [&](const StudyColumn& known) { return known.column.name == name; });
  };
  for (const StudyRow& row : table.rows)
    for (const Scalar& scalar : row.observed)
      if (is_new(scalar.name))
        columns.push_back(
            {{scalar.name, scalar.unit, Type::real, "observation", meaning_of(scalar.name)},
             [name = scalar.name](const StudyRow& r) {
               return maybe(value_of(r.observed, name));
             }});
  return columns;
}

}  // namespace

Table results_of(const Study& study, const StudyTable& table) {
  std::vector<StudyColumn> all;
  for (const auto& part : {setting_columns(study), error_columns(), reference_columns(table),
                           cost_columns(), sweep_columns(study), observed_columns(table)})
    all.insert(all.end(), part.begin(), part.end());
  return table_of(all, table.rows);
}

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
