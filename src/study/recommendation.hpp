// What a study advises: the cheapest run of each accuracy, and where its errors do not show what
// the tolerances do.
#pragma once

#include <gnomon/study/study.hpp>
#include <nlohmann/json_fwd.hpp>

namespace gnomon::study {

/// The cheapest run whose shape error, together with that of its reference, is small enough.
struct Recommendation {
  std::size_t sweep = 0;
  double error = 0;                ///< at most, as a part of the wear: 1e-2, 1e-3, 1e-4
  std::optional<std::size_t> row;  ///< of the table, of the least CPU time; absent: none
};

/// For each combination of swept values that has a reference with a known error.
std::vector<Recommendation> recommendations(const StudyTable& table);

/// Says that most runs with a tolerance are stopped by the measured times at about every step, so
/// that their errors are those of these times; empty where they are not.
std::string hidden_tolerances(const Study& study, const StudyTable& table);

/// `recommendations` and `remark`, for study.json.
void add_advice(nlohmann::ordered_json& json, const Study& study, const StudyTable& table);

}  // namespace gnomon::study
