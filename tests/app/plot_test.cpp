// gnomon plot: figures of the program's own results, and its exit codes. Drawing needs matplotlib.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <gnomon/results/results.hpp>
#include <regex>
#include <set>

#include "app/child.hpp"

namespace gnomon::plot_test {
namespace {

using test::Outcome;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
namespace fs = std::filesystem;

class Plot : public test::ProgramTest {
protected:
  void SetUp() override {
    if (!test::can_draw()) GTEST_SKIP() << test::drawing_needs;
  }

  void make_result(const std::string& name,
                   const std::string& setting = "integrator.name=\"bdf\"") const {
    const Outcome outcome = gnomon({"run", test::pin, "--set", test::coarse, "--set",
                                    "time.end=100", "--quiet", "-o", name, "--set", setting});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }

  /// A quarter ball of 80 elements at 0, 100 and 200 s.
  void make_ball(const std::string& name, const std::string& step) const {
    const Outcome outcome = gnomon(
        {"run", GNOMON_SOURCE_DIR "/problems/ball_on_flat/finite_deformation.toml", "--set",
         "mesh.elements=[4,1,1]", "--set", "integrator.step=" + step, "--set", "time.end=200",
         "--set", "output.times=[100]", "--integrator", "backward-euler", "--quiet", "-o", name});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }

