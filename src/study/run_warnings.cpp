#include "study/run_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <set>

namespace gnomon::study {

namespace {

std::string without_numbers(const std::string& text) {
  static const std::regex number(R"(-?\d+(\.\d+)?(e[-+]?\d+)?)");
  return std::regex_replace(text, number, "#");
}

}  // namespace

std::string count_of_runs(std::size_t count) {
  return count == 1 ? "1 run" : fmt::format("{} runs", count);
}

RunWarnings warnings_of(const Study& study, const StudyTable& table) {
  RunWarnings found;
  std::vector<std::string> kinds;
  std::set<std::size_t> seen;
  for (const StudyRow& row : table.rows) {
    if (row.warnings.empty() || !seen.insert(row.point.run).second) continue;
    ++found.runs;
    std::set<std::string> own;
    for (const std::string& text : row.warnings) {
      const std::string kind = without_numbers(text);
      if (!own.insert(kind).second) continue;
      const auto at = std::ranges::find(kinds, kind) - kinds.begin();
      if (at == std::ssize(kinds)) {
        kinds.push_back(kind);
        found.each.push_back({.text = text, .run = study.runs[row.point.run].name});
      }
      ++found.each[static_cast<std::size_t>(at)].runs;
    }
  }
  return found;
}

std::string warnings_text(const RunWarnings& warnings) {
  if (warnings.runs == 0) return {};
  std::string text = fmt::format("warnings of {}:\n", count_of_runs(warnings.runs));
  for (const RunWarning& each : warnings.each)
    text +=
        fmt::format("  {} (as runs/{}.json): {}\n", count_of_runs(each.runs), each.run, each.text);
  return text;
}

}  // namespace gnomon::study
