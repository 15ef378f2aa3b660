#include "study/columns.hpp"

#include <fmt/format.h>

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

std::vector<Column> all_columns() {
  std::vector<Column> all;
  for (const auto& part : {setting_columns(), error_columns(), cost_columns()})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

struct TextOf {
  std::string operator()(std::monostate) const { return {}; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& value) const { return value; }
};

}  // namespace

const std::vector<Column>& columns() {
  static const std::vector<Column> all = all_columns();
  return all;
}

std::string cell_text(const CellValue& value) {
  return std::visit(TextOf{}, value);
}

}  // namespace gnomon::study
