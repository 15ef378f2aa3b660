// index.html: figures and tables of a study on one self-contained page.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <gnomon/results/versions.hpp>
#include <gnomon/study/study.hpp>

#include "study/declaration.hpp"
#include "study/markup.hpp"
#include "study/page_style.hpp"

namespace gnomon {

namespace {

using namespace study;

constexpr const char* mark = "&thinsp;*";

std::string number(const std::optional<double>& value, const char* format = "{:.2e}") {
  if (!value) return "&ndash;";
  return std::isfinite(*value) ? fmt::format(fmt::runtime(format), *value) : "not finite";
}

std::string heading(const std::string& title, const std::string& unit, bool numeric) {
  return fmt::format("<th scope=\"col\"{}>{}{}</th>", numeric ? " class=\"n\"" : "", title,
                     unit.empty() ? "" : fmt::format("<br><span class=\"unit\">{}</span>", unit));
}

std::string cell(const std::string& content, bool marked = false) {
  return fmt::format("<td class=\"n{}\">{}{}</td>", marked ? " marked" : "", content,
                     marked ? mark : "");
}

std::string text_cell(const std::string& text, const char* attributes = "") {
  return fmt::format("<td{}>{}</td>", attributes, escaped(text));
}

struct Counted {
  const char* title;
  long Counters::*member;
};

constexpr Counted counted[] = {
    {"steps", &Counters::steps},
    {"rejected", &Counters::rejected_steps},
    {"events", &Counters::events},
    {"Newton", &Counters::newton_iterations},
    {"residuals", &Counters::residual_evaluations},
    {"Jacobians", &Counters::jacobian_evaluations},
    {"factors", &Counters::factorizations},
    {"solves", &Counters::linear_solves},
};

class Page {
public:
  Page(const Study& study, const StudyTable& table)
      : study_(study), table_(table), observed_(observed_of(table)) {}

  std::string operator()(const std::vector<std::string>& figures, const std::string& note) const {
    const std::string title = study_.title.empty() ? study_.name : study_.title;
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n{2}{3}"
        "{4}<h2>Runs</h2>\n{5}{6}"
        "<h2>The study</h2>\n<pre>{7}</pre>\n</body>\n</html>\n",
        escaped(title), page_style, introduction(), figure_part(figures, note),
        study_.compared ? reference_table() : "", legend(), run_tables(), escaped(study_.text));
  }

private:
  bool has_self() const { return !study_.self_reference.empty(); }

  std::string introduction() const {
    const auto failed = std::count_if(table_.rows.begin(), table_.rows.end(),
                                      [](const StudyRow& row) { return row.status != "finished"; });
    return fmt::format(
        "<p>Study <code>{}</code> of the scene <code>{}</code>: {} runs, {} failed; gnomon {}. The "
        "same table is in <code>study.csv</code> and <code>study.h5</code>, every run in "
        "<code>runs/</code>.</p>\n",
        escaped(study_.name), escaped(study_.scene.filename().string()), table_.rows.size(), failed,
        escaped(library_versions().at("gnomon")));
  }

  std::string reference_introduction() const {
    const auto closed = std::count_if(study_.sweep.begin(), study_.sweep.end(),
                                      [](const SweepPoint& s) { return s.has_closed_form(); });
    std::string text = "<p>";
    if (closed > 0)
      text += "A closed form of the shape is exact; pressures then have no reference. ";
    if (closed < std::ssize(study_.sweep))
      text +=
          "Errors are measured against the first run named here; the second, of another family of "
          "methods, checks it. Their difference estimates the error of the reference itself.";
    return text + "</p>\n";
  }

  std::string reference_table() const {
    std::string text = "<h2>References</h2>\n" + reference_introduction() +
                       "<div class=\"scroll\"><table>\n<thead><tr>";
    text += heading("sweep", "", false) + heading("reference", "", false) +
            heading("difference of shape<br>at the end", "mm", true) +
            heading("difference of shape<br>largest in time", "mm", true) +
            heading("difference of pressure<br>at the end", "MPa", true) +
            "</tr></thead>\n<tbody>\n";
    for (std::size_t i = 0; i < table_.references.size(); ++i) {
      const StudyReference& reference = table_.references[i];
      const auto own = [&](const std::optional<double>& error) {
        return cell(study_.sweep[i].has_closed_form() ? "exact" : number(error));
      };
      text += fmt::format("<tr{}>", reference.error ? "" : " class=\"failed\"");
      text += text_cell(sweep_title(study_.sweep[i].label)) +
              text_cell(reference.text, " class=\"wrap\"") + own(reference.error) +
              own(reference.error_max) + cell(number(reference.pressure_error)) + "</tr>\n";
    }
    return text + "</tbody>\n</table></div>\n";
  }

  static std::string sweep_title(const std::string& label) {
    return label.empty() ? "no sweep" : label;
  }

  std::string legend() const {
    std::string text = "<dl>\n";
    if (study_.compared) text += error_legend();
    text += fmt::format(
        "<dt>wall time, CPU time, memory</dt><dd>Wall time of the integration; CPU time (user and "
        "system) and peak resident memory of the whole process. Runs at the same time slow each "
        "other "
        "down.</dd>\n{}</dl>\n",
        mark_legend());
    if (!study_.compared) return text + "<p>Results at the end of each run.</p>\n";
    return text + fmt::format("<p>Measured at t = {:g} s{}.</p>\n",
                              fmt::join(study_.sweep.front().times, ", "),
                              same_times() ? "" : " in the first sweep point");
  }

