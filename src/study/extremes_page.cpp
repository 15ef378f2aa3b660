// The table of a suite of extreme studies: extremes.csv and index.html.

#include <fmt/format.h>

#include <gnomon/results/versions.hpp>
#include <gnomon/study/extremes.hpp>
#include <map>

#include "study/markup.hpp"
#include "study/page_style.hpp"

namespace gnomon {

namespace {

using namespace study;

constexpr Verdict verdicts[] = {Verdict::agrees, Verdict::refused, Verdict::stopped,
                                Verdict::wrong,  Verdict::hung,    Verdict::crashed};

std::string csv_text(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"') result += '"';
    result += c == '\n' ? ' ' : c;
  }
  return result + '"';
}

std::string maybe(const std::optional<double>& value, const char* format) {
  return value ? fmt::format(fmt::runtime(format), *value) : "";
}

std::string numeric(const std::string& text) {
  return "<td class=\"n\">" + text + "</td>";
}

std::string row_of(const ExtremeCase& c) {
  return fmt::format(
      "<tr{}><td>{}</td><td>{}</td><td>{}</td>{}{}{}{}{}<td class=\"wrap\">{}</td></tr>\n",
      is_fault(c.verdict) ? " class=\"failed\"" : "", escaped(c.sweep), escaped(c.run),
      verdict_name(c.verdict), numeric(maybe(c.difference, "{:.1e}")),
      numeric(maybe(c.bound, "{:.1e}")), numeric(maybe(c.pressure_difference, "{:.1e}")),
      numeric(c.counters ? fmt::format("{}", c.counters->steps) : ""),
      numeric(maybe(c.wall_seconds, "{:.2f}")), escaped(c.reason));
}

/// Studies in the order of their first case, with the number of cases of each verdict.
std::string counts_table(const std::vector<ExtremeCase>& cases) {
  std::map<std::string, std::map<Verdict, int>> counts;
  for (const ExtremeCase& c : cases) ++counts[c.study][c.verdict], ++counts[""][c.verdict];
  std::string text = "<div class=\"scroll\"><table>\n<thead><tr><th scope=\"col\">study</th>";
  for (const Verdict verdict : verdicts)
    text += "<th scope=\"col\" class=\"n\">" + verdict_name(verdict) + "</th>";
  text += "</tr></thead>\n<tbody>\n";
  for (auto& [study, count] : counts) {
    text += "<tr><td>" +
            (study.empty() ? "all" : fmt::format("<a href=\"#{0}\">{0}</a>", escaped(study))) +
            "</td>";
    for (const Verdict verdict : verdicts)
      text += numeric(count.contains(verdict) ? fmt::format("{}", count.at(verdict)) : "&ndash;");
    text += "</tr>\n";
  }
  return text + "</tbody>\n</table></div>\n";
}

std::string case_tables(const std::vector<ExtremeCase>& cases) {
  std::string text, open;
  for (const ExtremeCase& c : cases) {
    if (c.study != open) {
      if (!open.empty()) text += "</tbody>\n</table></div>\n";
      open = c.study;
      text += fmt::format(
          "<h2 id=\"{0}\">{0}</h2>\n<div class=\"scroll\"><table>\n<thead><tr><th scope=\"col\">"
          "sweep</th><th scope=\"col\">run</th><th scope=\"col\">verdict</th><th class=\"n\">"
          "difference</th><th class=\"n\">bound</th><th class=\"n\">pressure</th><th "
          "class=\"n\">steps</th><th class=\"n\">"
          "wall [s]</th><th scope=\"col\">why</th></tr></thead>\n<tbody>\n",
          escaped(c.study));
    }
    text += row_of(c);
  }
  return open.empty() ? text : text + "</tbody>\n</table></div>\n";
}

}  // namespace

std::string extremes_csv(const std::vector<ExtremeCase>& cases) {
  std::string text =
      "study,sweep,run,method,integrator,rtol,file,verdict,difference,bound,marked,"
      "pressure_difference,steps,wall_seconds,reason\n";
  for (const ExtremeCase& c : cases)
    text += fmt::format(
        "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_text(c.study), csv_text(c.sweep),
        csv_text(c.run), csv_text(c.method), csv_text(c.integrator), maybe(c.rtol, "{:g}"),
        csv_text(c.file), verdict_name(c.verdict), maybe(c.difference, "{:.6g}"),
        maybe(c.bound, "{:.6g}"), int(c.marked), maybe(c.pressure_difference, "{:.6g}"),
        c.counters ? fmt::format("{}", c.counters->steps) : "", maybe(c.wall_seconds, "{:.6g}"),
        csv_text(c.reason));
  return text;
}

std::string extremes_page(const std::vector<ExtremeCase>& cases,
                          const std::vector<std::string>& figures, const std::string& note) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>gnomon at the extremes</title>\n<style>{}</style>\n</head>\n<body>\n"
      "<h1>gnomon at the extremes</h1>\n<p>{} cases; gnomon {}. A case <b>agrees</b> when a run "
      "by another method confirms its worn surface with the required accuracy, is "
      "<b>refused</b> before it starts, or is <b>stopped</b> with a diagnosis and its last good "
      "state saved. <b>wrong</b>, <b>hung</b> and <b>crashed</b> are faults of gnomon. The "
      "difference is relative to the norm of the wear; that of the pressure, of the largest at any "
      "node at the end, to the largest pressure, and is not judged. The same table is in "
      "<code>extremes.csv</code>.</p>\n{}{}{}</body>\n</html>\n",
      page_style, cases.size(), escaped(library_versions().at("gnomon")), counts_table(cases),
      figure_part(figures, note), case_tables(cases));
}

}  // namespace gnomon
