// Steady rolling in space: creepages along and across and a spin, given or found by forces and a
// moment.
#include "stick/rolling_scenes.hpp"

namespace gnomon::rolling_in_space_test {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// Forces on the counter-body against the velocity and across it, and a moment about the normal.
std::string drives(double against, double across, double moment) {
  return fmt::format(R"toml(, {{ direction = [-1.0, 0.0, 0.0], force = {} }},
{{ direction = [0.0, 1.0, 0.0], force = {} }}, {{ moment = {}, axis = [0.0, 0.0, 1.0] }})toml",
                     against, across, moment);
}

std::string given(double along, double across, double spin) {
  return fmt::format("creepage = [{:.17g}, {:.17g}, 0.0], spin = {:.17g}", along, across, spin);
}

/// Creepages that two forces and a moment determine need these when they are given.
TEST_F(RollingScenes, ForcesAndAMomentInSpaceDetermineTheCreepages) {
  const auto driven = model(ball("", 0, drives(40, 20, -3)));
  Counters counters;
  const State found = driven->start(counters);
  const auto of = [&](const char* name) { return observed(*driven, found, name); };
  EXPECT_NEAR(of("torque_friction_z"), -3, 0.03);  // where nodes are deformed
  const auto back = model(ball(given(of("creepage_x"), of("creepage_y"), of("creepage_spin"))));
  const State start = back->start(counters);
  EXPECT_NEAR(observed(*back, start, "guide_x"), -40, 1e-5);
  EXPECT_NEAR(observed(*back, start, "guide_y"), 20, 1e-5);
  for (const char* name : {"torque_friction_z", "friction_power", "stick_area"})
    EXPECT_NEAR(observed(*back, start, name) / of(name), 1, 1e-6) << name;
  EXPECT_GT(of("friction_power"), 0);
  EXPECT_GT(of("stick_area"), 0);
}

TEST_F(RollingScenes, JacobianWithAMomentEqualsFiniteDifferences) {
  folder_.write("small.geo", R"(SetFactory("OpenCASCADE");
Box(1) = {-0.4, -0.4, -0.4, 0.8, 0.8, 0.4};
Transfinite Curve "*" = 4; Transfinite Surface "*"; Transfinite Volume {1}; Recombine Surface "*";
Physical Surface("bottom") = {5}; Physical Surface("surface") = {6}; Physical Volume("box") = {1};
)");
  const auto model = this->model(ball("", 0, drives(20, 10, -2)),
                                 {"mesh.file=small.geo", "wear.coefficient=1e-6"});
  const auto [y, branch] = near_the_start(*model);
  check_jacobian(model->system(), 0, y, 0.2, &branch, 1e-4);
}

/// A wheel on a rail, which alone wears.
std::string wheel() {
  std::string text = text_of(shipped("wheel_on_rail.toml"));
  const auto tread = text.find("[wear.surfaces.tread]");
  return text.erase(tread, text.find("[shape]") - tread);
}

/// Coarse; `drives` of the wheel, beside its velocity.
Overrides drives_of_wheel(const std::string& velocity, const Overrides& drives) {
  Overrides overrides = {"mesh.file=" + shipped("wheel_on_rail.geo").string(),
                         "mesh.factor=3.5",
                         "wear.on=[\"head\"]",
                         "motion.1.velocity=" + velocity,
                         "motion.1.axis=[0.0, 0.0, 1.0]",
                         "motion.1.center=[0.0, 0.0, 0.0]"};
  overrides.insert(overrides.end(), drives.begin(), drives.end());
  return overrides;
}

/// The wheel on the rail turns about its axle, 460 mm above; on a cone it also spins.
TEST_F(PairRolling, AWheelInSpaceTurnsAboutItsAxle) {
  std::string text = wheel(), tread = text_of(shipped("wheel_on_rail.geo"));
  const std::string velocity = "velocity = [20020.0, 0.0, 0.0]", cylinder = "cone = 0;";
  text.replace(text.find(velocity), velocity.size(),
               "rotation = -43.5217391304\ncenter = [0.0, 0.0, 460.0]\naxis = [0.0, 1.0, 0.0]");
  const Overrides overrides = {"mesh.file=" + shipped("wheel_on_rail.geo").string(),
                               "mesh.factor=3.5", "wear.on=[\"head\"]"};
  const auto model = this->model(text, overrides);
  Counters counters;
  EXPECT_NEAR(observed(*model, model->start(counters), "creepage_x"), 1e-3, 1e-6);
  EXPECT_THAT(model->remarks, Not(Contains(HasSubstr("about the normal of its contact"))));
  folder_.write("cone.geo", tread.replace(tread.find(cylinder), cylinder.size(), "cone = 0.05;"));
  const auto on_cone =
      this->model(text, {"mesh.file=cone.geo", "mesh.factor=3.5", "wear.on=[\"head\"]"});
  EXPECT_THAT(on_cone->remarks, Contains(HasSubstr("about the normal of its contact")));
}

