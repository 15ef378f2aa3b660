// The format of the progress of a run and of tables on the terminal.

#include "app/progress.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

#include "app/text_table.hpp"

namespace gnomon::app {
namespace {

TEST(ProgressText, TellsTimeStepNewtonContactAndWhatIsLeft) {
  HistoryRow row;
  row.t = 250;
  row.step = {5, 2, 3, false};
  row.counters.steps = 50;
  row.scalars = {{"contact_nodes", "", 13}, {"worn_volume", "mm^2", 0.5}, {"other", "", 1}};
  EXPECT_EQ(progress_text(row, 1000, 10),
            "t 250 of 1000 s  left 0:30  step 5 s  order 2  Newton 3  contact 13  worn 0.5 mm^2");
}

// A cut number is another number: "worn 1." of 1.99.
TEST(ProgressText, LeavesOutWholeItemsOnANarrowTerminal) {
  HistoryRow row;
  row.t = 987.65;
  row.step = {12.345, 5, 13, false};
  row.counters.steps = 1;
  row.scalars = {{"contact_nodes", "", 12345}, {"worn_volume", "mm^2", 1.99}};
  const auto at = [&](std::size_t width) { return progress_text(row, 1000, 1e4, width); };
  const std::string whole = at(200);
  EXPECT_EQ(whole,
            "t 987.65 of 1000 s  left 2:05  step 12.3 s  order 5  Newton 13  contact 12345  worn "
            "1.99 mm^2");
  EXPECT_EQ(at(79), "t 987.65 of 1000 s  left 2:05  step 12.3 s  contact 12345  worn 1.99 mm^2");
  EXPECT_EQ(at(60), "t 987.65 of 1000 s  left 2:05  step 12.3 s  worn 1.99 mm^2");
  EXPECT_EQ(at(40), "t 987.65 of 1000 s  worn 1.99 mm^2");
  for (std::size_t width = 20; width <= whole.size(); ++width) {
    EXPECT_LE(at(width).size(), width);
    if (at(width).find("worn") != std::string::npos) {
      EXPECT_NE(at(width).find("worn 1.99 mm^2"), std::string::npos);
    }
  }
}

TEST(ProgressText, StartHasNoStepYet) {
  EXPECT_EQ(progress_text({}, 1000, 10), "t 0 of 1000 s");
}

/// A container may have none.
bool has_terminals() {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  const bool works = terminal >= 0 && grantpt(terminal) + unlockpt(terminal) == 0;
  if (terminal >= 0) close(terminal);
  return works;
}

/// What a terminal gets on stderr while `show` runs.
template <class Show>
std::string on_a_terminal(const Show& show) {
  const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
  grantpt(terminal), unlockpt(terminal);
  const int end = open(ptsname(terminal), O_RDWR | O_NOCTTY);
  const int earlier = dup(STDERR_FILENO);
  dup2(end, STDERR_FILENO);
  show();
  dup2(earlier, STDERR_FILENO);
  close(earlier);
  close(end);  // so that reading ends with an error; what was written may arrive in pieces
  std::string text;
  char piece[100];
  for (ssize_t count; (count = read(terminal, piece, sizeof piece)) > 0;) text.append(piece, count);
  close(terminal);
  return text;
}

TEST(LiveLine, IsOnATerminalAloneAndGoneAtTheEnd) {
  if (!has_terminals()) GTEST_SKIP() << "no pseudo-terminals here";
  EXPECT_EQ(on_a_terminal([] { const LiveLine line("making"); }), "\rmaking\x1b[K\r\x1b[K");
  EXPECT_EQ(on_a_terminal([] { const LiveLine line("making", true); }), "");
  testing::internal::CaptureStderr();  // a file
  { const LiveLine line("making"); }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ClockText, CountsUpToHours) {
  EXPECT_EQ(clock_text(0.4), "0:00");
  EXPECT_EQ(clock_text(42), "0:42");
  EXPECT_EQ(clock_text(725), "12:05");
  EXPECT_EQ(clock_text(10810), "3:00:10");
  EXPECT_EQ(clock_text(-5), "0:00");
}

TEST(TextTable, AlignsColumns) {
  TextTable table("lr", {"name", "size"});
  table.add({"a", "1"});
  table.add({"longer", "12345"});
  EXPECT_EQ(table.text(), "name     size\na           1\nlonger  12345\n");
}

}  // namespace
}  // namespace gnomon::app
