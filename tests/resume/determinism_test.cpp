// The same build, scene and number of threads give the same bytes, except for `wall_seconds`;
// another number of threads gives them too, because no sum depends on it.

#include <gtest/gtest.h>

#include <cstdlib>

#include "app/child.hpp"
#include "resume/runs.hpp"

namespace gnomon::determinism_test {
namespace {

class Determinism : public test::ProgramTest {
protected:
  std::filesystem::path run(const std::string& name, const char* threads,
                            const std::vector<std::string>& scene) const {
    std::filesystem::create_directories(folder() / name);
    std::vector<std::string> arguments = {"run"};
    arguments.insert(arguments.end(), scene.begin(), scene.end());
    arguments.insert(arguments.end(), {"-o", name + "/r.h5", "--quiet"});
    setenv("OMP_NUM_THREADS", threads, 1);
    const test::Outcome outcome = gnomon(arguments);
    unsetenv("OMP_NUM_THREADS");
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return folder() / name / "r.h5";
  }

  const std::string problems_ = std::string(GNOMON_SOURCE_DIR) + "/problems/";
};

TEST_F(Determinism, EqualRunsGiveEqualBytes) {
  for (const char* integrator : {"bdf", "esdirk-3", "erk-3", "forward-euler"}) {
    SCOPED_TRACE(integrator);
    const std::vector<std::string> scene = {test::pin,  "--set",        "mesh.elements=[8,6]",
                                            "--set",    "time.end=100", "--integrator",
                                            integrator, "--set",        "integrator.rtol=1e-3"};
    const std::string name = integrator;
    test::expect_same(run(name + "-1", "1", scene), run(name + "-2", "1", scene));
  }
}

// Enough elements for assembly by several threads.
TEST_F(Determinism, TheNumberOfThreadsChangesNoByte) {
  const std::vector<std::string> flat = {test::pin,        "--set",       "mesh.elements=[70,60]",
                                         "--set",          "time.end=10", "--integrator",
                                         "backward-euler", "--set",       "integrator.step=10"};
  test::expect_same(run("one", "1", flat), run("three", "3", flat));
}

TEST_F(Determinism, NorDoesItInSpace) {
  const std::vector<std::string> ball = {problems_ + "ball_on_flat/small_deformation.toml",
                                         "--set",
                                         "mesh.elements=[8,3,4]",
                                         "--set",
                                         "time.end=10",
                                         "--integrator",
                                         "backward-euler",
                                         "--set",
                                         "integrator.step=10",
                                         "--set",
                                         "output.times=[]"};
  test::expect_same(run("one", "1", ball), run("three", "3", ball));
}

}  // namespace
}  // namespace gnomon::determinism_test
