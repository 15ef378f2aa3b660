// Figures for a page, made by the plotting script if this machine can run it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::app {

struct StudyFigures {
  std::vector<std::string> svgs;  ///< texts of FOLDER/figures/*.svg, by name
  std::string note;               ///< why there are none; what to do about it
};

/// Has them made of a folder with the table KIND.csv: "study", "extremes". Never throws for want of
/// figures.
StudyFigures study_figures(const std::filesystem::path& folder, const std::string& kind);

}  // namespace gnomon::app
