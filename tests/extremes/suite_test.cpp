// gnomon extremes: every verdict, and a coarse subset of the shipped suite.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "study/study_fixture.hpp"

namespace gnomon::suite_test {
namespace {

using test::Outcome;
using ::testing::HasSubstr;

class Extremes : public test::StudyTest {
protected:
  Outcome extremes(const std::vector<std::string>& further = {}) const {
    std::vector<std::string> arguments = {"extremes", "study.toml", "-o", "out", "--jobs", "2"};
    arguments.insert(arguments.end(), further.begin(), further.end());
    return gnomon(arguments);
  }
  std::vector<test::Row> cases() const {
    return test::parse_csv(test::read_text(folder() / "out/extremes.csv"));
  }
  std::string verdict(std::size_t row = 0) const { return cases().at(row).at("verdict"); }
  /// Fast references with low accuracy.
  static std::string references(const std::string& first, const std::string& second) {
    return "[[reference]]\nintegrator = \"esdirk-4\"\ntolerances = " + first +
           "\n[[reference]]\nintegrator = \"bdf\"\ntolerance = " + second + "\n";
  }
};

TEST_F(Extremes, WhatTheReferencesConfirmAgrees) {
  write("study.toml", head() + references("1e-7", "1e-7") + method("bdf", "tolerance = 1e-3") +
                          method("backward-euler", "steps = 50"));
  const Outcome outcome = extremes();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("2 cases: 2 agrees"));
  for (const test::Row& row : cases()) {
    EXPECT_EQ(row.at("verdict"), "agrees") << row.at("reason");
    EXPECT_GT(std::stod(row.at("difference")), 0);
    EXPECT_LE(std::stod(row.at("difference")), std::stod(row.at("bound")));
  }
  const auto json = nlohmann::json::parse(test::read_text(folder() / "out/extremes.json"));
  ASSERT_EQ(json["rows"].size(), 2u);
  EXPECT_EQ(json["rows"][0]["values"]["verdict"], "agrees");
  EXPECT_EQ(json["rows"][0]["values"]["difference"], std::stod(cases()[0].at("difference")));
  EXPECT_EQ(json["rows"][1]["values"]["rtol"], nullptr);
  EXPECT_EQ(extremes().exit_code, 2);  // the folder exists already
  EXPECT_EQ(extremes({"--resume"}).exit_code, 0);
}

// One step for the whole wear of a stiff pin: the shape is nearly right.
TEST_F(Extremes, APressureThatDiffersIsSaid) {
  write("study.toml", head() + references("1e-5", "1e-5") +
                          "[[sweep]]\nkey = \"wear.coefficient\"\nvalues = [1e-8, 1e-6]\n" +
                          method("esdirk-4", "steps = [100]"));
  EXPECT_EQ(extremes().exit_code, 0);
  const auto pressure = [&](std::size_t row) {
    return std::stod(cases().at(row).at("pressure_difference"));
  };
  EXPECT_GT(pressure(0), 0);
  EXPECT_LT(pressure(0), 0.05);
  EXPECT_EQ(cases().at(0).at("reason"), "");
  EXPECT_GT(pressure(1), 0.5);
  EXPECT_THAT(cases().at(1).at("reason"), HasSubstr("a nodal pressure differs by"));
}

TEST_F(Extremes, WhatTheyDoNotIsWrong) {
  write("study.toml",
        head() + references("0.1", "0.1") + method("esdirk-5", "tolerances = [1e-7]"));
  const Outcome outcome = extremes();
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("1 of 1 cases are wrong, hung or crashed"));
  EXPECT_EQ(verdict(), "wrong");
  EXPECT_THAT(cases()[0].at("reason"), HasSubstr("the references differ"));
}

TEST_F(Extremes, AnImpossibleRunIsRefused) {
  write("study.toml", head() + references("1e-3", "1e-3") +
                          method("bdf", "tolerances = [1e-3]", "set.body.poisson_ratio = 0.5") +
                          method("theta", "steps = [50]", "set.pin.height = 2.5"));
  const Outcome outcome = extremes();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(verdict(0), "refused");
  EXPECT_THAT(cases()[0].at("reason"), HasSubstr("body.poisson_ratio"));
  EXPECT_EQ(verdict(1), "refused");
  EXPECT_THAT(cases()[1].at("reason"), HasSubstr("pin.height"));
}

// Its scene lies in a folder of its own, to which the mesh is not relative.
TEST_F(Extremes, AnImpossibleRunHasTheMeshOfItsScene) {
  const std::string parts = GNOMON_SOURCE_DIR "/problems/worn_body/";
  write("pin.geo", test::read_text(parts + "pin.geo"));
  write("scene.toml", test::read_text(parts + "pin.toml"));
  write("study.toml", "scene = \"scene.toml\"\n" + references("1e-3", "1e-3") +
                          method("bdf", "tolerances = [1e-3]", "set.body.poisson_ratio = 0.5"));
  const Outcome outcome = extremes();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(verdict(0), "refused");
  EXPECT_THAT(cases()[0].at("reason"), HasSubstr("body.poisson_ratio"));
}

