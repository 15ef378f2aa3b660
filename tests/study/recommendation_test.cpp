// What a study advises.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "study/study_fixture.hpp"
#include "study/table.hpp"

namespace gnomon::recommendation_test {
namespace {

using ::testing::HasSubstr;
using ::testing::SizeIs;

StudyRow row(double error, double cpu, long steps) {
  StudyRow made;
  made.point.setting.kind = StudySetting::Kind::tolerance;
  made.shape_error = error;
  made.end.emplace().cpu_seconds = cpu;
  made.counters = Counters{};
  made.counters->steps = steps;
  return made;
}

/// Of a wear of 2, whose reference has an error of 1e-3.
StudyTable table() {
  StudyTable made;
  made.references.resize(1);
  made.references[0].error = 1e-3;
  made.references[0].wear = 2;
  made.rows = {row(1.9e-2, 1, 40), row(1.0e-2, 2, 40), row(1.0e-3, 5, 40), row(0.5e-3, 4, 40)};
  return made;
}

TEST(Recommendations, AreTheCheapestRunsOfEachAccuracy) {
  const auto found = study::recommendations(table());
  ASSERT_THAT(found, SizeIs(3));
  EXPECT_EQ(found[0].error, 1e-2);
  EXPECT_EQ(found[0].row, 0u);            // 1.9e-2 + 1e-3 is just 1e-2 of the wear
  EXPECT_EQ(found[1].row, 3u);            // the more accurate one is cheaper
  EXPECT_EQ(found[2].row, std::nullopt);  // not even the reference is known so well
  StudyTable unknown = table();
  unknown.references[0].error.reset();
  EXPECT_THAT(study::recommendations(unknown), SizeIs(0));
}

TEST(Recommendations, TimesThatHideTheTolerancesAreNamed) {
  Study study;
  study.sweep.resize(1);
  study.sweep[0].times = {1, 2, 3, 4, 5};
  StudyTable made = table();
  EXPECT_EQ(study::hidden_tolerances(study, made), "");
  for (std::size_t i = 0; i < 3; ++i) made.rows[i].counters->steps = 8;
  EXPECT_THAT(study::hidden_tolerances(study, made),
              HasSubstr("3 of 4 runs with a tolerance take less than 2 steps between two"));
}

class Advice : public test::StudyTest {};

// Both runs are far more accurate than 1e-2 of the wear, by steps that the five times cut.
TEST_F(Advice, EndsAStudy) {
  write("study.toml", head() + method("esdirk-3", "tolerances = [1e-1, 3e-2]"));
  const test::Outcome outcome = study();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\nrecommended:\nsweep  error / wear  cheapest run"));
  EXPECT_THAT(outcome.out, HasSubstr("esdirk-3 rtol"));
  const nlohmann::json advice = json()["recommendations"];
  ASSERT_THAT(advice, SizeIs(3));
  EXPECT_EQ(advice[0]["error"], 1e-2);
  EXPECT_EQ(json()["rows"][advice[0]["row"].get<std::size_t>()]["values"]["integrator"],
            "esdirk-3");
}

}  // namespace
}  // namespace gnomon::recommendation_test
