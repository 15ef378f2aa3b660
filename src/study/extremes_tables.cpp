// The tables of a suite of extreme studies: extremes.csv and extremes.json.

#include <gnomon/results/versions.hpp>
#include <gnomon/study/extremes.hpp>

#include "study/table.hpp"
#include "study/text_file.hpp"

namespace gnomon {

namespace {

using namespace study;
using Type = Column::Kind;
using CaseColumn = ColumnOf<ExtremeCase>;

CaseColumn column(Type type, const std::string& name, const std::string& meaning,
                  std::function<CellValue(const ExtremeCase&)> value,
                  const std::string& unit = "") {
  return {{name, unit, type, "case", meaning}, std::move(value)};
}

std::vector<CaseColumn> case_columns() {
  using Case = const ExtremeCase&;
  return {
      column(Type::text, "study", "name of the study", [](Case c) { return c.study; }),
      column(Type::text, "sweep", "swept keys and their values",
             [](Case c) { return c.row.sweep; }),
      column(Type::text, "run", "method and setting", [](Case c) { return c.run.title; }),
      column(Type::text, "method", "name of the method in the study",
             [](Case c) { return c.row.point.method; }),
      column(Type::text, "integrator", "name of the integrator",
             [](Case c) { return c.row.point.integrator; }),
      column(Type::real, "rtol", "relative tolerance of a run with error control",
             [](Case c) {
               const StudySetting& setting = c.row.point.setting;
               return setting.kind == StudySetting::Kind::step ? CellValue() : setting.value;
             }),
      column(Type::text, "file", "stem of its files in STUDY/runs",
             [](Case c) { return c.run.name; }),
      column(Type::text, "verdict", "how the case ended", [](Case c) { return c.verdict.name; }),
      column(Type::real, "difference",
             "shape error divided by the Euclidean norm of the wear of all contact nodes",
             [](Case c) { return maybe(c.difference); }),
      column(Type::real, "bound", "largest difference that agrees",
             [](Case c) { return maybe(c.bound); }),
      column(Type::integer, "marked",
             "1 if the difference is less than ten times that between the references",
             [](Case c) { return std::int64_t{c.row.marked_shape}; }),
      column(Type::real, "pressure_difference",
             "largest difference of a nodal pressure at the end, divided by the largest pressure; "
             "not judged",
             [](Case c) { return maybe(c.pressure_difference); }),
      column(Type::integer, "steps", "accepted steps",
             [](Case c) {
               return c.row.counters ? CellValue(std::int64_t{c.row.counters->steps}) : CellValue();
             }),
      column(
          Type::real, "wall_seconds", "wall time of the integration",
          [](Case c) { return maybe(c.row.wall_seconds); }, "s"),
      column(Type::text, "reason", "why", [](Case c) { return c.reason; }),
  };
}

}  // namespace

std::string extremes_csv(const std::vector<ExtremeCase>& cases) {
  return csv_of(table_of(case_columns(), cases));
}

std::string extremes_json(const std::vector<ExtremeCase>& cases) {
  const Table table = table_of(case_columns(), cases);
  Json json = {{"gnomon", library_versions().at("gnomon")},
               {"verdicts", Json::array()},
               {"columns", columns_json(table)},
               {"rows", Json::array()}};
  for (const Verdict& verdict : verdicts::all)
    json["verdicts"].push_back(
        {{"name", verdict.name}, {"meaning", verdict.meaning}, {"fault", verdict.fault}});
  for (std::size_t i = 0; i < cases.size(); ++i) {
    Json marked = Json::array();
    if (cases[i].row.marked_shape && cases[i].difference) marked.push_back("difference");
    json["rows"].push_back({{"marked", marked}, {"values", values_json(table, i)}});
  }
  return json_text(json);
}

}  // namespace gnomon
