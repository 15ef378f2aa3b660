// Studies in parts: planned, run by several processes, collected.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <gnomon/base/error.hpp>
#include <thread>

#include "study/run_files.hpp"
#include "study/study_fixture.hpp"

namespace gnomon::plan_test {
namespace {

using test::Outcome;
using test::Row;
using ::testing::HasSubstr;
using ::testing::SizeIs;

namespace fs = std::filesystem;

class Parts : public test::StudyTest {
protected:
  /// A sweep of the pin without references, with one run for each step. It makes no checkpoints by
  /// the clock, unless `set` gives their time.
  void write_study(const std::string& steps,
                   const std::string& set = "output.checkpoint_seconds = 0.0\n") const {
    write("study.toml", "reference = \"none\"\n" + head() + set +
                            method("backward-euler", "steps = [" + steps + "]"));
  }

  Outcome plan(const std::vector<std::string>& further = {}) const {
    std::vector<std::string> arguments = {"study", "plan", "study.toml", "-o", "out"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return gnomon(arguments);
  }

  static std::vector<std::string> run(const std::string& numbers,
                                      const std::string& lost_after = "120") {
    return {"study", "run", "out", numbers, "--lost-after", lost_after};
  }

  /// Waits until a process does the first run, which takes a while.
  fs::path begun(const std::string& name) const {
    const fs::path attempt = folder() / "out/tries" / name / "1";
    for (int i = 0; i < 6000 && !fs::exists(attempt / (name + ".h5")); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return attempt;
  }
};

const std::string slow = "backward-euler__step-0.02";  // takes seconds

TEST_F(Parts, GiveTheTableOfTheWhole) {
  write_study("50, 25, 20");
  const Outcome planned = plan();
  ASSERT_EQ(planned.exit_code, 0) << planned.err;
  EXPECT_THAT(test::read_text(folder() / "out/plan.csv"),
              HasSubstr("number,run\n1,backward-euler__step-50\n2,"));
  EXPECT_EQ(gnomon(run("1,3")).exit_code, 0);
  const Outcome partly = gnomon({"study", "collect", "out"});
  EXPECT_EQ(partly.exit_code, 1);
  EXPECT_EQ(partly.err, "gnomon: 1 run of 3 missing; gnomon study run out 2 does it\n");
  EXPECT_EQ(rows()[1].at("status"), "missing");
  EXPECT_EQ(rows()[2].at("status"), "finished");
  fs::remove(folder() / "study.toml");  // the folder has all that is needed
  EXPECT_EQ(gnomon(run("1-3")).exit_code, 0);
  EXPECT_EQ(gnomon({"study", "collect", "out"}).exit_code, 0);
  const auto parts = rows();

  write_study("50, 25, 20");
  ASSERT_EQ(gnomon({"study", "study.toml", "-o", "whole", "--quiet"}).exit_code, 0);
  const auto whole = test::parse_csv(test::read_text(folder() / "whole/study.csv"));
  ASSERT_EQ(parts.size(), whole.size());
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (const char* name : {"run", "status", "steps", "worn_volume", "max_pressure"})
      EXPECT_EQ(parts[i].at(name), whole[i].at(name)) << name;
}

TEST_F(Parts, ARunThatAnotherProcessDoesIsLeftToIt) {
  write_study("0.02");
  ASSERT_EQ(plan().exit_code, 0);
  const pid_t first = start(run("1", "1"));
  begun(slow);
  const Outcome second = gnomon(run("1", "1"));
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_THAT(second.out, HasSubstr("1 run left to other processes"));
  EXPECT_EQ(finish(first).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder() / "out/tries" / slow));
  EXPECT_EQ(gnomon({"study", "collect", "out"}).exit_code, 0);
}

// The stopped process still exists, but gives no sign.
TEST_F(Parts, ALostRunIsDoneByAnotherProcess) {
  write_study("0.02");
  ASSERT_EQ(plan().exit_code, 0);
  const pid_t first = start(run("1", "1"));
  begun(slow);
  kill(first, SIGSTOP);
  const Outcome second = gnomon(run("1", "1"));
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_THAT(second.out, Not(HasSubstr("left to other")));
  const fs::path result = folder() / "out/runs" / (slow + ".h5");
  ASSERT_TRUE(fs::exists(result)) << second.out << second.err;
  const auto written = fs::last_write_time(result);
  kill(first, SIGCONT);
  EXPECT_EQ(finish(first).exit_code, 0);
  EXPECT_EQ(fs::last_write_time(result), written);  // not twice
}

TEST_F(Parts, AnInterruptedRunGoesOnWhereItWas) {
  write_study("0.02");
  ASSERT_EQ(plan().exit_code, 0);
  const pid_t first = start(run("1"));
  const fs::path attempt = begun(slow);
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  kill(first, SIGTERM);
  EXPECT_EQ(finish(first).exit_code, 1);
  const long rows_before = long(ResultReader(attempt / (slow + ".h5")).history().size());
  EXPECT_GT(rows_before, 1);
  EXPECT_EQ(gnomon(run("1")).exit_code, 0);
  const ResultReader result(folder() / "out/runs" / (slow + ".h5"));
  EXPECT_EQ(result.status(), "finished");
  EXPECT_EQ(result.history().size(), 5001u);
  // Besides those by the clock, a run makes checkpoints where it is interrupted and at its end.
  ASSERT_THAT(result.checkpoints(), SizeIs(2));
  EXPECT_EQ(result.checkpoints().front().rows, rows_before);
}

/// Waits until a run has made so many steps.
void wait_for_rows(const fs::path& result, std::size_t rows) {
  const auto enough = [&] {
    try {
      return ResultReader(result).history().size() >= rows;
    } catch (const InputError&) {
      return false;
    }
  };
  for (int i = 0; i < 3000 && !enough(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

// As when a time slot ends before the step, or a machine is lost: nothing is written at the end.
TEST_F(Parts, AKilledRunGoesOnFromItsLastCheckpoint) {
  write("study.toml", "reference = \"none\"\n" + head() +
                          "output.checkpoint_seconds = 0.01\nintegrator.max_step = 0.02\n" +
                          method("bdf", "tolerances = [1e-3]"));
  ASSERT_EQ(plan().exit_code, 0);
  const std::string name = "bdf__rtol-0.001";
  const pid_t first = start(run("1"));
  const fs::path attempt = begun(name);
  wait_for_rows(attempt / (name + ".h5"), 300);
  kill(first, SIGKILL);
  EXPECT_EQ(finish(first).exit_code, -SIGKILL);
  const auto checkpoints = ResultReader(attempt / (name + ".h5")).checkpoints();
  ASSERT_THAT(checkpoints, testing::Not(testing::IsEmpty()));
  const auto rows = static_cast<std::size_t>(checkpoints.back().rows);
  ASSERT_GT(rows, 200u);

  const Outcome second = gnomon(run("1"));
  EXPECT_EQ(second.exit_code, 0) << second.err;
  const ResultReader result(folder() / "out/runs" / (name + ".h5"));
  EXPECT_EQ(result.status(), "finished");
  // bdf begins at order one where it goes on.
  const std::vector<HistoryRow> history = result.history();
  ASSERT_GT(history.size(), rows);
  EXPECT_EQ(history[rows].step.order, 1);
  EXPECT_GT(history[rows - 1].step.order, 1);
  EXPECT_FALSE(fs::exists(folder() / "out/tries" / name));
}

TEST_F(Parts, BadInputIsOneLine) {
  write_study("50");
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& reason) {
    const Outcome outcome = gnomon(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr(reason));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  };
  refused({"study"}, "expected a study file, or plan, run or collect");
  refused({"study", "plan"}, "STUDY is required");
  refused({"study", "collect", "none"}, "none: expected the folder of a study");
  ASSERT_EQ(plan().exit_code, 0);
  refused({"study", "plan", "study.toml", "-o", "out"}, "exists already");
  refused(run("2"), "runs `2`: expected numbers from 1 to 1");
  refused(run("1-"), "got ``");
  refused({"study", "study.toml", "--executor", "pbs"}, "--executor");
  write("out/plan.json", "{");
  refused({"study", "collect", "out"}, "plan.json: is damaged");
}

TEST_F(Parts, AStudyFileMayBeCalledPlan) {
  write_study("50");
  fs::rename(folder() / "study.toml", folder() / "plan");
  EXPECT_EQ(gnomon({"study", "./plan", "-o", "out", "--quiet"}).exit_code, 0);
  EXPECT_THAT(rows(), SizeIs(1));
}

TEST(RunNumbers, AreReadAndWritten) {
  using study::numbers_of;
  using study::runs_numbered;
  EXPECT_EQ(runs_numbered("3", 12), (std::vector<std::size_t>{2}));
  EXPECT_EQ(runs_numbered("9-10,3,5,3", 12), (std::vector<std::size_t>{2, 4, 8, 9}));
  EXPECT_EQ(numbers_of({8, 2, 4, 9, 10}), "3,5,9-11");
  for (const char* bad :
       {"", "0", "13", "a", "2-", "-2", "1,,2", "1-13", "1 2", "99999999999999999999"})
    EXPECT_THROW(runs_numbered(bad, 12), InputError) << bad;
}

TEST_F(Parts, RunsFromALargerToASmallerNumberAreRefused) {
  write_study("50, 25");
  ASSERT_EQ(plan().exit_code, 0);
  const Outcome outcome = gnomon(run("2-1"));
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(
      outcome.err,
      "gnomon: runs `2-1`: expected ranges from a smaller number to a larger one, as 3-7, got "
      "`2-1`\n");
}

/// Runs lie in folders of their own; tables of files come with them, here also the files of values
/// that are swept.
TEST_F(Parts, RunsKeepTheTablesOfFiles) {
  write("force.csv", "0, 1\n0.5, 3\n1, 1\n");
  write("other.csv", "0, 2\n1, 2\n");
  write("cycle.toml", R"toml(problem = "winkler"
pin = { radius = 5.0, width = 2.0 }
foundation = { modulus = 70.0, points = 21 }
cycle = { period = 1.0, phases = 4, x = "0.05 * sin(2*pi*tau)", force = "force.csv" }
wear.coefficient = 2e-6
time.cycles = 1000
integrator.name = "esdirk-3"
)toml");
  write("study.toml",
        "scene = \"cycle.toml\"\nreference = \"none\"\n[[sweep]]\nkey = "
        "\"cycle.force\"\nvalues = [\"force.csv\", \"other.csv\"]\n");
  const Outcome done = study();
  EXPECT_EQ(done.exit_code, 0) << done.err;
  ASSERT_EQ(rows().size(), 2u);
  // k N times the mean of |v| F: both forces have the mean of 2 N/mm on this path.
  for (Row& row : rows()) {
    EXPECT_EQ(row["status"], "finished");
    EXPECT_NEAR(std::stod(row["worn_volume"]) / (2e-6 * 1000 * 0.2 * 2), 1, 0.2);
  }
  write("study.toml",
        "scene = \"cycle.toml\"\nreference = \"none\"\n[[sweep]]\nkey = "
        "\"cycle.force\"\nvalues = [\"force.csv\", \"lost.csv\"]\n");
  const Outcome lost = gnomon({"study", "plan", "study.toml", "-o", "lost"});
  EXPECT_EQ(lost.exit_code, 2);
  EXPECT_THAT(lost.err, HasSubstr("lost.csv: expected a file of points, there is none"));
  EXPECT_FALSE(fs::exists(folder() / "lost"));
}

/// Of a plan of which only failed runs are done the others are missing, and it is told.
TEST_F(Parts, CollectTellsWhatIsMissingBesideWhatFailed) {
  write("study.toml",
        "scene = \"scene.toml\"\nreference = \"none\"\n[set]\nmesh.elements = [8, 8]\n"
        "time.end = 10.0\n[[sweep]]\nkey = \"load.force\"\nvalues = [1e9, "
        "10.0]\n");
  ASSERT_EQ(gnomon({"study", "plan", "study.toml", "-o", "out"}).exit_code, 0);
  const Outcome failed = gnomon({"study", "run", "out", "1"});
  EXPECT_EQ(failed.exit_code, 0) << failed.err;
  EXPECT_THAT(failed.out, HasSubstr("1 run failed"));
  const Outcome partly = gnomon({"study", "collect", "out"});
  EXPECT_EQ(partly.exit_code, 1);
  EXPECT_THAT(partly.err, HasSubstr("1 run of 2 missing"));
  ASSERT_EQ(gnomon({"study", "run", "out", "2"}).exit_code, 0);
  const Outcome one = gnomon({"study", "collect", "out"});  // of which no curve can be drawn
  EXPECT_EQ(one.exit_code, 0) << one.err;
  EXPECT_THAT(one.out, HasSubstr("the runs that finished do not differ in a number"));
}

}  // namespace
}  // namespace gnomon::plan_test
