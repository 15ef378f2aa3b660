// Studies by Slurm: its programs are replaced by those in fake_slurm, which lose tasks and do some
// twice. scripts/slurm-check does the same with the real Slurm.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "study/study_fixture.hpp"

namespace gnomon::slurm_test {
namespace {

using test::Outcome;
using test::Row;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

class BySlurm : public test::StudyTest {
protected:
  BySlurm() {
    state_ = folder() / "slurm";
    std::filesystem::create_directory(state_);
    setenv("FAKE_SLURM", state_.c_str(), 1);
    setenv("PATH", (GNOMON_SOURCE_DIR "/tests/study/fake_slurm:" + path_).c_str(), 1);
    write("scene.toml", test::read_text(GNOMON_SOURCE_DIR "/problems/dahlquist/decay.toml"));
    write("study.toml",
          "scene = \"scene.toml\"\nreference = \"none\"\n[[sweep]]\nkey = \"dahlquist.rate_real\"\n"
          "values = [-1.0, -2.0, -3.0, -4.0, -5.0, -6.0]\n" +
              method("backward-euler", "steps = [0.1, 0.01]"));
  }
  ~BySlurm() override { setenv("PATH", path_.c_str(), 1); }

  static std::vector<std::string> arguments(const std::vector<std::string>& further = {}) {
    std::vector<std::string> all = {"study",   "study.toml",   "-o",    "out",
                                    "--quiet", "--executor",   "slurm", "--poll",
                                    "0.1",     "--lost-after", "3"};
    all.insert(all.end(), further.begin(), further.end());
    return all;
  }

  std::vector<std::string> calls() const {
    std::istringstream text(test::read_text(state_ / "calls"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
  }

  /// The tables of this study and of a local one, without costs, are the same.
  void expect_table_of_local_runs() {
    ASSERT_EQ(gnomon({"study", "study.toml", "-o", "local", "--quiet"}).exit_code, 0);
    const auto local = test::parse_csv(test::read_text(folder() / "local/study.csv"));
    const auto rows = this->rows();
    ASSERT_EQ(rows.size(), local.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      for (const auto& [name, value] : local[i])
        if (name != "wall_seconds" && name != "cpu_seconds" && name != "peak_memory_mb") {
          EXPECT_EQ(rows[i].at(name), value) << name << " of run " << i;
        }
  }

  std::filesystem::path state_;

private:
  const std::string path_ = std::getenv("PATH");
};

TEST_F(BySlurm, LostTasksAreSubmittedAgainAndDoubleOnesDoNothing) {
  const Outcome outcome = gnomon(arguments({"--jobs", "4"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(calls(), testing::ElementsAre("1-12%4 0", "3,6,9,12%4 0"));
  ASSERT_NO_FATAL_FAILURE(expect_table_of_local_runs());
  for (const Row& row : rows()) EXPECT_EQ(row.at("status"), "finished");
  EXPECT_TRUE(std::filesystem::is_empty(folder() / "out/tries"));
}

TEST_F(BySlurm, AKilledExecutorIsContinuedWithTheJobsItHas) {
  const pid_t executor = start(arguments());
  for (int i = 0; i < 3000 && !std::filesystem::exists(folder() / "out/slurm/jobs"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(executor, SIGKILL);
  finish(executor);
  const Outcome outcome = gnomon(arguments({"--resume"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(calls(), testing::ElementsAre("1-12 0", "3,6,9,12 0"));
  expect_table_of_local_runs();
}

TEST_F(BySlurm, RunsThatNeverBeganAreMissingAndHaveNotFailed) {
  const Outcome outcome = gnomon(arguments({"--slurm-option=--partition=closed"}));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.err, "gnomon: 12 runs of 12 missing; gnomon study run out 1-12 does them\n");
  EXPECT_THAT(calls(), SizeIs(3)) << "three jobs in turn that bring a run no further";
}

TEST_F(BySlurm, ARefusalOfSbatchIsToldInItsWords) {
  const Outcome outcome = gnomon(arguments({"--slurm-option=--partition=none"}));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(outcome.err,
            "gnomon: sbatch refuses the study: sbatch: error: invalid partition specified: none\n");
  EXPECT_THAT(calls(), IsEmpty());
}

TEST_F(BySlurm, AFailingQueryIsToldAndRepeatedAndSubmitsNothing) {
  write("slurm/deaf", "1\n2\n3\n");
  std::vector<std::string> words = arguments();
  std::erase(words, "--quiet");
  const Outcome outcome = gnomon(words);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::string warning =
      "gnomon: warning: squeue has failed and is asked again: slurm_load_jobs error: Unable to "
      "contact slurm controller\n";
  EXPECT_THAT(outcome.err, HasSubstr(warning));
  EXPECT_EQ(outcome.err.find(warning), outcome.err.rfind(warning)) << "once";
  EXPECT_THAT(outcome.err,
              HasSubstr("gnomon: warning: runs that are not done and have no job in the "
                        "queue are submitted again: 4\n"));
  EXPECT_THAT(calls(), SizeIs(2));
}

TEST_F(BySlurm, AJobWhoseNumberIsUnknownIsNotSubmittedAgain) {
  const Outcome outcome = gnomon(arguments({"--slurm-option=--partition=mute"}));
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(
      outcome.err,
      "gnomon: sbatch --parsable has printed no number of a job, but `Submitted batch job 1`; "
      "its job, if there is one, is not waited for\n");
  EXPECT_THAT(calls(), SizeIs(1));
}

}  // namespace
}  // namespace gnomon::slurm_test
