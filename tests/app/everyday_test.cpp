// What a user meets on the first days: starts that fail, files that are in the way or go away, a
// result in place of a scene, times and lists.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <gnomon/linear/inner_solver.hpp>
#include <gnomon/results/results.hpp>
#include <nlohmann/json.hpp>
#include <thread>

#include "app/child.hpp"

namespace gnomon::everyday_test {
namespace {

using test::coarse;
using test::Outcome;
using test::pin;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class Everyday : public test::ProgramTest {
protected:
  static long lines(const std::string& text) { return std::count(text.begin(), text.end(), '\n'); }
  Outcome run(const std::string& setting, const std::string& name = "a.h5") const {
    return gnomon({"run", pin, "--set", coarse, "--set", "time.end=100", "--set", setting, "-o",
                   name, "--quiet"});
  }
};

TEST_F(Everyday, AFailedStartLeavesNoFileAndTellsThatTheLoadIsTooLarge) {
  for (int attempt = 0; attempt < 2; ++attempt) {
    const Outcome outcome = gnomon({"run", pin, "--set", coarse, "--set", "body.young_modulus=0.5",
                                    "-o", "a.h5", "--summary", "s.json", "--quiet"});
    EXPECT_EQ(outcome.exit_code, 3);
    EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("more than this body carries"));
    EXPECT_THAT(outcome.err, HasSubstr("a.h5 is not written"));
    EXPECT_THAT(files(), ElementsAre("s.json"));
  }
}

// The table of a run does not repeat what its lines of forces say; history and summary have all.
TEST_F(Everyday, ForcesAndTorquesAreInLinesSummaryAndHistory) {
  const Outcome outcome = gnomon(
      {"run", pin, "--set", coarse, "--set", "time.end=100", "-o", "a.h5", "--summary", "s.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\nforces on the bodies: loads (0, -20), supports ("));
  EXPECT_THAT(outcome.out, HasSubstr("\ntorques about the origin: loads ("));
  EXPECT_THAT(outcome.out, Not(HasSubstr("torque_contact")));
  const auto json = nlohmann::json::parse(test::read_text(folder() / "s.json"));
  EXPECT_NEAR(json["forces"]["contact"][1].get<double>(), 20, 1e-2);
  const double torque = json["torques"]["loads"][2].get<double>();
  EXPECT_NEAR(json["torques"]["contact"][2].get<double>() + torque, 0, 1e-2 * 20);
  EXPECT_EQ(json["torque_loads_z"], torque);
  EXPECT_THAT(gnomon({"history", "a.h5"}).out, HasSubstr(",force_contact_y [N/mm],"));
}

TEST_F(Everyday, AFailedStartKeepsAnEarlierResult) {
  ASSERT_EQ(run("output.every=5").exit_code, 0);
  const std::string before = test::read_text(folder() / "a.h5");
  const Outcome outcome = gnomon({"run", pin, "--set", coarse, "--set", "body.young_modulus=0.5",
                                  "-o", "a.h5", "--force", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_TRUE(test::read_text(folder() / "a.h5") == before);
}

TEST_F(Everyday, AResultThatIsDeletedDuringTheRunEndsIt) {
  const pid_t child = start({"run", pin, "--set", coarse, "--set", "time.end=1e5", "--set",
                             "integrator.step=0.01", "-o", "a.h5", "--quiet"});
  const auto has_steps = [&] {
    try {
      return ResultReader(folder() / "a.h5").history().size() > 2;
    } catch (const InputError&) {
      return false;
    }
  };
  for (int i = 0; i < 1000 && !has_steps(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::filesystem::remove(folder() / "a.h5");
  const Outcome outcome = finish(child);
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_EQ(lines(outcome.err), 1) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("a.h5: somebody has deleted, moved or replaced it"));
  EXPECT_THAT(files(), IsEmpty());
}

TEST_F(Everyday, AResultInPlaceOfASceneIsToldWhatToDo) {
  ASSERT_EQ(run("output.every=5").exit_code, 0);
  for (const char* command : {"run", "check"}) {
    const Outcome outcome = gnomon({command, "a.h5"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(lines(outcome.err), 1);
    EXPECT_THAT(outcome.err, HasSubstr("a.h5: is a result, expected a scene (TOML)"));
    EXPECT_THAT(outcome.err, HasSubstr("gnomon resume a.h5"));
  }
  write("part.msh", "$MeshFormat\n");
  EXPECT_THAT(gnomon({"run", "part.msh"}).err, HasSubstr("gnomon new part.msh"));
}

TEST_F(Everyday, CheckTellsAllMistakesEachInALine) {
  write("scene.toml",
        "problem = \"pin_on_flat\"\n[body]\nE = 3\n[mesh]\nelements = [0, 8]\n[integrator]\n"
        "name = \"rk4\"\n[output]\ninterval = -1\n");
  const Outcome outcome = gnomon({"check", "scene.toml"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(outcome.err, HasSubstr("scene.toml:3: key `body.E`: unknown key, did you mean "
                                     "`body.young_modulus`?\n"));
  EXPECT_THAT(outcome.err, HasSubstr("scene.toml:5: key `mesh.elements`: "));
  EXPECT_THAT(outcome.err, HasSubstr("scene.toml:7: key `integrator.name`: "));
  EXPECT_THAT(outcome.err, HasSubstr("did you mean \"erk-4\"?"));
  EXPECT_THAT(outcome.err, HasSubstr("scene.toml:9: key `output.interval`: "));
  for (const char* missing : {"body.poisson_ratio", "load.force", "wear.coefficient", "time.end"})
    EXPECT_THAT(outcome.err, HasSubstr(std::string("key `") + missing + "`: missing"));
  EXPECT_THAT(outcome.err, Not(HasSubstr("`body.young_modulus`: missing")));
  EXPECT_THAT(gnomon({"run", "scene.toml"}).err, HasSubstr("key `time.end`: missing"));
}

TEST_F(Everyday, AnIntervalStoresAndAPrintedTimeIsFound) {
  const Outcome outcome = run("output.interval=30");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const std::vector<double> times = ResultReader(folder() / "a.h5").stored_times();
  for (double t : {0.0, 30.0, 60.0, 90.0, 100.0}) EXPECT_THAT(times, ::testing::Contains(t));
  EXPECT_EQ(gnomon({"contact", "a.h5", "--time", "30 s"}).exit_code, 0);
  EXPECT_EQ(gnomon({"contact", "a.h5", "--time", "30"}).out,
            gnomon({"contact", "a.h5", "--time", "30.0"}).out);
  const Outcome refused = gnomon({"contact", "a.h5", "--time", "31"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("next to it are t = "));
}

TEST_F(Everyday, TimesBehindAnEarlierEndAreDroppedWithAWord) {
  const Outcome outcome = gnomon({"run", pin, "--set", coarse, "--set", "time.end=100", "--set",
                                  "output.times=[50, 500, 1000]", "-o", "a.h5"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("2 of output.times, from 500 s on, lie after time.end"));
}

TEST_F(Everyday, KeysWithoutAnEffectAreNamed) {
  const std::vector<std::string> settings = {"--set", coarse,
                                             "--set", "time.end=10",
                                             "--set", "integrator.step=5",
                                             "--set", "integrator.rtol=1e-3"};
  const auto with_settings = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), settings.begin(), settings.end());
    return gnomon(arguments);
  };
  const std::string remark = "integrator.rtol has no effect: steps are fixed (integrator.step)\n";
  EXPECT_THAT(with_settings({"check", pin}).out, HasSubstr("\n# " + remark));
  const Outcome outcome = with_settings({"run", pin, "-o", "a.h5"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(remark));
  EXPECT_THAT(with_settings({"run", pin, "-o", "b.h5", "--quiet"}).err, IsEmpty());
}

// They would change the solver without a trace in the result.
TEST_F(Everyday, OptionsOfPetscAreNotRead) {
  if (!has_multigrid()) GTEST_SKIP() << "needs PETSc";
  const auto krylov_iterations = [&] {
    const Outcome outcome =
        gnomon({"run", GNOMON_SOURCE_DIR "/problems/ball_on_flat/small_deformation.toml", "--set",
                "mesh.elements=[4,1,2]", "--set", "time.end=1", "--set", "output.times=[]", "--set",
                "solver.preconditioner=multigrid", "--quiet", "--force", "-o", "a.h5"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return ResultReader(folder() / "a.h5").history().back().counters.krylov_iterations;
  };
  const long expected = krylov_iterations();
  EXPECT_GT(expected, 0);
  write(".petscrc", "-mg_levels_ksp_max_it 9\n");
  EXPECT_EQ(krylov_iterations(), expected);
  setenv("PETSC_OPTIONS", "-mg_levels_ksp_max_it 9", 1);
  EXPECT_EQ(krylov_iterations(), expected);
  unsetenv("PETSC_OPTIONS");
}

TEST_F(Everyday, InfoShortensLongListsAndTheSceneStaysWhole) {
  std::string times = "output.times=[";
  for (int k = 1; k <= 200; ++k) times += (k > 1 ? ", " : "") + std::to_string(k) + "0.0";
  ASSERT_EQ(run(times + "]").exit_code, 0);
  const std::string info = gnomon({"info", "a.h5"}).out;
  EXPECT_THAT(info, HasSubstr("times = [10.0, 20.0, ..., 2000.0]  # 200 in total"));
  for (std::size_t begin = 0, end = 0; (end = info.find('\n', begin)) != std::string::npos;
       begin = end + 1)
    EXPECT_LT(end - begin, 700u) << info.substr(begin, end - begin);
  EXPECT_THAT(gnomon({"scene", "a.h5"}).out, HasSubstr("1990.0, 2000.0]"));
}

TEST_F(Everyday, ListKnowsShapes) {
  EXPECT_THAT(gnomon({"list", "shapes"}).out, HasSubstr("torus"));
  EXPECT_THAT(gnomon({"list", "materials"}).out, HasSubstr("linear "));
}

TEST_F(Everyday, CompareTellsTheUnitOfTheShapeError) {
  ASSERT_EQ(run("output.every=5").exit_code, 0);
  EXPECT_THAT(gnomon({"compare", "a.h5"}).out, HasSubstr("shape error [mm]"));
}

}  // namespace
}  // namespace gnomon::everyday_test
