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

struct Meaning {
  Verdict verdict;
  const char* text;
};

constexpr Meaning meanings[] = {
    {Verdict::agrees, "finished, and another method confirms its worn surface as accurate enough"},
    {Verdict::refused, "bad input, refused before the start"},
    {Verdict::stopped, "ended with a diagnosis, the last good state saved"},
    {Verdict::wrong,
     "finished with a shape that no reference confirms, or lost its last good state"},
    {Verdict::hung, "killed after the longest time that a run may take"},
    {Verdict::crashed, "ended by a signal, or in another way than those above"}};

template <class T>
CellValue maybe(const std::optional<T>& value) {
  return value ? CellValue(*value) : CellValue();
}

CaseColumn text(const std::string& name, const std::string& meaning,
                std::string ExtremeCase::*member) {
  return {{name, "", Type::text, "case", meaning},
          [member](const ExtremeCase& c) { return c.*member; }};
}

CaseColumn real(const std::string& name, const std::string& unit, const std::string& meaning,
                std::optional<double> ExtremeCase::*member) {
  return {{name, unit, Type::real, "case", meaning},
          [member](const ExtremeCase& c) { return maybe(c.*member); }};
}

std::vector<CaseColumn> case_columns() {
  return {
      text("study", "name of the study", &ExtremeCase::study),
      text("sweep", "swept keys and their values", &ExtremeCase::sweep),
      text("run", "method and setting", &ExtremeCase::run),
      text("method", "name of the method in the study", &ExtremeCase::method),
      text("integrator", "name of the integrator", &ExtremeCase::integrator),
      real("rtol", "", "relative tolerance of a run with error control", &ExtremeCase::rtol),
      text("file", "stem of its files in STUDY/runs", &ExtremeCase::file),
      {{"verdict", "", Type::text, "case", "how the case ended"},
       [](const ExtremeCase& c) { return verdict_name(c.verdict); }},
      real("difference", "",
           "shape error divided by the Euclidean norm of the wear of all contact nodes",
           &ExtremeCase::difference),
      real("bound", "", "largest difference that agrees", &ExtremeCase::bound),
      {{"marked", "", Type::integer, "case",
        "1 if the difference is less than ten times that between the references"},
       [](const ExtremeCase& c) { return std::int64_t{c.marked}; }},
      real("pressure_difference", "",
           "largest difference of a nodal pressure at the end, divided by the largest pressure; "
           "not judged",
           &ExtremeCase::pressure_difference),
      {{"steps", "", Type::integer, "case", "accepted steps"},
       [](const ExtremeCase& c) {
         return c.counters ? CellValue(std::int64_t{c.counters->steps}) : CellValue();
       }},
      real("wall_seconds", "s", "wall time of the integration", &ExtremeCase::wall_seconds),
      text("reason", "why", &ExtremeCase::reason),
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
  for (const auto& [verdict, text] : meanings)
    json["verdicts"].push_back(
        {{"name", verdict_name(verdict)}, {"meaning", text}, {"fault", is_fault(verdict)}});
  for (std::size_t i = 0; i < cases.size(); ++i) {
    Json marked = Json::array();
    if (cases[i].marked && cases[i].difference) marked.push_back("difference");
    json["rows"].push_back({{"marked", marked}, {"values", values_json(table, i)}});
  }
  return json_text(json);
}

}  // namespace gnomon
