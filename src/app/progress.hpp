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

/// A line on a terminal while something takes long, which is gone when that ends. What shows it may
/// print plain lines elsewhere. Failures are ignored: a run does not end because nobody can read
/// its progress.
class LiveLine {
public:
  /// `text` empty: nothing is shown yet.
  explicit LiveLine(const std::string& text, bool quiet = false);
  ~LiveLine() { clear(); }
  LiveLine(const LiveLine&) = delete;
  LiveLine& operator=(const LiveLine&) = delete;

  enum class Mode { live, lines, none };
  /// live on a terminal, lines elsewhere; none when quiet.
  Mode mode() const { return mode_; }
  /// In the place of what is shown; nothing elsewhere than on a terminal.
  void show(const std::string& text) const;
  /// So that further output begins on a new line.
  void clear() const { show(""); }
  /// Prints a line that is not overwritten.
  static void print(const std::string& line);
  /// Nothing when quiet.
  void warn(const std::string& text) const;

private:
  Mode mode_;
};

/// What it says while a mesh is read or made, and the equations on it.
inline constexpr const char* making_the_model = "making the model";

/// Of a run.
class Progress {
public:
  /// `end`: time at which the run ends.
  Progress(bool quiet, double end)
      : line_("computing the equilibrium at t = 0", quiet), end_(end) {}

  void show(const HistoryRow& row);
  void warn(const std::string& text) const;
  /// What is done after the last step, on a terminal.
  void say(const std::string& text) const { line_.show(text); }

private:
  using Clock = std::chrono::steady_clock;
  bool due(const HistoryRow& row, Clock::time_point now) const;

  LiveLine line_;
  double end_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point shown_at_{};
  double shown_t_ = 0;
  bool shown_ = false;
};

/// Of studies: "[#####.....] 12 of 40 runs  2 failed  left 3:20".
class StudyProgressBar {
public:
  explicit StudyProgressBar(bool quiet) : line_("", quiet) {}
  void show(const StudyProgress& progress) const;
  void warn(const std::string& text) const;
  /// Shows the progress of one study, until it ends or the user ends it.
  StudyHooks hooks() const;

private:
  LiveLine line_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

}  // namespace gnomon::app
