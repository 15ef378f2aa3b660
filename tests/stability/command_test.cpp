// gnomon stability through the real program.

#include <gmock/gmock.h>

#include <sstream>

#include "app/child.hpp"

namespace gnomon::command_test {
namespace {

using test::Outcome;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

const std::string twelve = "mesh.elements=[12,12]";

class StabilityCommand : public test::ProgramTest {};

std::vector<std::vector<std::string>> rows(const std::string& csv) {
  std::vector<std::vector<std::string>> result;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    result.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) result.back().push_back(cell);
  }
  return result;
}

TEST_F(StabilityCommand, PrintsATableAndWritesTwo) {
  const Outcome outcome = gnomon({"stability", test::pin, "--set", twelve, "--time", "60", "--time",
                                  "0", "--all", "-o", "new/tables"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* part : {"largest eigenvalue", "forward-euler", "critical step", "onset"})
    EXPECT_THAT(outcome.out, HasSubstr(part));

  const auto spectrum = rows(test::read_text(folder() / "new/tables/spectrum.csv"));
  ASSERT_EQ(spectrum.size(), 1 + 2 * 24u);  // two components of eleven nodes, twice
  EXPECT_EQ(spectrum[0], (std::vector<std::string>{"time", "real", "imag"}));
  EXPECT_EQ(spectrum[1][0], "0");
  EXPECT_EQ(spectrum.back()[0], "60");

  const auto steps = rows(test::read_text(folder() / "new/tables/critical_steps.csv"));
  ASSERT_GE(steps.size(), 3u);
  EXPECT_EQ(steps[0], (std::vector<std::string>{"time", "method", "critical_step", "empirical"}));
  const auto& last = steps.back();
  ASSERT_EQ(last.size(), 4u);
  EXPECT_NEAR(std::stod(last[3]) / std::stod(last[2]), 1, 0.1);
}

// The largest eigenvalues without --all are those with it.
TEST_F(StabilityCommand, WritesTheLargestEigenvaluesUnlessAskedForAll) {
  for (const char* folder : {"few", "all"}) {
    std::vector<std::string> arguments = {"stability", test::pin, "--set", "mesh.elements=[16,16]",
                                          "--time",    "0",       "-o",    folder};
    if (std::string(folder) == "all") arguments.push_back("--all");
    ASSERT_EQ(gnomon(arguments).exit_code, 0);
  }
  const auto few = rows(test::read_text(folder() / "few/spectrum.csv"));
  const auto all = rows(test::read_text(folder() / "all/spectrum.csv"));
  ASSERT_GE(few.size(), 5u);
  ASSERT_GT(all.size(), few.size());
  const double largest = std::stod(all[1][1]);
  ASSERT_LT(largest, -1e-3);
  for (int k : {1, 2})
    EXPECT_NEAR(std::stod(few[k][1]) / largest, std::stod(all[k][1]) / largest, 1e-7);
}

TEST_F(StabilityCommand, ShowsTheMethodsThatAreNamed) {
  const Outcome outcome = gnomon({"stability", test::pin, "--set", twelve, "--time", "0",
                                  "--integrator", "erk-3", "-o", "one"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto steps = rows(test::read_text(folder() / "one/critical_steps.csv"));
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_EQ(steps[1][1], "erk-3");
}

// A looser run reaches another worn surface; the step hardly depends on that.
TEST_F(StabilityCommand, ComputesStatesAtTheChosenTolerance) {
  double step[2];
  std::string spectrum[2];
  for (int k : {0, 1}) {
    const std::string rtol = k ? "1e-2" : "1e-5", to = "rtol" + rtol;
    const Outcome outcome =
        gnomon({"stability", test::pin, "--set", twelve, "--time", "100", "--integrator",
                "forward-euler", "--no-onset", "--rtol", rtol, "-o", to});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    step[k] = std::stod(rows(test::read_text(folder() / to / "critical_steps.csv")).at(1).at(2));
    spectrum[k] = test::read_text(folder() / to / "spectrum.csv");
  }
  EXPECT_NE(spectrum[0], spectrum[1]);
  EXPECT_NEAR(step[1], step[0], 0.01 * step[0]);
}

TEST_F(StabilityCommand, LeavesOutTheOnset) {
  const Outcome outcome = gnomon({"stability", test::pin, "--set", twelve, "--time", "0",
                                  "--integrator", "erk-3", "--no-onset", "-o", "linear"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto steps = rows(test::read_text(folder() / "linear/critical_steps.csv"));
  ASSERT_EQ(steps.size(), 2u);
  EXPECT_GT(std::stod(steps[1][2]), 0);
  EXPECT_EQ(steps[1].size(), 3u) << "an onset after the last comma";
}

TEST_F(StabilityCommand, RefusesWhatItCannotDo) {
  for (const char* method : {"bdf", "esdirk-3"})
    EXPECT_THAT(gnomon({"stability", test::pin, "--integrator", method}).err,
                StartsWith("gnomon: --integrator: expected an explicit method"));
  for (const char* rtol : {"0", "1"})
    EXPECT_THAT(gnomon({"stability", test::pin, "--rtol", rtol}).err,
                StartsWith("gnomon: --rtol: expected a number"));
  for (const char* time : {"-1", "1001"}) {
    const Outcome outcome = gnomon({"stability", test::pin, "--time", time});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, StartsWith("gnomon: --time: expected 0 to time.end = 1000 s"));
  }
  write("file", "");
  const Outcome outcome = gnomon({"stability", test::pin, "-o", "file"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("cannot make the folder file"));
  EXPECT_THAT(outcome.out, IsEmpty());
}

}  // namespace
}  // namespace gnomon::command_test
