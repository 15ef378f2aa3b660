#include "app/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "app/interrupt.hpp"

namespace gnomon::app {

namespace {

std::size_t terminal_width() {
  winsize size{};
  if (ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

struct Item {
  int importance;  // the item with the least is left out first
  std::string text;
};

std::vector<Item> progress_items(const HistoryRow& row, double end, double elapsed) {
  std::vector<Item> items = {{9, fmt::format("t {:.5g} of {:g} s", row.t, end)}};
  if (row.t > 0) items.push_back({7, "left " + clock_text(elapsed * (end - row.t) / row.t)});
  if (row.counters.steps > 0) {
    items.push_back({6, fmt::format("step {:.3g} s", row.step.step)});
    items.push_back({3, fmt::format("order {}", row.step.order)});
    items.push_back({4, fmt::format("Newton {}", row.step.newton_iterations)});
  }
  if (const auto nodes = value_of(row.scalars, "contact_nodes"))
    items.push_back({5, fmt::format("contact {:g}", *nodes)});
  if (const Scalar* const worn = find_scalar(row.scalars, "worn_volume"))
    items.push_back({8, fmt::format("worn {:.3g} {}", worn->value, worn->unit)});
  return items;
}

std::string joined(const std::vector<Item>& items) {
  std::string text;
  for (const Item& item : items) text += (text.empty() ? "" : "  ") + item.text;
  return text;
}

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

std::string live_text(const StudyProgress& progress, double elapsed) {
  std::string text = fmt::format("{} {} of {} runs", bar(progress.done, progress.total),
                                 progress.done, progress.total);
  if (progress.failed) text += fmt::format("  {} failed", progress.failed);
  const std::size_t run = progress.done - progress.kept;
  if (run > 0 && progress.done < progress.total)
    text += "  left " + clock_text(elapsed * static_cast<double>(progress.total - progress.done) /
                                   static_cast<double>(run));
  return text;
}

}  // namespace

std::string clock_text(double seconds) {
  const long total = std::lround(std::clamp(seconds, 0.0, 1e9));
  const long hours = total / 3600, minutes = total / 60 % 60;
  return hours ? fmt::format("{}:{:02}:{:02}", hours, minutes, total % 60)
               : fmt::format("{}:{:02}", minutes, total % 60);
}

std::string progress_text(const HistoryRow& row, double end, double elapsed, std::size_t width) {
  std::vector<Item> items = progress_items(row, end, elapsed);
  while (items.size() > 1 && joined(items).size() > width)
    items.erase(std::ranges::min_element(items, {}, &Item::importance));
  return joined(items).substr(0, width);
}

LiveLine::LiveLine(const std::string& text, bool quiet)
    : mode_(quiet                   ? Mode::none
            : isatty(STDERR_FILENO) ? Mode::live
                                    : Mode::lines) {
  if (!text.empty()) show(text);
}

void LiveLine::show(const std::string& text) const {
  if (mode_ != Mode::live) return;
  std::fputs(("\r" + text + "\x1b[K").c_str(), stderr);
  std::fflush(stderr);
}

void LiveLine::print(const std::string& line) {
  std::fputs((line + "\n").c_str(), stderr);
  std::fflush(stderr);
}

bool Progress::due(const HistoryRow& row, Clock::time_point now) const {
  if (!shown_ || row.t >= end_) return true;
  const double since = std::chrono::duration<double>(now - shown_at_).count();
  if (line_.mode() == LiveLine::Mode::live) return since >= 0.1;
  return since >= 10 || row.t - shown_t_ >= 0.05 * end_ * (1 - 1e-9);
}

void Progress::show(const HistoryRow& row) {
  const auto now = Clock::now();
  if (line_.mode() == LiveLine::Mode::none || !due(row, now)) return;
  const double elapsed = std::chrono::duration<double>(now - begin_).count();
  if (line_.mode() == LiveLine::Mode::live)  // a line that wraps could not be overwritten
    line_.show(progress_text(row, end_, elapsed, terminal_width() - 1));
  else
    LiveLine::print(progress_text(row, end_, elapsed));
  shown_ = true;
  shown_at_ = now;
  shown_t_ = row.t;
}

void LiveLine::warn(const std::string& text) const {
  if (mode() == Mode::none) return;
  clear();
  print("gnomon: warning: " + text);
}

void Progress::warn(const std::string& text) const {
  line_.warn(text);
}

void StudyProgressBar::warn(const std::string& text) const {
  line_.warn(text);
}

void StudyProgressBar::show(const StudyProgress& progress) const {
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin_;
  if (line_.mode() == LiveLine::Mode::live)
    line_.show(live_text(progress, elapsed.count()));
  else if (line_.mode() == LiveLine::Mode::lines)
    LiveLine::print(plain_line(progress));
}

StudyHooks StudyProgressBar::hooks() const {
  return {.on_progress = [this](const StudyProgress& progress) { show(progress); },
          .on_warning = [this](const std::string& text) { warn(text); },
          .interrupted = InterruptGuard::interrupted};
}

}  // namespace gnomon::app