  std::string error_legend() const {
    std::string text =
        "<dt>shape error</dt><dd>Euclidean norm of the differences of the positions of the "
        "contact nodes in the undeformed (worn) configuration, at the end of the run; "
        "<em>largest</em>: the largest of the measured times.</dd>\n";
    if (has_self())
      text += fmt::format(
          "<dt>self error</dt><dd>The same at the end, against the run {} of this study instead "
          "of the reference. It does not contain the error that both have in common.</dd>\n",
          escaped(study_.self_reference));
    return text +
           "<dt>pressure error</dt><dd>Largest difference of a nodal contact pressure at the "
           "end.</dd>\n";
  }

  std::string mark_legend() const {
    const bool any = std::any_of(table_.rows.begin(), table_.rows.end(), [](const StudyRow& row) {
      return row.marked_shape || row.marked_max || row.marked_pressure;
    });
    if (!any) return {};
    return fmt::format(
        "<dt class=\"marked\">marked cells: {}</dt><dd>The error is less than ten times that of "
        "its reference, or the latter is unknown: the digits of the error mean little.</dd>\n",
        mark);
  }

  bool same_times() const {
    return std::all_of(study_.sweep.begin(), study_.sweep.end(), [&](const SweepPoint& point) {
      return point.times == study_.sweep.front().times;
    });
  }

  std::string run_tables() const {
    std::string text;
    for (std::size_t i = 0; i < study_.sweep.size(); ++i) {
      if (!study_.sweep[i].label.empty())
        text += fmt::format("<h3>{}</h3>\n", escaped(study_.sweep[i].label));
      text += "<div class=\"scroll\"><table>\n" + run_heading() + "<tbody>\n";
      for (const StudyRow& row : table_.rows)
        if (row.point.sweep == i) text += run_row(row);
      text += "</tbody>\n</table></div>\n";
    }
    return text;
  }

  std::string run_heading() const {
    std::string text = "<thead><tr>" + heading("method", "", false) +
                       heading("setting", "", false) + (study_.compared ? error_heading() : "");
    if (!study_.compared)
      for (const Scalar& scalar : observed_) text += heading(scalar.name, scalar.unit, true);
    for (const Counted& count : counted) text += heading(count.title, "", true);
    return text + heading("wall", "s", true) + heading("CPU", "s", true) +
           heading("memory", "MB", true) + "</tr></thead>\n";
  }

  std::string error_heading() const {
    return heading("shape error", "mm", true) + heading("largest", "mm", true) +
           (has_self() ? heading("self error", "mm", true) : "") +
           heading("pressure error", "MPa", true);
  }

  /// Units and names of what the runs have observed.
  static std::vector<Scalar> observed_of(const StudyTable& table) {
    for (const StudyRow& row : table.rows)
      if (!row.observed.empty()) return row.observed;
    return {};
  }

  std::string observed(const StudyRow& row) const {
    std::string text;
    for (const Scalar& column : observed_) {
      const auto found = std::ranges::find(row.observed, column.name, &Scalar::name);
      text += cell(found == row.observed.end() ? "&ndash;" : fmt::format("{:.5g}", found->value));
    }
    return text;
  }

  std::size_t columns_of_results() const {
    if (!study_.compared) return std::max<std::size_t>(observed_.size(), 1);
    return has_self() ? 4 : 3;
  }

  std::string run_row(const StudyRow& row) const {
    const bool failed = row.status != "finished";
    const StudyPoint& point = row.point;
    const bool step = point.setting.kind == StudySetting::Kind::step;
    std::string text = failed ? "<tr class=\"failed\">" : "<tr>";
    text += text_cell(point.method == point.integrator
                          ? point.method
                          : fmt::format("{} ({})", point.method, point.integrator)) +
            text_cell(fmt::format("{} {}{}", kind_name(point.setting.kind),
                                  number_text(point.setting.value), step ? " s" : ""));
    text += failed ? fmt::format("<td colspan=\"{}\" class=\"wrap\">{}</td>", columns_of_results(),
                                 escaped(row.status + ": " + row.reason))
            : study_.compared ? errors(row)
                              : observed(row);
    for (const Counted& count : counted)
      text += cell(row.counters ? fmt::format("{}", (*row.counters).*count.member) : "&ndash;");
    return text + cell(number(row.wall_seconds, "{:.2f}")) +
           cell(number(row.cpu_seconds, "{:.2f}")) + cell(number(row.peak_memory_mb, "{:.0f}")) +
           "</tr>\n";
  }

  std::string errors(const StudyRow& row) const {
    return cell(number(row.shape_error), row.shape_error && row.marked_shape) +
           cell(number(row.shape_error_max), row.shape_error_max && row.marked_max) +
           (has_self() ? cell(number(row.shape_error_self)) : "") +
           cell(number(row.pressure_error), row.pressure_error && row.marked_pressure);
  }

  const Study& study_;
  const StudyTable& table_;
  const std::vector<Scalar> observed_;
};

}  // namespace

std::string study_page(const Study& study, const StudyTable& table,
                       const std::vector<std::string>& figures, const std::string& note) {
  return Page(study, table)(figures, note);
}

}  // namespace gnomon
