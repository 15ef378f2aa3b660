// Runs that are killed at random instants, also while writing and resuming, and then resumed: the
// result is that of the uninterrupted run.
// GNOMON_KILLS sets how many instants (default 10 per method).

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <random>
#include <thread>

#include "app/child.hpp"
#include "resume/runs.hpp"

namespace gnomon::kill_test {
namespace {

using Clock = std::chrono::steady_clock;
using ::testing::HasSubstr;

int kills() {
  const char* given = std::getenv("GNOMON_KILLS");
  return given ? std::atoi(given) : 10;
}

class Kill : public test::ProgramTest {
protected:
  /// The arguments of a run that writes much of the time.
  std::vector<std::string> run_into(const std::string& name, const std::string& integrator,
                                    const std::string& setting) const {
    std::filesystem::remove_all(folder() / name);
    std::filesystem::create_directories(folder() / name);
    return {"run",          test::pin,
            "--integrator", integrator,
            "--set",        setting,
            "--set",        "mesh.elements=[8,6]",
            "--set",        "time.end=200",
            "--set",        "output.every=1",
            "--set",        "integrator.nonlinear_fraction=0",
            "--set",        "output.checkpoint_seconds=1e-9",
            "-o",           name + "/r.h5",
            "--quiet",      "--force"};
  }

  /// Starts the program and kills it after a while, if it still runs then.
  void kill_after(const std::vector<std::string>& arguments, double seconds) const {
    const pid_t child = start(arguments);
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    kill(child, SIGKILL);
    const int code = finish(child).exit_code;
    EXPECT_TRUE(code == -SIGKILL || code == 0 || code == 2) << code;  // 2: nothing to resume yet
  }

  /// A run that is killed, resumed, in every second case killed again, and resumed to its end.
  void interrupted_run(const std::vector<std::string>& run, double seconds, int i) {
    const std::vector<std::string> resume = {"resume", "killed/r.h5", "--quiet"};
    std::uniform_real_distribution<double> instant(0, seconds);
    kill_after(run, instant(random_));
    if (i % 2 == 0) kill_after(resume, instant(random_));
    test::Outcome last = gnomon(resume);
    if (last.exit_code == 2) {  // there was nothing to resume yet
      EXPECT_THAT(last.err, HasSubstr("no such file"));
      ++from_start_;
      last = gnomon(run);
    }
    ASSERT_EQ(last.exit_code, 0) << last.err;
  }

  double time_of(const std::vector<std::string>& run) const {
    const auto begin = Clock::now();
    EXPECT_EQ(gnomon(run).exit_code, 0);
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }

  const unsigned seed_ = std::random_device()();
  std::mt19937 random_{seed_};
  int from_start_ = 0;
};

TEST_F(Kill, OneStepMethodsGoOnToRounding) {
  const char* methods[][2] = {{"backward-euler", "integrator.step=4"},
                              {"esdirk-3", "integrator.rtol=1e-4"}};
  for (const auto& [integrator, setting] : methods) {
    const double seconds = time_of(run_into("whole", integrator, setting));
    for (int i = 0; i < kills(); ++i) {
      SCOPED_TRACE(integrator + (", seed " + std::to_string(seed_)) + ", kill " +
                   std::to_string(i));
      interrupted_run(run_into("killed", integrator, setting), seconds, i);
      if (HasFatalFailure()) return;
      test::expect_same_steps(folder() / "killed/r.h5", folder() / "whole/r.h5");
    }
  }
  std::cout << from_start_ << " of " << 2 * kills() << " were killed before there was a result\n";
}

TEST_F(Kill, BdfGoesOnToItsTolerance) {
  const double seconds = time_of(run_into("whole", "bdf", "integrator.rtol=1e-5"));
  const auto expected = ResultReader(folder() / "whole/r.h5").contact(200.0).wear_depth;
  const double deepest = *std::max_element(expected.begin(), expected.end());
  for (int i = 0; i < kills(); ++i) {
    SCOPED_TRACE("seed " + std::to_string(seed_) + ", kill " + std::to_string(i));
    interrupted_run(run_into("killed", "bdf", "integrator.rtol=1e-5"), seconds, i);
    if (HasFatalFailure()) return;
    const auto depth = ResultReader(folder() / "killed/r.h5").contact(200.0).wear_depth;
    for (std::size_t c = 0; c < depth.size(); ++c)
      EXPECT_NEAR(depth[c], expected[c], 1e-3 * deepest) << c;
  }
}

}  // namespace
}  // namespace gnomon::kill_test
