#include "app/study_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/results/result_files.hpp>

#include "app/plotting_script.hpp"
#include "app/text_table.hpp"
#include "study/recommendation.hpp"

namespace gnomon::app {

namespace {

std::string error_text(const std::optional<double>& error, bool marked) {
  return error ? fmt::format("{:.2e}{}", *error, marked ? "*" : " ") : "- ";
}

std::string own_error_text(const SweepPoint& sweep, const std::optional<double>& error) {
  if (sweep.has_closed_form()) return "exact";
  return error ? fmt::format("own error {:.2e}", *error) : "own error unknown";
}

/// What a table on the terminal has room for, where a study measures no errors.
constexpr const char* shown[] = {"worn_volume", "max_pressure", "contact_half_width"};

/// Name and unit of a shown quantity; empty if no run has observed it.
std::string shown_title(const StudyTable& table, const std::string& name) {
  for (const StudyRow& row : table.rows)
    if (const Scalar* const scalar = find_scalar(row.observed, name))
      return fmt::format("{} [{}]", name, scalar->unit);
  return {};
}

std::string status_text(const StudyRow& row) {
  return row.status == "finished" ? "" : row.status + ": " + row.reason;
}

/// The results of a parameter sweep.
void print_observed(const Study& study, const StudyTable& table) {
  constexpr auto right = TextTable::Align::right;
  std::vector<TextTable::Column> columns = {{"sweep"}, {"run"}};
  std::vector<std::string> names;
  for (const char* name : shown)
    if (const std::string title = shown_title(table, name); !title.empty()) {
      columns.push_back({title, right});
      names.push_back(name);
    }
  columns.insert(columns.end(), {{"CPU [s]", right}, {}});
  TextTable text(columns);
  for (const StudyRow& row : table.rows) {
    std::vector<std::string> cells = {row.sweep, study.runs[row.point.run].title};
    for (const std::string& name : names) {
      const Scalar* const scalar = find_scalar(row.observed, name);
      cells.push_back(scalar ? fmt::format("{:.5g}", scalar->value) : "-");
    }
    cells.push_back(row.end ? fmt::format("{:.2f}", row.end->cpu_seconds) : "-");
    cells.push_back(status_text(row));
    text.add(cells);
  }
  fmt::print("{}", text.text());
}

void print_errors(const Study& study, const StudyTable& table) {
  constexpr auto right = TextTable::Align::right;
  TextTable text({{"sweep"},
                  {"run"},
                  {"shape error [mm]", right},
                  {"steps", right},
                  {"factors", right},
                  {"CPU [s]", right},
                  {}});
  for (const StudyRow& row : table.rows)
    text.add({row.sweep, study.runs[row.point.run].title,
              error_text(row.shape_error, row.marked_shape),
              row.counters ? fmt::format("{}", row.counters->steps) : "-",
              row.counters ? fmt::format("{}", row.counters->factorizations) : "-",
              row.end ? fmt::format("{:.2f}", row.end->cpu_seconds) : "-", status_text(row)});
  fmt::print("{}", text.text());
  for (std::size_t i = 0; i < table.references.size(); ++i) {
    const std::string& label = study.sweep[i].label;
    fmt::print("reference{}: {}, {}\n", label.empty() ? "" : " at " + label,
               table.references[i].text, own_error_text(study.sweep[i], table.references[i].error));
  }
  const bool marked = std::any_of(table.rows.begin(), table.rows.end(),
                                  [](const StudyRow& row) { return row.marked_shape; });
  if (marked)
    fmt::print("* less than ten times the error of the reference, or the latter is unknown\n");
}

/// The cheapest run of each accuracy.
void print_advice(const Study& study, const StudyTable& table) {
  constexpr auto right = TextTable::Align::right;
  TextTable text({{"sweep"},
                  {"error / wear", right},
                  {"cheapest run"},
                  {"shape error [mm]", right},
                  {"Newton", right},
                  {"CPU [s]", right}});
  const auto found = study::recommendations(table);
  for (const auto& each : found) {
    std::vector<std::string> cells = {study.sweep[each.sweep].label,
                                      fmt::format("{:.0e}", each.error)};
    if (each.row) {
      const StudyRow& row = table.rows[*each.row];
      cells.insert(cells.end(),
                   {study.runs[row.point.run].title, fmt::format("{:.2e}", *row.shape_error),
                    fmt::format("{}", row.counters->newton_iterations),
                    fmt::format("{:.2f}", row.end->cpu_seconds)});
    } else {
      cells.insert(cells.end(), {"none of these", "-", "-", "-"});
    }
    text.add(cells);
  }
  if (!found.empty()) fmt::print("recommended:\n{}", text.text());
  if (const std::string remark = study::hidden_tolerances(study, table); !remark.empty())
    fmt::print("{}\n", remark);
}

}  // namespace

void write_study(const Study& study, const std::filesystem::path& folder, bool quiet) {
  const StudyTable table = measure(study, folder);
  write_file(folder / "study.csv", study_csv(study, table), Earlier::replaced);
  write_study_hdf5(folder / "study.h5", study, table);
  write_file(folder / "study.json", study_json(study, table), Earlier::replaced);
  const DrawnPage page = draw_page(folder, "study");
  if (!quiet) {
    study.compared ? print_errors(study, table) : print_observed(study, table);
    if (study.compared) print_advice(study, table);
    fmt::print("{}results: {} ({}study.csv, study.json, study.h5, runs)\n", page.complaint,
               folder.string(), page.listed());
  }
  if (std::ranges::none_of(table.rows,
                           [](const StudyRow& row) { return row.status == "finished"; }))
    throw SolutionError(fmt::format("all {} runs of the table failed (reasons in {})",
                                    table.rows.size(), (folder / "study.csv").string()));
}

}  // namespace gnomon::app
