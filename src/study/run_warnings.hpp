// What the runs of a study warn of.
#pragma once

#include <gnomon/study/study.hpp>
#include <string>
#include <vector>

namespace gnomon::study {

/// One warning, whose numbers may differ from run to run.
struct RunWarning {
  std::string text;      ///< of the first of the runs
  std::string run;       ///< its name
  std::size_t runs = 0;  ///< that have it
};

struct RunWarnings {
  std::vector<RunWarning> each;
  std::size_t runs = 0;  ///< with warnings
};

/// "1 run", "3 runs".
std::string count_of_runs(std::size_t count);

/// Of the runs of a table.
RunWarnings warnings_of(const Study& study, const StudyTable& table);

/// For a terminal: how many runs have warnings, and a line for each warning; empty if none has.
std::string warnings_text(const RunWarnings& warnings);

}  // namespace gnomon::study