TEST_F(Extremes, AMistakeInTheFileIsNotACase) {
  write("study.toml", head() + "[[sweep]]\nkey = \"body.poisson_rato\"\nvalues = [0.5]\n" +
                          method("bdf", "tolerances = [1e-3]"));
  EXPECT_EQ(extremes().exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder() / "out"));
}

TEST_F(Extremes, TimesBeyondTheEndOrTooNearAreAMistakeInTheFile) {
  write("study.toml", "times = [50, 200]\n" + head() + method("bdf", "tolerances = [1e-3]"));
  const Outcome outcome = extremes();
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err,
              HasSubstr("key `times`: expected times up to time.end = 100 s, got 200"));
  write("study.toml", "times = [50, 50.0000001]\n" + head() + method("bdf", "tolerances = [1e-3]"));
  EXPECT_THAT(
      extremes().err,
      HasSubstr(
          "key `times`: expected times (including time.end) at least 1e-05 of their value apart"));
}

TEST_F(Extremes, OneReferenceConfirmsAloneAndIsNamed) {
  write("study.toml", head() + references("1e-5", "1e-5") + "set.load.force = 1e9\n" +
                          method("bdf", "tolerances = [1e-3]"));
  EXPECT_EQ(extremes().exit_code, 0);
  EXPECT_EQ(verdict(), "agrees");
  EXPECT_THAT(cases()[0].at("reason"), HasSubstr("by one reference: esdirk-4 rtol 1e-5"));
}

TEST_F(Extremes, ResumingDoesNotDropTheCasesOfOtherStudies) {
  write("study.toml", head() + references("1e-3", "1e-3") + method("bdf", "tolerances = [1e-3]"));
  ASSERT_EQ(extremes().exit_code, 0);
  std::filesystem::rename(folder() / "study.toml", folder() / "other.toml");
  const std::string before = test::read_text(folder() / "out/extremes.csv");
  const Outcome outcome = gnomon({"extremes", "other.toml", "-o", "out", "--resume"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("holds study \"study\""));
  EXPECT_EQ(test::read_text(folder() / "out/extremes.csv"), before);
}

TEST_F(Extremes, EarlierResultsAreNoStudies) {
  write("study.toml", head() + references("1e-3", "1e-3") + method("bdf", "tolerances = [1e-3]"));
  ASSERT_EQ(extremes().exit_code, 0);
  std::filesystem::create_directory(folder() / "studies");
  write("studies/study.toml", "scene = \"../scene.toml\"\n" + head().substr(head().find('\n') + 1) +
                                  references("1e-3", "1e-3") +
                                  method("bdf", "tolerances = [1e-3]"));
  std::filesystem::rename(folder() / "out", folder() / "studies/out");
  const Outcome outcome = gnomon({"extremes", "studies", "-o", "again"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("1 cases: 1 agrees"));
}

TEST_F(Extremes, ABodyTooSoftIsStopped) {
  write("study.toml", head() + references("1e-3", "1e-3") +
                          method("bdf", "tolerances = [1e-3]", "set.body.young_modulus = 0.5"));
  EXPECT_EQ(extremes().exit_code, 0);
  EXPECT_EQ(verdict(), "stopped");
  EXPECT_THAT(cases()[0].at("reason"), HasSubstr("load fraction"));
}

TEST_F(Extremes, AnEndlessRunHangs) {
  write("study.toml",
        head() + references("1e-3", "1e-3") + method("backward-euler", "steps = [1e-5]"));
  EXPECT_EQ(extremes({"--limit", "1"}).exit_code, 1);
  EXPECT_EQ(verdict(), "hung");
}

TEST_F(Extremes, AFolderOfSomethingElseIsRefused) {
  write("study.toml", head() + method("bdf", "tolerances = [1e-3]"));
  std::filesystem::create_directory(folder() / "out");
  write("out/precious.txt", "mine");
  EXPECT_EQ(extremes({"--resume"}).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder() / "out/extremes.csv"));
}

// No fault, and the numbers of verdicts as in docs/notes/extremes.md.
TEST_F(Extremes, TheCoarseSubsetHasNoFaults) {
  const Outcome outcome =
      gnomon({"extremes", GNOMON_SOURCE_DIR "/problems/pin_on_flat/extremes/coarse.toml",
              GNOMON_SOURCE_DIR "/problems/pin_on_flat/extremes/impossible.toml", "-o", "out",
              "--jobs", "2"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  std::map<std::string, int> counts;
  for (const test::Row& row : cases()) ++counts[row.at("verdict")];
  EXPECT_EQ(counts["refused"], 19);
  EXPECT_EQ(counts["stopped"], 10);
  EXPECT_EQ(counts["agrees"], 14);
}

}  // namespace
}  // namespace gnomon::suite_test
