// The results of a study: files, page, and the table on the terminal.
#pragma once

#include <filesystem>
#include <gnomon/study/study.hpp>

namespace gnomon::app {

/// Measures the runs, writes study.csv, study.json, study.h5 and the page, and prints the table.
/// Throws SolutionError when no run has finished.
void write_study(const Study& study, const std::filesystem::path& folder, bool quiet);

}  // namespace gnomon::app