/// Of the wheel on the rail.
TEST_F(PairRolling, ForcesAndAMomentInSpaceDetermineTheCreepages) {
  const auto driven = model(
      wheel(),
      drives_of_wheel("[20000.0, 0.0, 0.0]", {"motion.1.force=2000", "motion.1.force_across=-1000",
                                              "motion.1.moment=1500"}));
  Counters counters;
  const State found = driven->start(counters);
  const auto of = [&](const char* name) { return observed(*driven, found, name); };
  const auto back =
      model(wheel(),
            drives_of_wheel(fmt::format("[{:.17g}, {:.17g}, 0.0]", 2e4 * (1 + of("creepage_x")),
                                        2e4 * of("creepage_y")),
                            {fmt::format("motion.1.rotation={:.17g}", 2e4 * of("creepage_spin"))}));
  const State start = back->start(counters);
  for (const auto& [model, state] :
       {std::pair(driven.get(), &found), std::pair(back.get(), &start)}) {
    const auto between = model->examine(*state).pairs.at(0);
    EXPECT_NEAR(between.force[0], -2000, 1e-4);  // on the wheel
    EXPECT_NEAR(between.force[1], 1000, 1e-4);
    EXPECT_NEAR(between.torque[2], -1500, 1e-4);
  }
  for (const char* name : {"friction_power", "stick_area"})
    EXPECT_NEAR(observed(*back, start, name) / of(name), 1, 1e-6) << name;
}

TEST_F(PairRolling, AMomentIsAboutTheNormalAndNoMoreThanFrictionHolds) {
  const auto with = [](const Overrides& more, const std::string& axis = "[0.0, 0.0, 1.0]") {
    Overrides overrides = drives_of_wheel("[20000.0, 0.0, 0.0]", more);
    std::ranges::replace(overrides, "motion.1.axis=[0.0, 0.0, 1.0]", "motion.1.axis=" + axis);
    return overrides;
  };
  const std::string moment = "motion.1.moment=1e5";
  EXPECT_THAT(failed_start(wheel(), with({moment, "motion.1.force=1"})),
              HasSubstr("a moment of 1e+05 is more than friction holds about its axis, "));
  expect_refused(wheel(), with({moment}, "[0.0, 1.0, 0.0]"),
                 "motion.1.moment: expected an axis along the normal of the contact");
  expect_refused(wheel(), with({moment, "motion.1.rotation=1.0"}), "either a rotation or a moment");
  expect_refused(rolling_cap(1000), {"motion.1.moment=1.0"}, "none in the plane");
}

TEST_F(RollingScenes, WhatFrictionDoesNotHoldAboutTheNormalIsTold) {
  EXPECT_THAT(failed_start(ball("", 0, drives(1, 1, 30)), {}),
              HasSubstr("a moment of 30 is more than friction holds about its axis, "));
  const std::string moment = drives(1, 1, 1);
  expect_refused(ball("spin = 1e-3", 0, moment), {},
                 "none about the normal, as counter_body.press.4.moment determines it");
  expect_refused(ball("", 0, moment), {"counter_body.press.4.axis=[0.0, 1.0, 0.0]"},
                 "or an axis along the normal of the surface");
}

TEST_F(RollingScenes, ForcesThatFrictionDoesNotHoldTogetherAreTold) {
  EXPECT_THAT(failed_start(ball("", 0, drives(90, 90, 1)), {}),
              HasSubstr("but 127.3 is more than friction holds, f P = 12"));
}

TEST_F(PairRolling, MaterialThatDoesNotPassTheContactIsNamed) {
  const auto refused = [&](const Overrides& moves) {
    Overrides overrides = drives_of_wheel("[20000.0, 0.0, 0.0]", {"motion.1.force=0"});
    overrides.insert(overrides.end(), moves.begin(), moves.end());
    return refusal(wheel(), overrides);
  };
  EXPECT_THAT(refused({"motion.2.velocity=[0.0, 0.0, 0.0]"}),
              HasSubstr("motion.2.velocity: expected one other than zero where bodies roll"));
  EXPECT_THAT(refused({"motion.2.velocity=[0.0, 0.0, 2e4]"}),
              HasSubstr("motion.2.velocity: expected a velocity along the contact where bodies "
                        "roll, got one along its normal, (0, 0, 2e+04)"));
  EXPECT_THAT(refused({"motion.2.velocity=[0.0, 2e4, 0.0]"}),
              HasSubstr("motion.1.velocity: expected one by which \"wheel\" passes the contact "
                        "along the velocity of \"rail\", (0, 2e+04, 0), got (2e+04, 0, 0)"));
}

/// Along the velocity; across it inclined surfaces hold forces.
TEST_F(PairRolling, AForceInSpaceBeyondFrictionIsRefused) {
  const auto refused = [&](const std::string& force) {
    return refusal(wheel(), drives_of_wheel("[20000.0, 0.0, 0.0]", {force}));
  };
  EXPECT_THAT(
      refused("motion.1.force=-40000"),
      HasSubstr("key `pair.1.friction`: expected a larger coefficient: from t = 0 s on the force "
                "along the surface, 4e+04, is more than friction holds, f P = 6000"));
  EXPECT_EQ(refused("motion.1.force=-5000"), "");
}

TEST_F(RollingScenes, AForceInSpaceBeyondFrictionIsRefused) {
  expect_refused(ball("", 0, drives(130, 0, 0)), {},
                 "the force along the surface, 130, is more than friction holds, f P = 120");
}

/// However little: differences upwind are along lines of nodes.
TEST_F(PairRolling, AVelocityObliqueToTheLinesOfATreadIsRefused) {
  for (const std::string velocity : {"[20000.0, 20.0, 0.0]", "[20000.0, 4000.0, 0.0]"}) {
    const Overrides overrides = drives_of_wheel(velocity, {"motion.2.velocity=" + velocity});
    expect_refused(wheel(), overrides, "wear.surfaces.head.path");
    expect_refused(wheel(), overrides, "goes on for 0 mm: rolling goes along the lines");
  }
}

}  // namespace
}  // namespace gnomon::rolling_in_space_test
