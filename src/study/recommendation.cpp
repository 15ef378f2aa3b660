#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "study/table.hpp"

namespace gnomon::study {

namespace {

/// The shape error that a run certainly does not exceed; absent where that is not known.
std::optional<double> certain_error(const StudyRow& row, const StudyReference& reference) {
  if (!row.shape_error || !row.end || !reference.error) return std::nullopt;
  return *row.shape_error + *reference.error;
}

}  // namespace

std::vector<Recommendation> recommendations(const StudyTable& table) {
  std::vector<Recommendation> found;
  for (std::size_t sweep = 0; sweep < table.references.size(); ++sweep) {
    const StudyReference& reference = table.references[sweep];
    if (!reference.error) continue;
    for (const double part : {1e-2, 1e-3, 1e-4}) {
      Recommendation& best = found.emplace_back(Recommendation{sweep, part, {}});
      for (std::size_t i = 0; i < table.rows.size(); ++i) {
        const StudyRow& row = table.rows[i];
        const auto error = certain_error(row, reference);
        if (row.point.sweep != sweep || !error || *error > part * reference.wear) continue;
        if (!best.row || row.end->cpu_seconds < table.rows[*best.row].end->cpu_seconds)
          best.row = i;
      }
    }
  }
  return found;
}

std::string hidden_tolerances(const Study& study, const StudyTable& table) {
  constexpr std::size_t free = 2;  // steps between measured times, of which one is not cut short
  std::size_t tolerances = 0, hidden = 0, fewest = 0;
  for (const StudyRow& row : table.rows) {
    if (row.point.setting.kind != StudySetting::Kind::tolerance || !row.shape_error) continue;
    const std::size_t times = study.sweep[row.point.sweep].times.size();
    ++tolerances;
    if (static_cast<std::size_t>(row.counters->steps) >= free * times) continue;
    ++hidden;
    fewest = fewest == 0 ? times : std::min(fewest, times);
  }
  if (2 * hidden <= tolerances) return {};
  return fmt::format(
      "{} of {} runs with a tolerance take less than {} steps between two measured times: these "
      "times ({} or more), not the tolerance, set their steps and errors; `times` with fewer of "
      "them shows what the tolerance does",
      hidden, tolerances, free, fewest);
}

void add_advice(nlohmann::ordered_json& json, const Study& study, const StudyTable& table) {
  auto& list = json["recommendations"] = nlohmann::ordered_json::array();
  for (const Recommendation& each : recommendations(table)) {
    auto& written = list.emplace_back(
        nlohmann::ordered_json{{"sweep", each.sweep}, {"error", each.error}, {"row", nullptr}});
    if (each.row) written["row"] = *each.row;
  }
  json["remark"] = hidden_tolerances(study, table);
}

}  // namespace gnomon::study
