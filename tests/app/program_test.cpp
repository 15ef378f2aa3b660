// The real program as users see it: commands, files, signals, exit codes.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <gnomon/model/problem.hpp>
#include <gnomon/results/results.hpp>
#include <nlohmann/json.hpp>
#include <sstream>
#include <thread>

#include "app/child.hpp"

namespace gnomon::program_test {
namespace {

using test::coarse;
using test::Outcome;
using test::pin;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class Program : public test::ProgramTest {
protected:
  /// A short run of the coarse pin, with further arguments.
  Outcome run(std::vector<std::string> further) const {
    std::vector<std::string> arguments = {"run", pin, "--set", coarse, "--set", "time.end=100"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return gnomon(arguments);
  }
};

std::vector<std::string> lines_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

TEST_F(Program, RunWritesResultSidecarAndSummary) {
  const Outcome outcome = run({"--summary", "s.json", "--set", "integrator.step=5", "--set",
                               "integrator.nonlinear_fraction=0"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("finished at t = 100 s"));
  EXPECT_THAT(outcome.out, HasSubstr("small_deformation-backward-euler.h5"));
  EXPECT_THAT(files(), ElementsAre("s.json", "small_deformation-backward-euler.h5",
                                   "small_deformation-backward-euler.xdmf"));
  const auto json = nlohmann::json::parse(test::read_text(folder() / "s.json"));
  EXPECT_EQ(json["status"], "finished");
  EXPECT_EQ(json["integrator"], "backward-euler");
  EXPECT_EQ(json["problem"], "pin_on_flat");
  EXPECT_EQ(json["t"], 100.0);
  EXPECT_EQ(json["steps"], 20);
  EXPECT_NEAR(json["wear_integral"], 0.2, 0.2e-9);  // k v F t
  for (const char* key : {"worn_volume", "contact_half_width", "max_pressure", "contact_force"})
    EXPECT_GT(json[key].get<double>(), 0) << key;
  EXPECT_TRUE(json["versions"].contains("SUNDIALS"));
}

TEST_F(Program, RunAndInfoShowTheLedger) {
  const Outcome outcome = run({"-o", "a.h5", "--summary", "s.json"});
  ASSERT_THAT(outcome.out, ContainsRegex("\nworn volume 0\\.[0-9]+ mm\\^2, wear integral "
                                         "0\\.[0-9]+ mm\\^2, difference [-0-9.e]+ mm\\^2 \\("));
  const auto json = nlohmann::json::parse(test::read_text(folder() / "s.json"));
  EXPECT_EQ(json["wear_difference"].get<double>(),
            json["worn_volume"].get<double>() - json["wear_integral"].get<double>());
  const auto lines = lines_of(outcome.out);
  const auto ledger = std::ranges::find_if(
      lines, [](const std::string& line) { return line.starts_with("worn volume"); });
  EXPECT_THAT(lines_of(gnomon({"info", "a.h5"}).out), testing::Contains(*ledger));
}

TEST_F(Program, PipedProgressIsAFewPlainLines) {
  const Outcome outcome = run({"--set", "integrator.step=0.5"});
  const auto lines = lines_of(outcome.err);
  EXPECT_GE(lines.size(), 10u);
  EXPECT_LE(lines.size(), 25u);
  EXPECT_EQ(outcome.err.find('\r'), std::string::npos);
  EXPECT_EQ(outcome.err.find('\x1b'), std::string::npos);
}

TEST_F(Program, QuietPrintsNothing) {
  const Outcome outcome = run({"--quiet", "-o", "a.h5", "--integrator", "bdf"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(outcome.out + outcome.err, IsEmpty());
  EXPECT_THAT(files(), ElementsAre("a.h5", "a.xdmf"));
}

TEST_F(Program, CheckPrintsASceneAndWritesNothing) {
  const Outcome outcome = gnomon({"check", pin, "--set", coarse});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("elements = [8, 8]"));
  EXPECT_THAT(outcome.out, HasSubstr("displacement"));
  EXPECT_THAT(files(), IsEmpty());
  EXPECT_TRUE(parse_scene(outcome.out, "printed", {}, key_table) ==
              load_scene(pin, {coarse, "solver.preconditioner=factor"}, key_table));
}

TEST_F(Program, CheckSaysWhatTheSizeDecides) {
  const std::string groove =
      GNOMON_SOURCE_DIR "/problems/ball_on_half_space/small_deformation.toml";
  const auto check =
      [&](const std::string& solver) {  // for a mesh that fits into the memory of every machine
        return gnomon({"check", groove, "--set", "mesh.elements=[10, 20, 6]", "--set",
                       "mesh.size=[0.06, 0.06, 0.06]", "--set", "mesh.fine=[0, 0, 0]", "--set",
                       solver})
            .out;
      };
  EXPECT_THAT(check("solver.method=block"), HasSubstr("\npreconditioner = \"factor\""));
  EXPECT_THAT(check("solver.method=direct"), Not(HasSubstr("preconditioner = ")));
}

TEST_F(Program, ContactPrintsCsvInFullPrecision) {
  ASSERT_EQ(run({"--quiet", "-o", "a.h5", "--set", "output.times=[20]"}).exit_code, 0);
  const Outcome outcome = gnomon({"contact", "a.h5", "--time", "20"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 10u);
  EXPECT_EQ(lines[0],
            "node,X0 [mm],Y0 [mm],X [mm],Y [mm],x [mm],y [mm],pressure [MPa],wear_depth [mm],"
            "active");
  const ContactSurface surface = ResultReader(folder() / "a.h5").contact(20.0);
  std::vector<double> cells;
  std::istringstream middle(lines[5]);
  for (std::string cell; std::getline(middle, cell, ',');) cells.push_back(std::stod(cell));
  ASSERT_EQ(cells.size(), 10u);
  EXPECT_EQ(cells[4], surface.worn[4][1]);
  EXPECT_EQ(cells[7], surface.pressure[4]);
  EXPECT_EQ(cells[9], 1);
  EXPECT_GT(cells[8], 0);
}

TEST_F(Program, ContactNamesTheStoredTimesNextToAMissingOne) {
  ASSERT_EQ(run({"--quiet", "-o", "a.h5", "--set", "integrator.step=5"}).exit_code, 0);
  const Outcome outcome = gnomon({"contact", "a.h5", "--time", "70"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("50 and 100"));
}

TEST_F(Program, CompareGivesThePapersErrorAndThatOfPressuresAgainstTheReference) {
  ASSERT_EQ(run({"--quiet", "-o", "coarse.h5", "--set", "integrator.step=50"}).exit_code, 0);
  ASSERT_EQ(run({"--quiet", "-o", "tight.h5", "--integrator", "bdf"}).exit_code, 0);
  const Outcome outcome = gnomon({"compare", "coarse.h5", "--reference", "tight.h5"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("step 50 s"));

  const ContactSurface a = ResultReader(folder() / "coarse.h5").contact(std::nullopt);
  const ContactSurface b = ResultReader(folder() / "tight.h5").contact(std::nullopt);
  double sum = 0, pressure = 0;
  for (std::size_t i = 0; i < a.worn.size(); ++i) {
    for (std::size_t k = 0; k < 2; ++k) sum += std::pow(a.worn[i][k] - b.worn[i][k], 2);
    pressure = std::max(pressure, std::abs(a.pressure[i] - b.pressure[i]));
  }
  const auto text = [](double error) {
    char expected[32];
    std::snprintf(expected, sizeof expected, "  %.3e  ", error);
    return std::string(expected);
  };
  const auto errors = AllOf(HasSubstr(text(std::sqrt(sum))), HasSubstr(text(pressure)));
  EXPECT_THAT(outcome.out, errors);

  const Outcome both = gnomon({"compare", "coarse.h5", "tight.h5"});
  EXPECT_THAT(both.out, HasSubstr("rtol 0.0001"));
  EXPECT_THAT(both.out, errors);
  EXPECT_THAT(both.out, testing::ContainsRegex("reference +-  tight.h5"));
}

TEST_F(Program, CompareNamesTheKeysThatDiffer) {
  ASSERT_EQ(run({"--quiet", "-o", "a.h5", "--set", "integrator.step=50"}).exit_code, 0);
  ASSERT_EQ(run({"--quiet", "-o", "b.h5", "--set", "output.every=5"}).exit_code, 0);
  ASSERT_EQ(run({"--quiet", "-o", "c.h5", "--set", "load.force=10"}).exit_code, 0);
  EXPECT_EQ(gnomon({"compare", "a.h5", "b.h5"}).out.find("note:"), std::string::npos);
  EXPECT_THAT(gnomon({"compare", "a.h5", "b.h5", "--reference", "c.h5"}).out,
              HasSubstr("note: the scenes differ in load.force\n"));
}

TEST_F(Program, CompareGivesNoErrorBetweenPlaneAndSpace) {
  ASSERT_EQ(run({"--quiet", "-o", "plane.h5", "--set", "integrator.step=50"}).exit_code, 0);
  const std::string groove =
      GNOMON_SOURCE_DIR "/problems/ball_on_half_space/small_deformation.toml";
  ASSERT_EQ(gnomon({"run", groove, "--quiet", "-o", "space.h5", "--set", "mesh.elements=[4, 8, 3]",
                    "--set", "mesh.size=[0.2, 0.1, 0.1]", "--set", "mesh.fine=[0, 0, 0]", "--set",
                    "time.end=100", "--set", "output.times=[]"})
                .exit_code,
            0);
  EXPECT_THAT(gnomon({"compare", "plane.h5", "space.h5"}).out,
              testing::ContainsRegex("other dimension +-  plane.h5"));
}

TEST_F(Program, CompareSaysOnceThatASceneCannotBeRead) {
  ASSERT_EQ(run({"--quiet", "-o", "a.h5", "--set", "integrator.step=50"}).exit_code, 0);
  std::string bytes = test::read_text(folder() / "a.h5");
  bytes.replace(bytes.find("young_modulus"), 13, "young_modulux");  // as of another version
  write("b.h5", bytes);
  const std::string out = gnomon({"compare", "a.h5", "b.h5", "--reference", "./b.h5"}).out;
  const std::size_t first = out.find("note: the scene of ");
  ASSERT_NE(first, std::string::npos) << out;
  EXPECT_EQ(out.find("note:", first + 1), std::string::npos) << out;
}

TEST_F(Program, InfoTellsStatusUnknownsAndScene) {
  ASSERT_EQ(run({"--quiet", "-o", "a.h5", "--set", "integrator.step=5"}).exit_code, 0);
  const Outcome outcome = gnomon({"info", "a.h5"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* part : {"finished", "displacement", "0, 50, 100", "worn_volume", "elements = "})
    EXPECT_THAT(outcome.out, HasSubstr(part));
}

TEST_F(Program, WarnsWhenAnAcceptedContactChatters) {
  const auto warning = [&](const std::string& step) {
    const Outcome outcome =
        gnomon({"run", pin, "--set", coarse, "--integrator", "forward-euler", "--set",
                "integrator.step=" + step, "--set", "integrator.unstable=accept", "--force", "-o",
                "a.h5", "--summary", "s.json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto json = nlohmann::json::parse(test::read_text(folder() / "s.json"));
    const bool warned = outcome.err.find("warning") != std::string::npos;
    EXPECT_EQ(warned, json["chattering_nodes"] > 0);
    EXPECT_EQ(json["warnings"].size(), warned ? 1 : 0);
    for (const std::string text : json["warnings"]) EXPECT_THAT(outcome.err, HasSubstr(text));
    return warned;
  };
  EXPECT_FALSE(warning("20"));  // the critical step is about 46 s
  EXPECT_TRUE(warning("100"));
}

// For every way of detection: at the start, by chattering, or at the end of a run in one step.
TEST_F(Program, StopsBeyondTheCriticalStep) {
  const auto run = [&](const std::string& integrator, const std::string& step) {
    return gnomon({"run", pin, "--set", coarse, "--integrator", integrator, "--set",
                   "integrator.step=" + step, "--force", "-o", "a.h5"});
  };
  for (const char* integrator : {"forward-euler", "erk-4"}) {
    EXPECT_EQ(run(integrator, "20").exit_code, 0) << integrator;
    for (const char* step : {"100", "250", "1000"}) {
      const Outcome outcome = run(integrator, step);
      EXPECT_EQ(outcome.exit_code, 3) << integrator << " " << step;
      EXPECT_THAT(outcome.err, HasSubstr("critical")) << integrator << " " << step;
    }
  }
  EXPECT_EQ(run("backward-euler", "1000").exit_code, 0);
}

// Contact at one node, which has no fast mode, at the start and at the end. In between it is wider,
// after the first or the second step, depending on rounding.
TEST_F(Program, StopsWhereWiderContactInBetweenIsUnstable) {
  const Outcome outcome =
      gnomon({"run", pin, "--set", "mesh.elements=[8,8]", "--set", "body.young_modulus=1e4",
              "--integrator", "forward-euler", "--set", "integrator.step=334", "-o", "a.h5"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, testing::ContainsRegex("exceed the critical one of forward-euler at "
                                                  "t = [1-9]"));
}

TEST_F(Program, WarnsWhenNoStateTellsOfStability) {
  const Outcome outcome = gnomon({"run", pin, "--set", "mesh.elements=[4,4]", "--integrator",
                                  "erk-2", "--set", "integrator.step=1000", "-o", "a.h5"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("no step ended with a decaying mode"));
}

TEST_F(Program, WarnsOfLargeStrainsOfSmallKinematics) {
  const auto warned = [&](const std::string& young) {
    const Outcome outcome =
        gnomon({"run", pin, "--set", coarse, "--set", "body.material=linear", "--set",
                "body.young_modulus=" + young, "--force", "-o", "a.h5"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return outcome.err.find("displacements have gradients up to") != std::string::npos;
  };
  EXPECT_FALSE(warned("640"));
  EXPECT_TRUE(warned("0.5"));
}

// A step of 1e-10 s, in which the change of the shape is smaller than rounding errors, is not made.
TEST_F(Program, TimesBesideTheGridOfStepsMoveIt) {
  for (const char* integrator : {"backward-euler", "erk-3"})
    for (const char* time : {"20.0000000001", "19.9999999999"}) {
      const Outcome outcome =
          gnomon({"run", pin, "--set", coarse, "--integrator", integrator, "--set",
                  "integrator.step=20", "--set", std::string("output.times=[") + time + "]",
                  "--set", "time.end=60", "--force", "-o", "a.h5", "--summary", "s.json"});
      EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
      const auto json = nlohmann::json::parse(test::read_text(folder() / "s.json"));
      EXPECT_EQ(json["steps"], 3) << integrator << " " << time;
    }
}

TEST_F(Program, StopsWhenThePinIsWornAway) {
  const Outcome outcome = gnomon({"run", pin, "--set", coarse, "--integrator", "bdf", "--set",
                                  "wear.coefficient=1e-5", "-o", "a.h5"});
  EXPECT_EQ(outcome.exit_code, 3);
  // One warning, long before.
  const std::string warning = "gnomon: warning: at t = ";
  const std::size_t at = outcome.err.find(warning),
                    end = outcome.err.find("of its volume: the body");
  ASSERT_NE(at, std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find(warning, at + 1), std::string::npos) << outcome.err;
  EXPECT_LT(at, end) << outcome.err;
  EXPECT_LT(end, outcome.err.size()) << outcome.err;
  // The state before is kept; its mesh is usable.
  const HistoryRow last = ResultReader(folder() / "a.h5").history().back();
  EXPECT_GE(value_of(last.scalars, "element_volume").value(), 0.01);
}

TEST_F(Program, StoresThePhasesOfSprings) {
  const std::string springs = GNOMON_SOURCE_DIR "/problems/winkler/cycle.toml";
  const Outcome run = gnomon({"run", springs, "--set", "time.cycles=100", "-o", "springs.h5"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.out, testing::EndsWith("\nresult: springs.h5\n"));
}

TEST_F(Program, NamesAFileForParaViewOnlyWhereThereIsAMesh) {
  const std::string springs = GNOMON_SOURCE_DIR "/problems/winkler/pin.toml";
  const Outcome none = gnomon({"run", springs, "--set", "foundation.points=21", "--set",
                               "time.end=10", "-o", "springs.h5"});
  ASSERT_EQ(none.exit_code, 0) << none.err;
  EXPECT_THAT(none.out, testing::EndsWith("\nresult: springs.h5\n"));
  EXPECT_THAT(gnomon({"resume", "springs.h5", "--end", "20"}).out,
              testing::EndsWith("\nresult: springs.h5\n"));
  const Outcome mesh =
      gnomon({"run", test::pin, "--set", test::coarse, "--set", "time.end=1", "-o", "pin.h5"});
  EXPECT_THAT(mesh.out, testing::EndsWith("\nresult: pin.h5 (for ParaView: pin.xdmf)\n"));
}

TEST_F(Program, ListsAndHelp) {
  const Outcome subjects = gnomon({"list"});
  EXPECT_EQ(subjects.exit_code, 0);
  EXPECT_THAT(subjects.out,
              testing::AllOf(HasSubstr("\n  integrators\n"), HasSubstr("\n  shapes\n")));
  EXPECT_THAT(gnomon({"list", "integrators"}).out, HasSubstr("backward-euler"));
  EXPECT_THAT(gnomon({"list", "problems"}).out, HasSubstr("pin_on_flat"));
  EXPECT_THAT(gnomon({"list", "scenes"}).out, HasSubstr("small_deformation.toml"));
  EXPECT_THAT(gnomon({"list", "studies"}).out, HasSubstr("quick.toml"));
  EXPECT_THAT(gnomon({"list", "scenes"}).out, testing::Not(HasSubstr("quick.toml")));
  EXPECT_THAT(gnomon({"--version"}).out, HasSubstr("gnomon "));
  EXPECT_THAT(gnomon({"help", "scene", "pin_on_flat"}).out, HasSubstr("pin.radius"));
  for (const char* topic :
       {"scene", "studies", "integrators", "commands", "units", "output", "exit-codes", "run",
        "study", "check", "list", "info", "contact", "compare", "plot", "help"}) {
    const Outcome outcome = gnomon({"help", topic});
    EXPECT_EQ(outcome.exit_code, 0) << topic;
    EXPECT_FALSE(outcome.out.empty()) << topic;
  }
  EXPECT_THAT(gnomon({"help"}).out, HasSubstr("compare"));
  EXPECT_THAT(gnomon({"run", "--help"}).out, HasSubstr("--integrator"));
}

TEST_F(Program, FailedStartExitsWith3AndTellsItsReason) {
  // Far too soft for its load: the load ramp finds no equilibrium.
  const Outcome outcome =
      run({"--set", "body.young_modulus=0.1", "-o", "a.h5", "--summary", "s.json", "--quiet"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(lines_of(outcome.err).size(), 1u) << outcome.err;
  const auto json = nlohmann::json::parse(test::read_text(folder() / "s.json"));
  EXPECT_EQ(json["status"], "failed");
  EXPECT_FALSE(json["diagnosis"].get<std::string>().empty());
  EXPECT_THAT(files(), ElementsAre("s.json"));
}

TEST_F(Program, ForceReplacesTheFilesOfAnEarlierRunOnceTheStartIsSolved) {
  const std::vector<std::string> names = {"-o", "a.h5", "--summary", "s.json", "--quiet"};
  const auto run_again = [&](std::vector<std::string> further) {
    further.insert(further.end(), names.begin(), names.end());
    return run(further);
  };
  ASSERT_EQ(run_again({}).exit_code, 0);
  const auto all = files();
  std::vector<std::string> earlier;
  for (const std::string& name : all) earlier.push_back(test::read_text(folder() / name));

  const Outcome failed = run_again({"--force", "--set", "body.young_modulus=0.1"});
  EXPECT_EQ(failed.exit_code, 3);
  EXPECT_THAT(failed.err, HasSubstr("the earlier a.h5 is kept"));
  ASSERT_EQ(files(), all);
  for (std::size_t i = 0; i < all.size(); ++i)
    EXPECT_TRUE(test::read_text(folder() / all[i]) == earlier[i]) << all[i];

  EXPECT_EQ(run_again({"--force", "--integrator", "bdf"}).exit_code, 0);
  EXPECT_EQ(files(), all);
  EXPECT_EQ(ResultReader(folder() / "a.h5").header().integrator, "bdf");
  EXPECT_THAT(test::read_text(folder() / "s.json"), HasSubstr("\"bdf\""));
}

TEST_F(Program, SummaryIsPrintedInsteadOfTheText) {
  const Outcome outcome = run({"-o", "a.h5", "--summary", "-"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out)["status"], "finished");
  EXPECT_THAT(files(), ElementsAre("a.h5", "a.xdmf"));
}

class Signals : public Program, public testing::WithParamInterface<int> {};

TEST_P(Signals, EndTheRunAfterTheStepWithAReadableResult) {
  const pid_t child = start({"run", pin, "--set", coarse, "--set", "time.end=1e5", "--set",
                             "integrator.step=0.01", "-o", "a.h5", "--summary", "s.json"});
  // Wait until it computes: the result is there and the first progress line printed.
  for (int i = 0; i < 1000 && !std::filesystem::exists(folder() / "a.h5"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  kill(child, GetParam());
  const Outcome outcome = finish(child);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("interrupted at t = "));

  const ResultReader result(folder() / "a.h5");
  EXPECT_EQ(result.status(), "interrupted");
  ASSERT_FALSE(result.history().empty());
  EXPECT_EQ(result.stored_times().back(), result.history().back().t);
  const auto json = nlohmann::json::parse(test::read_text(folder() / "s.json"));
  EXPECT_EQ(json["status"], "interrupted");
}

TEST_P(Signals, EndAPlanAsARun) {
  const pid_t child =
      start({"plan", pin, "--set", "accuracy.within=0.001", "--set", "time.end=1e5"});
  ASSERT_TRUE(catches(child, GetParam()));
  kill(child, GetParam());
  const Outcome outcome = finish(child);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("interrupted"));
}

INSTANTIATE_TEST_SUITE_P(Kinds, Signals, testing::Values(SIGINT, SIGTERM));

TEST_F(Program, AnInterruptedRunHasNoKnownAccuracy) {
  const pid_t child = start({"run", pin, "--set", "accuracy.within=0.01", "--set",
                             "mesh.elements=[40,20]", "-o", "a.h5"});
  for (int i = 0; i < 6000 && !std::filesystem::exists(folder() / "a.h5"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGTERM);
  const Outcome outcome = finish(child);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("not known, for the run was interrupted")) << outcome.err;
}

// A batch system sends SIGTERM to all processes of a job, and a study that ends sends it to its
// runs.
TEST_F(Program, ASecondSigtermDoesNotKill) {
  const pid_t child = start({"run", pin, "--set", "mesh.elements=[80, 80]", "--set",
                             "integrator.step=1", "-o", "a.h5", "--quiet"});
  const auto steps = [&] {
    const auto result = folder() / "a.h5";
    return std::filesystem::exists(result) ? ResultReader(result).history().size() : 0;
  };
  for (int i = 0; i < 6000 && steps() < 3; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, SIGTERM);
  std::this_thread::sleep_for(std::chrono::milliseconds(10));  // less than a step takes
  kill(child, SIGTERM);
  EXPECT_EQ(finish(child).exit_code, 1);
  EXPECT_EQ(ResultReader(folder() / "a.h5").status(), "interrupted");
}

// Soft and nearly incompressible, so that the start takes a while.
TEST_F(Program, SignalDuringTheStartEndsTheRunThere) {
  const pid_t child =
      start({"run", pin, "--set", "mesh.elements=[24,24]", "--set", "body.young_modulus=10",
             "--set", "body.poisson_ratio=0.499", "-o", "a.h5"});
  for (int i = 0; i < 10000 && !std::filesystem::exists(folder() / "a.h5"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kill(child, SIGINT);
  const Outcome outcome = finish(child);
  EXPECT_EQ(outcome.exit_code, 1) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("interrupted in the start (a.h5 is not written)"));
  EXPECT_FALSE(std::filesystem::exists(folder() / "a.h5"));
}

TEST_F(Program, UnwritableStandardErrorEndsNoRun) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP();
  const auto status = [&](const std::string& arguments) {
    const std::string command =
        "cd " + folder().string() + " && exec " + GNOMON_PROGRAM + " " + arguments;
    return WEXITSTATUS(std::system(command.c_str()));
  };
  const std::string run = "run " + pin + " --set " + coarse + " --set time.end=100 -o ";
  EXPECT_EQ(status(run + "full.h5 >/dev/null 2>/dev/full"), 0);
  EXPECT_EQ(status(run + "closed.h5 >/dev/null 2>&-"), 0);
  EXPECT_EQ(status(run + "both.h5 >&- 2>&-"), 1);  // its final message is lost
  EXPECT_EQ(status("info none.h5 2>/dev/full"), 2);
  for (const char* name : {"full.h5", "closed.h5", "both.h5"})
    EXPECT_EQ(ResultReader(folder() / name).status(), "finished") << name;
}

TEST_F(Program, FullStandardOutputIsAFailure) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP();
  const std::string command =
      std::string("exec ") + GNOMON_PROGRAM + " help scene >/dev/full 2>/dev/null";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1);
}

}  // namespace
}  // namespace gnomon::program_test
