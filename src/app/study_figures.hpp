// Figures for a page, made by the plotting script if this machine can run it.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::app {

struct StudyFigures {
  std::vector<std::string> svgs;  ///< texts of FOLDER/figures/*.svg, by name
  std::string note;               ///< why there are no figures, and how to get them
};

/// Makes the figures of a folder with the table KIND.csv: "study", "extremes". Missing figures are
/// not an error.
StudyFigures study_figures(const std::filesystem::path& folder, const std::string& kind);

}  // namespace gnomon::app
