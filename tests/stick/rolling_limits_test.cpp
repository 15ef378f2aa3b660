// Steady rolling under forces along the surface: what depth is expected, and where friction ends.
#include <gnomon/checks/checks.hpp>
#include <gnomon/run/run.hpp>

#include "stick/rolling_scenes.hpp"

namespace gnomon::rolling_limits_test {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr const char* coarse = "mesh.file=coarse.geo";

/// As a run ends by the settings of error control.
RunOutcome ended(const Model& model) {
  return run(model, Integrators::find("esdirk-3", "integrator"),
             controlled_settings(model, 1e-3, 1000), {}, nullptr, {});
}

std::string force_of_cap(double part) {
  return fmt::format("motion.1.force={:.17g}", part * 0.3 * Mindlin::P);
}

/// Tolerances are a part of the depth that is expected: about that which comes.
void expect_fit(const Model& model, const std::string& scene) {
  const RunOutcome end = ended(model);
  ASSERT_EQ(end.status, RunOutcome::Status::finished) << end.diagnosis;
  const double depth = value_of(end.last->scalars, "wear_depth").value();
  std::printf("%s: %.3g of the depth is expected\n", scene.c_str(),
              model.differential_scale / depth);
  EXPECT_LT(model.differential_scale / depth, 2) << scene;
  EXPECT_GT(model.differential_scale / depth, 0.5) << scene;
}

TEST_F(RollingScenes, TheDepthIsExpectedThatForcesWear) {
  for (const double part : {0.4, 0.6, 0.9})
    expect_fit(*model(cylinder(), {coarse, fmt::format("counter_body.press.2.force={:.17g}",
                                                       part * Carter::f * Carter::P)}),
               fmt::format("{} f P", part));
}

TEST_F(PairRolling, TheDepthIsExpectedThatForcesWear) {
  for (const double part : {0.4, 0.6, 0.9})
    expect_fit(*model(rolling_cap(1000), {force_of_cap(part)}), fmt::format("{} f P", part));
}

/// Friction falls steadily to the force along the surface at 800 s, by a text of which only a run
/// knows that.
constexpr const char* falls = "friction.factor=\"1 - t/2000 + 0*h\"";

void expect_end_of_friction(const Model& model, double force, double full_slip) {
  const RunOutcome end = ended(model);
  EXPECT_EQ(end.status, RunOutcome::Status::failed);
  EXPECT_THAT(end.diagnosis,
              AllOf(HasSubstr(fmt::format("along the surface, {:.2g}", force - 0.04)),
                    HasSubstr("reaches what friction holds, f P = ")));
  EXPECT_GT(end.last->t, 790);
  EXPECT_LT(end.last->t, 800.1);
  EXPECT_LT(value_of(end.last->scalars, "creepage_x").value(), 1.2 * full_slip);
  EXPECT_LT(end.counters.newton_iterations, 1000);
}

TEST_F(RollingScenes, ARunEndsWhereFrictionDoes) {
  expect_end_of_friction(*model(cylinder(), {coarse, falls}), Carter::Q,
                         Carter::f * Carter::a() / Carter::R);
}

TEST_F(PairRolling, ARunEndsWhereFrictionDoes) {
  folder_.write("coarse_rail.geo", rail(two_half_planes(8, 5, 2.4)));
  expect_end_of_friction(
      *model(rolling_cap(1000), {"mesh.file=coarse_rail.geo", force_of_cap(0.6), falls}),
      0.6 * 0.3 * Mindlin::P, 0.3 * Mindlin::a() / Mindlin::R);
}

/// The load, or friction, falls steadily to a half in 1000 s: at 800 s it is 0.6 of the first one.
TEST_F(RollingScenes, FrictionThatEndsAtAKnownTimeIsRefused) {
  expect_refused(
      cylinder(), {"friction.factor=\"1 - t/2000\""},
      "from t = 800 s on the force along the surface, 6.66, is more than friction holds");
  EXPECT_EQ(refusal(cylinder(), {"friction.factor=\"1 - t/2600\""}), "");
}

TEST_F(PairRolling, FrictionThatEndsAtAKnownTimeIsRefused) {
  const std::string force = force_of_cap(0.6),
                    message =
                        "from t = 800 s on the force along the surface, 3.33, is more than "
                        "friction holds, f P = 3.33";
  expect_refused(rolling_cap(1000), {force, "friction.factor=\"1 - t/2000\""}, message);
  expect_refused(rolling_cap(1000), {force, "load.1.times=[0, 1000]", "load.1.factors=[1.0, 0.5]"},
                 message);
  expect_refused(rolling_cap(1000), {"motion.2.force=-6.0"}, "pair.1.friction");
  EXPECT_EQ(
      refusal(rolling_cap(1000), {force, "load.1.times=[0, 1000]", "load.1.factors=[1.0, 0.61]"}),
      "");
}

/// What a scene does not tell is found at the start.
TEST_F(RollingScenes, AForceThatFrictionDoesNotBalanceIsToldAtTheStart) {
  EXPECT_THAT(failed_start(cylinder(), {coarse, "counter_body.press.2.force=12.0",
                                        "friction.factor=\"1 - 0*h\""}),
              HasSubstr("on it, but 12 is more than friction holds, f P = 11.1"));
}

/// Forces add up as vectors.
TEST_F(RollingScenes, AForceNearlyAlongTheSurfaceIsTheSumOfItsParts) {
  constexpr double slope = 0.05;
  const double along = Carter::Q / std::sqrt(1 + slope * slope);
  const Found inclined =
      found(cylinder(), {fmt::format("counter_body.press.2.direction=[-1.0, {}]", -slope)});
  const Found parts = found(
      cylinder(), {fmt::format("counter_body.press.1.force={:.17g}", Carter::P + slope * along),
                   fmt::format("counter_body.press.2.force={:.17g}", along)});
  EXPECT_NEAR(inclined.creepage / parts.creepage, 1, 1e-3);
  EXPECT_NEAR(inclined.power / parts.power, 1, 1e-3);
}

TEST_F(RollingScenes, AForceBetweenTheSurfaceAndTheLoadIsRefused) {
  expect_refused(cylinder(), {"counter_body.press.2.direction=[-1.0, -1.0]"},
                 "counter_body.press.2.direction: expected a direction along the surface, or that "
                 "of counter_body.press.1");
}

TEST_F(PairRolling, BodiesThatPartAreRefused) {
  expect_refused(rolling_cap(1000), {"motion.1.velocity=[1000.25, 1.0]"},
                 "motion.1.velocity: expected a velocity along the line of that of motion.2");
  EXPECT_EQ(refusal(rolling_cap(1000), {"motion.1.velocity=[1000.25, 1e-7]"}), "");
}

}  // namespace
}  // namespace gnomon::rolling_limits_test
