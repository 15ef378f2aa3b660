// Shows the progress of a study: one bar on a terminal, one line per run elsewhere.
#pragma once

#include <chrono>
#include <gnomon/study/study.hpp>
#include <string>

#include "app/progress.hpp"

namespace gnomon::app {

/// "[#####.....] 12 of 40 runs  2 failed  left 3:20". `elapsed` is in seconds.
std::string study_progress_text(const StudyProgress& progress, double elapsed);

class StudyProgressBar {
public:
  explicit StudyProgressBar(Progress::Mode mode) : mode_(mode) {}
  void show(const StudyProgress& progress);
  /// Ends the live line, so that further output begins on a new one.
  void finish();

private:
  Progress::Mode mode_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace gnomon::app
