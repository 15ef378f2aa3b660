// The plan of a study in its folder, for processes that do its runs without the study file.
#pragma once

#include <filesystem>
#include <gnomon/study/study.hpp>

namespace gnomon::study {

/// Writes plan.json, the numbered list plan.csv, and the scene of every run.
void write_plan(const std::filesystem::path& folder, const Study& study);

/// The scene of a run as planned.
std::string planned_scene(const std::filesystem::path& folder, const std::string& run);

}  // namespace gnomon::study
