#include "study/columns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "study/declaration.hpp"

namespace gnomon::study {

namespace {

using Kind = Column::Kind;

template <class T>
CellValue maybe(const std::optional<T>& value) {
  return value ? CellValue(*value) : CellValue();
}

Column text(const std::string& name, std::function<std::string(const StudyRow&)> get) {
  return {name, "", Kind::text,
          [get](const Study&, const StudyTable&, const StudyRow& row) { return get(row); }};
}

Column real(const std::string& name, const std::string& unit,
            std::optional<double> StudyRow::*member) {
  return {name, unit, Kind::real, [member](const Study&, const StudyTable&, const StudyRow& row) {
            return maybe(row.*member);
          }};
}

Column count(const std::string& name, long Counters::*member) {
  return {name, "", Kind::integer, [member](const Study&, const StudyTable&, const StudyRow& row) {
            return row.counters ? CellValue(std::int64_t{(*row.counters).*member}) : CellValue();
          }};
}

std::vector<Column> setting_columns() {
  return {
      {"study", "", Kind::text,
       [](const Study& study, const StudyTable&, const StudyRow&) { return study.name; }},
      text("sweep", [](const StudyRow& row) { return row.sweep; }),
      text("method", [](const StudyRow& row) { return row.point.method; }),
      text("integrator", [](const StudyRow& row) { return row.point.integrator; }),
      text("setting_kind", [](const StudyRow& row) { return kind_name(row.point.setting.kind); }),
      {"setting", "s for step", Kind::real,
       [](const Study&, const StudyTable&, const StudyRow& row) {
         return row.point.setting.value;
       }},
      {"run", "", Kind::text,
       [](const Study& study, const StudyTable&, const StudyRow& row) {
         return study.runs[row.point.run].name;
       }},
      text("status", [](const StudyRow& row) { return row.status; }),
      text("reason", [](const StudyRow& row) { return row.reason; }),
  };
}

std::vector<Column> error_columns() {
  return {
      real("shape_error", "mm", &StudyRow::shape_error),
      real("shape_error_max", "mm", &StudyRow::shape_error_max),
      real("shape_error_self", "mm", &StudyRow::shape_error_self),
      real("pressure_error", "MPa", &StudyRow::pressure_error),
      {"reference", "", Kind::text,
       [](const Study&, const StudyTable& table, const StudyRow& row) {
         return table.references[row.point.sweep].text;
       }},
      {"reference_error", "mm", Kind::real,
       [](const Study&, const StudyTable& table, const StudyRow& row) {
         return maybe(table.references[row.point.sweep].error);
       }},
      {"marked", "", Kind::integer,
       [](const Study&, const StudyTable&, const StudyRow& row) {
         return std::int64_t{row.marked_shape || row.marked_max};
       }},
  };
}

std::vector<Column> cost_columns() {
  return {
      count("steps", &Counters::steps),
      count("rejected", &Counters::rejected_steps),
      count("events", &Counters::events),
      count("newton_iterations", &Counters::newton_iterations),
      count("residual_evaluations", &Counters::residual_evaluations),
      count("jacobian_evaluations", &Counters::jacobian_evaluations),
      count("factorizations", &Counters::factorizations),
      count("linear_solves", &Counters::linear_solves),
      count("krylov_iterations", &Counters::krylov_iterations),
      count("preconditioner_setups", &Counters::preconditioner_setups),
      real("wall_seconds", "s", &StudyRow::wall_seconds),
      real("cpu_seconds", "s", &StudyRow::cpu_seconds),
      real("peak_memory_mb", "MB", &StudyRow::peak_memory_mb),
  };
}

/// The number that a text is, if it is one.
std::optional<double> number_in(const std::string& text) {
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, number);
  if (parsed != end || error != std::errc()) return std::nullopt;
  return number;
}

/// One for each swept key; every point of a sweep has the same keys.
std::vector<Column> sweep_columns(const Study& study) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < study.sweep.front().values.size(); ++i) {
    const bool numbers = std::ranges::all_of(study.sweep, [i](const SweepPoint& point) {
      return number_in(point.values[i].second).has_value();
    });
    columns.push_back({study.sweep.front().values[i].first, "", numbers ? Kind::real : Kind::text,
                       [i, numbers](const Study& s, const StudyTable&, const StudyRow& row) {
                         const std::string& value = s.sweep[row.point.sweep].values[i].second;
                         return numbers ? maybe(number_in(value)) : CellValue(value);
                       }});
  }
  return columns;
}

CellValue observed(const StudyRow& row, const std::string& name) {
  const auto found = std::ranges::find(row.observed, name, &Scalar::name);
  return found == row.observed.end() ? CellValue() : CellValue(found->value);
}

std::vector<Column> observed_columns(const StudyTable& table) {
  std::vector<Column> columns;
  for (const StudyRow& row : table.rows)
    for (const Scalar& scalar : row.observed)
      if (std::ranges::find(columns, scalar.name, &Column::name) == columns.end())
        columns.push_back({scalar.name, scalar.unit, Kind::real,
                           [name = scalar.name](const Study&, const StudyTable&,
                                                const StudyRow& r) { return observed(r, name); }});
  return columns;
}

struct TextOf {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& value) const { return value; }
};

}  // namespace

std::vector<Column> columns(const Study& study, const StudyTable& table) {
  std::vector<Column> all;
  for (const auto& part : {setting_columns(), error_columns(), cost_columns(), sweep_columns(study),
                           observed_columns(table)})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

std::string cell_text(const CellValue& value) {
  return std::visit(TextOf{}, value);
}

}  // namespace gnomon::study