  /// A bitmap that is not blank, and a drawing whose ids are its own.
  void expect_figure(const std::string& stem) const {
    const std::string png = test::read_text(folder() / (stem + ".png"));
    EXPECT_EQ(png.substr(1, 3), "PNG") << stem;
    EXPECT_GT(png.size(), 8000u) << stem;
    const std::string svg = test::read_text(folder() / (stem + ".svg"));
    EXPECT_THAT(svg, HasSubstr("</svg>")) << stem;
    EXPECT_GT(svg.size(), 8000u) << stem;
    EXPECT_LT(svg.size(), 1000000u) << stem;
  }
};

std::set<std::string> ids_of(const fs::path& svg) {
  const std::string text = test::read_text(svg);
  const std::regex pattern("\\bid=\"([^\"]+)\"");
  std::set<std::string> ids;
  for (std::sregex_iterator it(text.begin(), text.end(), pattern), end; it != end; ++it)
    EXPECT_TRUE(ids.insert((*it)[1]).second) << (*it)[1];
  return ids;
}

const char* const study_header =
    "study,sweep,method,integrator,setting_kind,setting,run,status,reason,shape_error,shape_error_"
    "max,"
    "shape_error_self,pressure_error,reference,reference_error,marked,steps,rejected,events,"
    "newton_iterations,residual_evaluations,jacobian_evaluations,factorizations,linear_solves,"
    "krylov_iterations,preconditioner_setups,wall_seconds,cpu_seconds,peak_memory_mb\n";

std::string study_row(const char* method, const char* kind, double setting, const char* status,
                      const char* error) {
  const std::string number = std::to_string(setting);
  return std::string("mesh,640,") + method + "," + method + "," + kind + "," + number + "," +
         method + number + "," + status + ",," + error +
         ",,1e-3,,tight,1e-5,0,10,0,0,30,40,5,5,30,0,0,0.1,0.1,50\n";
}

TEST_F(Plot, DrawsAResult) {
  make_result("a b.h5");
  const Outcome outcome = gnomon({"plot", "a b.h5", "-o", "figures"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  for (const char* kind : {"shape", "pressure", "history", "mesh", "wear"})
    expect_figure(std::string("figures/a b-") + kind);
  EXPECT_THAT(outcome.out, HasSubstr("pressure-map: skipped"));
}

TEST_F(Plot, DrawsBodiesInSpaceAndTwoResultsBesideEachOther) {
  make_ball("two steps.h5", "100.0");
  make_ball("four.h5", "50.0");
  const Outcome outcome = gnomon({"plot", "two steps.h5", "four.h5"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
  for (const char* kind : {"pressure", "history", "mesh", "wear", "pressure-map", "depth-map"})
    for (const char* name : {"two steps-", "four-"})
      expect_figure(std::string("figures/") + name + kind);
  EXPECT_THAT(outcome.out, HasSubstr("four-shape: skipped"));
  expect_figure("figures/two steps-four-pressure");
}

TEST_F(Plot, HasNoPressureWhereNothingTouches) {
  const Outcome made = gnomon({"run", GNOMON_SOURCE_DIR "/problems/stressed_surface/wave.toml",
                               "--set", "time.end=1", "--quiet", "-o", "wave.h5"});
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const Outcome outcome = gnomon({"plot", "wave.h5"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(fs::exists(folder() / "figures/wave-shape.png"));
  EXPECT_FALSE(fs::exists(folder() / "figures/wave-pressure.png"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("pressure")));
}

TEST_F(Plot, GeometryInSpace) {
  const std::string tests = GNOMON_SOURCE_DIR "/tests/app/check_space.py";
  const std::string tools = GNOMON_SOURCE_DIR "/tools/plot";
  EXPECT_EQ(std::system(("/usr/bin/python3 '" + tests + "' '" + tools + "'").c_str()), 0);
}

TEST_F(Plot, GeometryInThePlane) {
  const std::string tests = GNOMON_SOURCE_DIR "/tests/app/check_plane.py";
  const std::string tools = GNOMON_SOURCE_DIR "/tools/plot";
  EXPECT_EQ(std::system(("/usr/bin/python3 '" + tests + "' '" + tools + "'").c_str()), 0);
}

TEST_F(Plot, ErrorsAndWorkOfAStudy) {
  const std::string tests = GNOMON_SOURCE_DIR "/tests/app/check_study.py";
  const std::string tools = GNOMON_SOURCE_DIR "/tools/plot";
  EXPECT_EQ(std::system(("/usr/bin/python3 '" + tests + "' '" + tools + "'").c_str()), 0);
}

// The pin's flat is in its result, where the pin touches it.
TEST_F(Plot, TheCounterBodyIsInTheResult) {
  make_result("a.h5");
  const ResultReader reader(folder() / "a.h5");
  const auto flat = reader.counter_surface(0);
  ASSERT_TRUE(flat);
  EXPECT_EQ(flat->dim, 2);
  double left = 0, right = 0;
  for (const auto& point : flat->points) {
    EXPECT_NEAR(point[1], 0, 1e-12);
    left = std::min(left, point[0]);
    right = std::max(right, point[0]);
  }
  EXPECT_LT(left, -6);  // the pin is 10 mm wide
  EXPECT_GT(right, 6);
}

TEST_F(Plot, ASceneIsNoResultAndSaysSo) {
  fs::copy_file(test::pin, folder() / "pin.toml");
  const Outcome outcome = gnomon({"plot", "pin.toml"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err,
            "gnomon: pin.toml is a scene or a study, not a result: `gnomon run pin.toml` makes a "
            "result, which can be drawn\n");
}

// Matplotlib's own messages about its folders, and about fonts that it looks for again.
TEST_F(Plot, AnUnwritableHomeIsNobodysConcern) {
  make_result("a.h5");
  for (const char* name : {"HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME"})
    setenv(name, "/proc/nowhere", 1);
  const Outcome outcome = gnomon({"plot", "a.h5"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, IsEmpty());
}

TEST_F(Plot, DrawsAStudyASpectrumAndExtremes) {
  std::string rows = study_header;
  for (const double step : {50.0, 100.0, 200.0}) {
    rows +=
        study_row("backward-euler", "step", step, "finished", std::to_string(1e-4 * step).c_str());
    rows += study_row("forward-euler", "step", step, step > 100 ? "failed" : "finished",
                      step > 100 ? "" : std::to_string(1e-4 * step).c_str());
    rows += study_row("bdf", "rtol", 1e-5 * step, "finished", std::to_string(1e-4 * step).c_str());
  }
  write("study.csv", rows);
  write("spectrum.csv", "time,real,imag\n0,-0.5,0\n0,-0.1,0.02\n0,0,0\n10,-0.4,0\n");
  write("critical_steps.csv",
        "time,method,critical_step,empirical\n0,rk4,5.6,5.5\n0,forward-euler,4,\n");
  std::string cases = "study,sweep,method,integrator,rtol,difference,marked\n";
  for (const char* method : {"bdf,bdf", "bdf located,bdf", "esdirk-3,esdirk-3"})
    for (const char* tolerance : {"1e-2", "1e-4", "1e-6"})
      cases += std::string("a,,") + method + "," + tolerance + "," + tolerance + ",0\n";
  write("extremes.csv", cases + "b,,bdf,bdf,1e-3,2e-3,1\nb,,bdf,bdf,,,0\n");
  const Outcome outcome = gnomon({"plot", "."});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::set<std::string> ids;
  for (const char* stem : {"mesh-error-step", "mesh-error-tolerance", "mesh-work", "spectrum",
                           "critical-steps", "accuracy"}) {
    expect_figure(std::string("figures/") + stem);
    for (const std::string& id : ids_of(folder() / "figures" / (std::string(stem) + ".svg")))
      EXPECT_TRUE(ids.insert(id).second) << id;
  }
}

// Figs. 2 and 4: only of methods whose longest and shortest steps have left results.
TEST_F(Plot, LaysTheShapesOfAStudyOverEachOther) {
  std::string rows = study_header;
  for (const double step : {25.0, 50.0})
    for (const char* method : {"backward-euler", "forward-euler"})
      rows += study_row(method, "step", step, "finished", "1e-3");
  write("study.csv", rows);
  fs::create_directory(folder() / "runs");
  make_result("runs/backward-euler25.000000.h5", "integrator.step=25");
  EXPECT_THAT(gnomon({"plot", "."}).out, HasSubstr("shapes: skipped, no method has results"));
  make_result("runs/backward-euler50.000000.h5", "integrator.step=50");
  const Outcome outcome = gnomon({"plot", "."});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_figure("figures/mesh-shapes");
}

TEST_F(Plot, BadInputIsOneLineAndExitCode2) {
  write("text.h5", "not HDF5");
  write("study.csv", "study,sweep\na,b\n");
  for (const char* name : {"empty", "short"}) fs::create_directory(folder() / name);
  write("short/study.csv", std::string(study_header) + "mesh,640\n");
  for (const char* target : {"absent.h5", "text.h5", ".", "empty", "short"}) {
    const Outcome outcome = gnomon({"plot", target});
    EXPECT_EQ(outcome.exit_code, 2) << target;
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
    EXPECT_THAT(outcome.err, testing::StartsWith("gnomon: ")) << target;
  }
  EXPECT_FALSE(fs::exists(folder() / "figures"));
}

TEST_F(Plot, FiguresOfOneNameDoNotReplaceEachOther) {
  for (const char* folder_of_two : {"one", "other"}) {
    const fs::path parent = folder_of_two;
    fs::create_directories(folder() / parent / "modes");
    make_result((parent / "a.h5").string());
    write(parent / "modes/spectrum.csv", "time,real,imag\n0,-0.5,0\n0,-0.1,0.02\n");
  }
  for (const std::string name : {"a.h5", "modes"}) {
    const Outcome outcome = gnomon({"plot", "one/" + name, "other/" + name, "-o", "all"});
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("other/" + name + " has figures of the names that those"));
  }
  // A folder and a result of its name have figures of other names.
  const Outcome outcome = gnomon({"plot", "one/modes", "one/a.h5", "-o", "both"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
}

TEST_F(Plot, DamageIsRefusedBeforeTheFirstFigure) {
  make_result("whole.h5");
  const std::string tests = GNOMON_SOURCE_DIR "/tests/app/check_damage.py";
  const std::string tools = GNOMON_SOURCE_DIR "/tools/plot";
  const std::string whole = (folder() / "whole.h5").string();
  const std::string command = "'" + tests + "' '" + tools + "' '" + whole + "'";
  EXPECT_EQ(std::system(("/usr/bin/python3 " + command).c_str()), 0);
}

TEST_F(Plot, WithoutPythonItNamesThePackages) {
  write("a.h5", "");
  setenv("PATH", "/nonexistent", 1);
  const Outcome outcome = gnomon({"plot", "a.h5"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("python3-matplotlib python3-h5py python3-jinja2"));
}

}  // namespace
}  // namespace gnomon::plot_test
