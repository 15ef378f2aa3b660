// Shows the progress of a run, or of a study: one live line on a terminal, a few plain lines
// elsewhere.
#pragma once

#include <chrono>
#include <gnomon/results/results.hpp>
#include <gnomon/study/study.hpp>
#include <string>

namespace gnomon::app {

/// "t 250 of 1000 s  left 0:42  step 5 s  order 1  Newton 3  contact 13  worn 0.5 mm^2": time,
/// remaining wall time, last step with its order and iterations, nodes in contact, worn volume.
/// `elapsed` is in seconds. Of what does not fit into `width` whole items are left out, the least
/// important first.
std::string progress_text(const HistoryRow& row, double end, double elapsed,
                          std::size_t width = std::string::npos);

/// "0:42", "12:05", "3:00:10".
std::string clock_text(double seconds);

/// A line on a terminal while something takes long, which is gone when that ends; nothing
/// elsewhere.
class LiveLine {
public:
  explicit LiveLine(const std::string& text, bool quiet = false);
  ~LiveLine();
  LiveLine(const LiveLine&) = delete;
  LiveLine& operator=(const LiveLine&) = delete;

private:
  bool shown_;
};

/// What it says while a mesh is read or made, and the equations on it.
inline constexpr const char* making_the_model = "making the model";

class Progress {
public:
  enum class Mode { live, lines, none };

  /// `end`: time at which the run ends.
  Progress(Mode mode, double end);
  /// live on a terminal, lines elsewhere; none when quiet.
  static Mode mode_for_stderr(bool quiet);

  void show(const HistoryRow& row);
  /// Prints a line that is not overwritten.
  void warn(const std::string& text);
  /// Ends the live line, so that further output begins on a new one.
  void finish();

private:
  using Clock = std::chrono::steady_clock;
  bool due(const HistoryRow& row, Clock::time_point now) const;

  Mode mode_;
  double end_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point shown_at_{};
  double shown_t_ = 0;
  bool shown_ = false;
};

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
