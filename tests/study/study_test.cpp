// Studies through the real program: values, marks, failures, resuming.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <gnomon/mesh/mesh_file.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/results/results.hpp>
#include <gnomon/results/surface_difference.hpp>
#include <gnomon/study/study.hpp>
#include <thread>

#include "results/hdf5_values.hpp"
#include "study/declaration.hpp"
#include "study/run_warnings.hpp"
#include "study/study_fixture.hpp"

namespace gnomon::study_test {
namespace {

using test::Outcome;
using test::Row;
using ::testing::HasSubstr;
using ::testing::SizeIs;

class StudyRuns : public test::StudyTest {
protected:
  ContactSurface surface(const std::string& run, std::optional<double> t = std::nullopt) const {
    return ResultReader(folder() / "out/runs" / (run + ".h5")).contact(t);
  }
};

TEST_F(StudyRuns, MeasuresErrorsAgainstTheReference) {
  write("study.toml", head() + "[[sweep]]\nkey = \"body.young_modulus\"\nvalues = [20, 640]\n" +
                          method("backward-euler", "steps = [10, 50]") +
                          "[self_reference]\nmethod = \"backward-euler\"\nstep = 5\n");
  const Outcome outcome = study({"--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto rows = this->rows();
  ASSERT_THAT(rows, SizeIs(6));  // the self-reference is a row of its own
  const Row& row = rows[3];
  EXPECT_EQ(row.at("study"), "study");
  EXPECT_EQ(row.at("sweep"), "body.young_modulus=640");
  EXPECT_EQ(row.at("method"), "backward-euler");
  EXPECT_EQ(row.at("setting_kind"), "step");
  EXPECT_EQ(row.at("setting"), "10");
  EXPECT_EQ(row.at("status"), "finished");
  EXPECT_EQ(row.at("steps"), "10");
  EXPECT_EQ(row.at("marked"), "0");

  const std::string own = "young_modulus_640__backward-euler__step-10";
  const std::string reference = "young_modulus_640__esdirk-5__rtol-1e-8";
  EXPECT_DOUBLE_EQ(std::stod(row.at("shape_error")), shape_error(surface(own), surface(reference)));
  EXPECT_DOUBLE_EQ(std::stod(row.at("pressure_error")),
                   pressure_error(surface(own), surface(reference)));
  double largest = 0;
  for (const double t : {20.0, 40.0, 60.0, 80.0, 100.0})
    largest = std::max(largest, shape_error(surface(own, t), surface(reference, t)));
  EXPECT_DOUBLE_EQ(std::stod(row.at("shape_error_max")), largest);
  EXPECT_DOUBLE_EQ(std::stod(row.at("shape_error_self")),
                   shape_error(surface(own), surface("young_modulus_640__backward-euler__step-5")));
  EXPECT_EQ(rows[5].at("shape_error_self"), "");  // the self-reference itself
  EXPECT_DOUBLE_EQ(std::stod(row.at("reference_error")),
                   shape_error(surface("young_modulus_640__bdf__rtol-1e-9"), surface(reference)));
  EXPECT_LT(std::stod(row.at("reference_error")), 1e-6);
  for (const char* name : {"wall_seconds", "cpu_seconds", "peak_memory_mb", "newton_iterations",
                           "factorizations", "linear_solves", "residual_evaluations"})
    EXPECT_GT(std::stod(row.at(name)), 0) << name;
  EXPECT_EQ(json()["self_reference"], "backward-euler step 5");
  const hdf5::Handle file = hdf5::own(
      H5Fopen((folder() / "out/study.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose, "open");
  EXPECT_EQ(hdf5::read_text(file.id(), "text"), test::read_text(folder() / "study.toml"));
  const hdf5::Handle table = hdf5::own(H5Dopen2(file.id(), "study", H5P_DEFAULT), H5Dclose, "open");
  const auto one = hdf5::own(H5Tcreate(H5T_COMPOUND, 8), H5Tclose, "describe");
  H5Tinsert(one.id(), "shape_error", 0, H5T_NATIVE_DOUBLE);
  std::vector<double> errors(6);
  ASSERT_GE(H5Dread(table.id(), one.id(), H5S_ALL, H5S_ALL, H5P_DEFAULT, errors.data()), 0);
  EXPECT_EQ(errors[3], std::stod(row.at("shape_error")));
}

/// References with such loose tolerances that all errors are marked.
const std::string loose =
    "[[reference]]\nintegrator = \"sdirk-2\"\ntolerance = 0.1\n"
    "[[reference]]\nintegrator = \"bdf\"\ntolerance = 0.1\n";

Scene scene_of(const StudyRun& run) {
  return parse_scene(run.scene, run.name, {}, key_table);
}

TEST_F(StudyRuns, CanDifferInSettling) {
  write("study.toml", head() + method("bdf", "tolerances = [1e-2]") +
                          method("bdf", "tolerances = [1e-2]",
                                 "name = \"unsettled\"\nset.output.settle = false"));
  const Study study = load_study(folder() / "study.toml");
  const auto settles = [&](std::size_t point) {
    return scene_of(study.runs[study.points[point].run]).flag("output.settle");
  };
  EXPECT_TRUE(settles(0));
  EXPECT_FALSE(settles(1));
}

TEST(ShippedStudies, CanBeRead) {
  int count = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(GNOMON_SOURCE_DIR "/problems"))
    if (entry.path().parent_path().filename() == "studies") {
      EXPECT_NO_THROW(study::read_declaration(entry.path(), Impossible::refused)) << entry.path();
      ++count;
    }
  EXPECT_GT(count, 10);
}

// As of the accuracy of Newton's method, by runs to rounding.
TEST_F(StudyRuns, AReferenceMayBeTheSameForAllSweptValues) {
  const std::string key = "integrator.nonlinear_fraction";
  std::string text = head() + "[[sweep]]\nkey = \"" + key + "\"\nvalues = [0.01, 0.1]\n" +
                     method("bdf", "tolerances = [1e-3]");
  for (const char* integrator : {"esdirk-4", "bdf"})
    text += std::string("[[reference]]\nintegrator = \"") + integrator +
            "\"\ntolerance = 1e-5\nset." + key + " = 0.0\n";
  write("study.toml", text);
  const Study study = load_study(folder() / "study.toml");
  ASSERT_THAT(study.sweep, SizeIs(2));
  EXPECT_EQ(study.sweep[0].references, study.sweep[1].references);
  for (const std::size_t run : study.sweep[0].references)
    EXPECT_EQ(scene_of(study.runs[run]).real(key), 0);
  EXPECT_EQ(scene_of(study.runs[study.points[1].run]).real(key), 0.1);
}

TEST_F(StudyRuns, MarksErrorsThatTheReferenceCannotResolve) {
  write("study.toml", head() + method("bdf", "tolerances = [1e-3]") + loose);
  const Outcome outcome = study();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\n* less than ten times"));
  const Row row = rows().front();
  EXPECT_LT(std::stod(row.at("shape_error")), 10 * std::stod(row.at("reference_error")));
  EXPECT_EQ(row.at("marked"), "1");
  EXPECT_EQ(row.at("sweep"), "");
  EXPECT_EQ(json()["rows"][0]["marked"][0], "shape_error");
}

TEST_F(StudyRuns, AClosedFormIsTheReferenceWhereThereIsOne) {
  write("study.toml", head() + method("backward-euler", "steps = [50, 25]") + loose);
  ASSERT_EQ(study({"--quiet"}).exit_code, 0);
  Study study = load_study(folder() / "study.toml");
  SweepPoint& sweep = study.sweep.front();
  for (const double t : sweep.times) sweep.exact.push_back(surface("backward-euler__step-25", t));
  sweep.references.clear();
  const StudyTable table = measure(study, folder() / "out");
  EXPECT_EQ(table.references.front().text, "closed form");
  EXPECT_EQ(table.references.front().error, 0.0);
  const StudyRow& row = table.rows.front();
  EXPECT_DOUBLE_EQ(row.shape_error.value(), shape_error(surface("backward-euler__step-50"),
                                                        surface("backward-euler__step-25")));
  EXPECT_FALSE(row.pressure_error);  // a closed form has no pressures
  EXPECT_FALSE(row.marked_shape || row.marked_max || row.marked_pressure);
  EXPECT_EQ(table.rows.back().shape_error, 0.0);
}

TEST_F(StudyRuns, AClosedFormIsCalledExact) {
  write("scene.toml",
        test::read_text(std::string(GNOMON_SOURCE_DIR) + "/problems/winkler/pin.toml"));
  write("study.toml", "scene = \"scene.toml\"\n[set]\nfoundation.points = 41\n" +
                          method("backward-euler", "steps = [100]"));
  const Outcome outcome = study();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("reference: closed form, exact\n"));
  EXPECT_THAT(outcome.out, Not(HasSubstr("* less than")));
  const nlohmann::json json = this->json();
  EXPECT_EQ(json["sweep"][0]["reference"]["closed_form"], true);
  EXPECT_EQ(json["rows"][0]["marked"].size(), 0u);
}

// It is that of a continuous foundation.
TEST_F(StudyRuns, GivenReferencesTakeThePlaceOfAClosedForm) {
  write("scene.toml",
        test::read_text(std::string(GNOMON_SOURCE_DIR) + "/problems/winkler/pin.toml"));
  write("study.toml", "scene = \"scene.toml\"\n[set]\nfoundation.points = 41\n" +
                          method("esdirk-3", "tolerances = [1e-7]") +
                          "[[reference]]\nintegrator = \"esdirk-5\"\ntolerances = [1e-8]\n"
                          "[[reference]]\nintegrator = \"bdf\"\ntolerances = [1e-9]\n");
  ASSERT_EQ(study().exit_code, 0);
  EXPECT_EQ(json()["sweep"][0]["reference"]["closed_form"], false);
  EXPECT_LT(std::stod(rows().front().at("shape_error")), 1e-5);  // 5.8e-4 from the closed form
}

// The worn volume of a constant load is k F v t, whatever the pressure.
TEST_F(StudyRuns, AParameterSweepNeedsNoMethodAndNoReference) {
  write("study.toml", "reference = \"none\"\n" + head() + "wear.normal = \"conservative\"\n" +
                          "[[sweep]]\nkey = \"load.force\"\nvalues = [10, 20]\n"
                          "[[sweep]]\nkey = \"integrator.events\"\nvalues = [\"ignore\"]\n");
  const Outcome outcome = study();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("worn_volume [mm^2]"), Not(HasSubstr("shape error"))));
  EXPECT_THAT(outcome.err, HasSubstr("2 runs, 0 done already"));  // no references
  const auto rows = this->rows();
  ASSERT_THAT(rows, SizeIs(2));
  for (const Row& row : rows) {
    const double force = std::stod(row.at("load.force"));
    const double worn = std::stod(row.at("worn_volume"));
    EXPECT_NEAR(worn, 1e-7 * force * 1000 * 100, 1e-4 * worn);
    EXPECT_NEAR(std::stod(row.at("worn_volume")) - std::stod(row.at("wear_integral")),
                std::stod(row.at("wear_difference")), 1e-12);
    EXPECT_GT(std::stod(row.at("max_pressure")), 0);
    EXPECT_EQ(row.at("reference"), "none");
    EXPECT_EQ(row.at("shape_error"), "");
    EXPECT_EQ(row.at("marked"), "0");
    EXPECT_EQ(row.at("integrator.events"), "ignore");
  }
  EXPECT_EQ(rows[1].at("load.force"), "20");
  for (const auto& column : json()["columns"]) {
    if (column["name"] == "load.force") {
      EXPECT_EQ(column["unit"], "N/mm");
    }
    if (column["name"] == "integrator.events") {
      EXPECT_EQ(column["unit"], "");
    }
  }
  EXPECT_EQ(json()["compared"], false);
  EXPECT_FALSE(json()["sweep"][0].contains("reference"));
}

TEST(StudyWarnings, AreToldOnceForEachKind) {
  Study study;
  StudyTable table;
  for (const char* text : {"depth 1.5e-4, of 0.02", "", "depth 3, of 4", "two elements wide"}) {
    StudyRow row;
    row.point.run = study.runs.size();
    if (*text) row.warnings = {text};
    study.runs.push_back(
        {.name = "run-" + std::to_string(study.runs.size()), .title = "", .scene = ""});
    table.rows.push_back(row);
  }
  table.rows.push_back(table.rows.front());  // of the same run
  EXPECT_EQ(study::warnings_text(study::warnings_of(study, table)),
            "warnings of 3 runs:\n"
            "  2 runs (as runs/run-0.json): depth 1.5e-4, of 0.02\n"
            "  1 run (as runs/run-3.json): two elements wide\n");
  EXPECT_EQ(study::warnings_text({}), "");
}

/// Steps that are too long for the stiffer body let pressures alternate.
TEST_F(StudyRuns, WarningsOfRunsAreKept) {
  write("study.toml", "reference = \"none\"\n" + head() + "integrator.unstable = \"accept\"\n" +
                          "[[sweep]]\nkey = \"body.young_modulus\"\nvalues = [20, 640]\n" +
                          method("forward-euler", "steps = [50]"));
  const Outcome outcome = study();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\nwarnings of 1 run:\n  1 run (as runs/young_modulus_640__"));
  EXPECT_EQ(json()["warnings"]["runs"], 1);
  EXPECT_EQ(json()["warnings"]["each"][0]["text"], json()["rows"][1]["warnings"][0]);
  EXPECT_THAT(json()["rows"][0]["warnings"], SizeIs(0));
}

TEST_F(StudyRuns, BodiesAreSetByTheirNames) {
  if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
  write("study.toml",
        "scene = \"" GNOMON_SOURCE_DIR
        "/problems/worn_body/cylinder_on_plate.toml\"\n"
        "reference = \"none\"\n[set]\nmesh.factor = 4.0\nbody.plate.young_modulus = 5e4\n"
        "[[sweep]]\nkey = \"body.cylinder.young_modulus\"\nvalues = [1e5]\n");
  const Study study = load_study(folder() / "study.toml");
  const Scene scene = parse_scene(study.runs.front().scene, "run.toml", {}, key_table);
  EXPECT_EQ(scene.real("body.1.young_modulus"), 1e5);
  EXPECT_EQ(scene.real("body.2.young_modulus"), 5e4);
}

// Runs that end at a depth have their lives in a column; errors are those of one time.
TEST_F(StudyRuns, ATimeToADepthIsSweptWithoutErrors) {
  const std::string until = head() + "time.until = \"worn_volume > 1e-4\"\n";
  write("study.toml",
        "reference = \"none\"\n" + until + "[[sweep]]\nkey = \"load.force\"\nvalues = [10, 20]\n");
  const Outcome outcome = study();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  std::vector<double> lives;
  for (const Row& row : rows()) lives.push_back(std::stod(row.at("time")));
  ASSERT_THAT(lives, SizeIs(2));
  EXPECT_LT(lives[0], 100);
  EXPECT_NEAR(lives[0] / lives[1], 2, 0.1);
  write("study.toml", until + method("esdirk-3", "tolerances = [1e-2]"));
  std::filesystem::remove_all(folder() / "out");
  const Outcome refused = study();
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_THAT(refused.err, HasSubstr("time.until: expected none in a study of errors"));
}

TEST_F(StudyRuns, WithoutAReferenceThereIsNoOther) {
  const auto refused = [&](const std::string& text, const std::string& reason) {
    write("study.toml", "reference = \"none\"\n" + head() + text);
    const Outcome outcome = study();
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, HasSubstr(reason));
  };
  refused(loose, "study.toml:6: not valid TOML");  // two meanings of `reference`
  refused(method("bdf", "tolerances = [1e-3]") +
              "[self_reference]\nmethod = \"bdf\"\ntolerance = 1e-6\n",
          "expected no self-reference with reference = \"none\"");
  const std::string own = " is given by the scene, or by `tolerances` of a [[method]]";
  refused("integrator.rtol = 1e-3\n",
          "study.toml:6: key `set.integrator.rtol`: expected another "
          "key, `integrator.rtol`" +
              own);
  refused("[[sweep]]\nkey = \"integrator.rtol\"\nvalues = [1e-3]\n",
          "study.toml:7: key `sweep.key`: expected another key, `integrator.rtol`" + own);
  write("study.toml", "reference = \"some\"\n" + head());
  EXPECT_THAT(study().err, HasSubstr("study.toml:1: key `reference`: expected \"none\""));
}

TEST_F(StudyRuns, FailuresStayInTheTableWithTheirReason) {
  // Far too soft for its load: there is no equilibrium on the loading path.
  write("study.toml", head() + "[[sweep]]\nkey = \"body.young_modulus\"\nvalues = [0.1, 640]\n" +
                          method("backward-euler", "steps = [50]") + loose);
  const Outcome outcome = study();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto rows = this->rows();
  ASSERT_THAT(rows, SizeIs(2));
  EXPECT_EQ(rows[0].at("status"), "failed");
  EXPECT_NE(rows[0].at("reason"), "");
  EXPECT_EQ(rows[0].at("shape_error"), "");
  EXPECT_THAT(rows[0].at("reference"), HasSubstr("failed: "));
  EXPECT_EQ(rows[0].at("reference_error"), "");
  EXPECT_EQ(rows[1].at("status"), "finished");
}

TEST_F(StudyRuns, AllFailedIsAFailure) {
  write("study.toml",
        head() + "body.young_modulus = 0.1\n" + method("backward-euler", "steps = [50]") + loose);
  EXPECT_EQ(study().exit_code, 3);
  EXPECT_THAT(rows(), SizeIs(1));
}

TEST_F(StudyRuns, ReferencesDoNotSaveATableOfFailures) {
  write("study.toml",
        head() + method("backward-euler", "steps = [50]", "set.body.young_modulus = 0.1") + loose);
  const Outcome outcome = study();
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("all 1 runs of the table failed"));
  EXPECT_THAT(rows().at(0).at("reference_error"), testing::Not(""));
}

TEST_F(StudyRuns, AnExistingFolderIsRefusedOrResumed) {
  write("study.toml", head() + method("backward-euler", "steps = [50]") + loose);
  ASSERT_EQ(study().exit_code, 0);
  const std::string csv = test::read_text(folder() / "out/study.csv");
  const Outcome again = study();
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("--resume"));
  const Outcome resumed = study({"--resume"});
  EXPECT_EQ(resumed.exit_code, 0);
  EXPECT_THAT(resumed.err, HasSubstr("3 runs, 3 done already"));
  EXPECT_EQ(test::read_text(folder() / "out/study.csv"), csv);  // times included: nothing was rerun
}

TEST_F(StudyRuns, OnlyCompleteRunsOfTheSameSceneAreKept) {
  write("study.toml", head() + method("backward-euler", "steps = [50, 25]") + loose);
  ASSERT_EQ(study().exit_code, 0);
  const auto summary = folder() / "out/runs/backward-euler__step-50.json";
  std::filesystem::resize_file(summary, std::filesystem::file_size(summary) / 2);
  EXPECT_THAT(study({"--resume"}).err, HasSubstr("4 runs, 3 done already"));
  write("study.toml",
        head() + "load.force = 10.0\n" + method("backward-euler", "steps = [50, 25]") + loose);
  EXPECT_THAT(study({"--resume"}).err, HasSubstr("4 runs, 0 done already"));
}

TEST_F(StudyRuns, AnotherStudysFolderIsRefusedAndKept) {
  write("study.toml", head() + method("backward-euler", "steps = [50]") + loose);
  ASSERT_EQ(study().exit_code, 0);
  const std::string text = test::read_text(folder() / "out/study.toml");
  const std::string csv = test::read_text(folder() / "out/study.csv");
  const std::string extended = head() + method("backward-euler", "steps = [50, 25]") + loose;
  write("other.toml", extended);
  const Outcome other = gnomon({"study", "other.toml", "-o", "out", "--resume"});
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_EQ(other.err,
            "gnomon: out: holds study \"study\", expected \"other\" or an empty folder\n");
  EXPECT_EQ(test::read_text(folder() / "out/study.toml"), text);
  EXPECT_EQ(test::read_text(folder() / "out/study.csv"), csv);

  write("study.toml", extended);
  EXPECT_THAT(study({"--resume"}).err, HasSubstr("4 runs, 3 done already"));
  EXPECT_THAT(rows(), SizeIs(2));
}

TEST_F(StudyRuns, RunsWhoseResultCannotBeReadAreMadeAnew) {
  write("study.toml", head() + method("backward-euler", "steps = [50, 25, 20]") + loose);
  ASSERT_EQ(study().exit_code, 0);
  const auto before = rows();
  const auto result = [&](const std::string& step) {
    return folder() / "out/runs" / ("backward-euler__step-" + step + ".h5");
  };
  std::filesystem::remove(result("50"));
  std::filesystem::resize_file(result("25"), std::filesystem::file_size(result("25")) / 2);
  EXPECT_THAT(study({"--resume"}).err, HasSubstr("5 runs, 3 done already"));
  const auto after = rows();
  ASSERT_THAT(after, SizeIs(3));
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(after[i].at("shape_error"), before[i].at("shape_error")) << i;
}

class Ended : public StudyRuns, public testing::WithParamInterface<int> {};

TEST_P(Ended, AStudyGoesOnWhereItWas) {
  // The last run takes too long to end before the signal.
  const std::string quick =
      head() + method("backward-euler", "steps = [50]", "name = \"a\"") + loose;
  write("study.toml", quick + method("backward-euler", "steps = [0.0005]"));
  const pid_t child = start({"study", "study.toml", "-o", "out", "--jobs", "1"});
  const std::string name = "backward-euler__step-0.0005";
  const auto last = folder() / "out/tries" / name / "1" / (name + ".h5");
  for (int i = 0; i < 3000 && !std::filesystem::exists(last); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  kill(child, GetParam());
  const Outcome outcome = finish(child);
  EXPECT_EQ(outcome.exit_code, GetParam() == SIGKILL ? -SIGKILL : 1) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder() / "out/study.csv"));

  // The run has ended as well: no process writes its result any more.
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const auto size_now = [&last] {
    std::error_code gone;  // where the signal came before the first step
    return std::filesystem::file_size(last, gone);
  };
  const auto size = size_now();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(size_now(), size);

  write("study.toml", quick);
  const Outcome resumed = study({"--resume"});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr("3 runs, 3 done already"));
}

INSTANTIATE_TEST_SUITE_P(By, Ended, testing::Values(SIGINT, SIGTERM, SIGKILL));

}  // namespace
}  // namespace gnomon::study_test
