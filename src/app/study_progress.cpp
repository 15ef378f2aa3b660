#include "app/study_progress.hpp"

#include <fmt/format.h>

#include <cstdio>

namespace gnomon::app {

namespace {

std::string bar(std::size_t done, std::size_t total) {
  constexpr std::size_t width = 24;
  const std::size_t full = total ? width * done / total : width;
  return fmt::format("[{:#<{}}{:.<{}}]", "", full, "", width - full);
}

std::string plain_line(const StudyProgress& progress) {
  if (progress.ended.empty() && progress.done > progress.kept)
    return fmt::format("{} of {} done", progress.done, progress.total);
  if (progress.ended.empty())
    return fmt::format("{} runs, {} done already", progress.total, progress.kept);
  return fmt::format("{} of {}: {}{}", progress.done, progress.total, progress.ended,
                     progress.reason.empty() ? "" : " failed: " + progress.reason);
}

}  // namespace

std::string study_progress_text(const StudyProgress& progress, double elapsed) {
  std::string text = fmt::format("{} {} of {} runs", bar(progress.done, progress.total),
                                 progress.done, progress.total);
  if (progress.failed) text += fmt::format("  {} failed", progress.failed);
  const std::size_t run = progress.done - progress.kept;
  if (run > 0 && progress.done < progress.total)
    text += "  left " + clock_text(elapsed * static_cast<double>(progress.total - progress.done) /
                                   static_cast<double>(run));
  return text;
}

void StudyProgressBar::show(const StudyProgress& progress) {
  if (mode_ == Progress::Mode::none) return;
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
  if (mode_ == Progress::Mode::live)
    fmt::print(stderr, "\r{}\x1b[K", study_progress_text(progress, elapsed.count()));
  else
    fmt::print(stderr, "{}\n", plain_line(progress));
  std::fflush(stderr);
}

void StudyProgressBar::finish() {
  if (mode_ != Progress::Mode::live) return;
  fmt::print(stderr, "\r\x1b[K");
  std::fflush(stderr);
}

}  // namespace gnomon::app
