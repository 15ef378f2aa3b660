// Steady rolling: Carter's creepage, wear alike along the surface, limits, derivatives and
// mistakes.
#include <gnomon/checks/checks.hpp>
#include <gnomon/model/wear_model.hpp>

#include "stick/rolling_scenes.hpp"

namespace gnomon::stick_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

// A rate that falls to zero with the sliding distance, velocity times creepage times time.
TEST_F(RollingScenes, ARateMayEndWithTheSlidingDistance) {
  const std::string rate = "wear.rate=\"k*p*v*max(1 - s/160, 0)\"";
  for (const char* creepage : {"", "creepage = [0.0, 0.0]"})
    expect_refused(cylinder(creepage), {rate}, "no sliding distance s, or also wear.velocity");
  const auto model = this->model(cylinder("creepage = [4e-4, 0.0]"),
                                 {"mesh.file=coarse.geo", rate, "integrator.events=locate"});
  Counters counters;
  const State start = model->start(counters);
  const double flux = observed(*model, start, "wear_flux");
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-6, 1000);
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume") / (flux * 400 / 2), 1, 1e-3);
}

TEST_F(RollingScenes, CartersCreepageTractionsAndPower) {
  const auto model = this->model(cylinder());
  Counters counters;
  const State start = model->start(counters);
  EXPECT_LE(counters.newton_iterations, 20);
  EXPECT_NEAR(observed(*model, start, "creepage_x") / Carter::creepage(), 1, 0.05);
  const double power = Carter::creepage() * Carter::Q * Carter::V;
  EXPECT_NEAR(observed(*model, start, "friction_power") / power, 1, 0.03);
  EXPECT_NEAR(observed(*model, start, "stick_area") / (2 * Carter::c()), 1, 0.1);
  const ContactSurface surface = model->contact(start).value();
  const auto traction = of_phase(surface, surface.phase_traction, 0, 0),
             slip = of_phase(surface, surface.phase_slip, 0, 0);
  int compared = 0;
  for (std::size_t c = 0; c < surface.node.size(); ++c) {
    const double x = surface.initial[c][0], edge = -Carter::a() + 2 * Carter::c();
    if (std::abs(x) > 0.9 * Carter::a() || std::abs(x - edge) < 0.1 * Carter::a()) continue;
    ++compared;
    EXPECT_NEAR(-traction[c], Carter::traction(x), 0.03 * Carter::p0()) << x;
    EXPECT_EQ(std::abs(slip[c]) > 1e-12, x > edge) << x;
  }
  EXPECT_GT(compared, 15);
}

/// The creepage that a force determines, given, needs that force; so does a counter-body that moves
/// slower by it.
TEST_F(RollingScenes, ForceAndCreepageDetermineEachOther) {
  const Found driven = found(cylinder());
  const Found given = found(cylinder(fmt::format("creepage = [{:.17g}, 0.0]", driven.creepage)));
  EXPECT_NEAR(given.force / Carter::Q, 1, 1e-8);
  EXPECT_NEAR(given.power / driven.power, 1, 1e-8);
  const std::string still = cylinder("#");
  const Found moved = found(still, {fmt::format("counter_body.motion.velocity=[{:.17g}, 0.0]",
                                                Carter::V * (1 - driven.creepage))});
  EXPECT_NEAR(moved.force / Carter::Q, 1, 1e-6);
  EXPECT_NEAR(moved.creepage / driven.creepage, 1, 1e-9);
}

/// A counter-body that stands still is slid on, at the speed of rolling; one that turns about its
/// axle has the velocity of its rim.
TEST_F(RollingScenes, TheMotionOfTheCounterBodyIsACreepage) {
  const Found locked = found(cylinder("#"), {"counter_body.motion.velocity=[0.0, 0.0]"});
  EXPECT_NEAR(locked.creepage, 1, 1e-12);
  EXPECT_NEAR(locked.power / (Carter::f * Carter::P * Carter::V), 1, 1e-3);
  const Found driven = found(cylinder());
  const Found turns =
      found(cylinder("#"), {fmt::format("counter_body.motion.rotation={:.17g}",
                                        Carter::V * (1 - driven.creepage) / Carter::R)});
  EXPECT_NEAR(turns.creepage / driven.creepage, 1, 1e-6);
  EXPECT_NEAR(turns.force / Carter::Q, 1, 1e-4);
  const Found from_afar =
      found(cylinder("#"), {fmt::format("counter_body.motion.rotation={:.17g}",
                                        Carter::V * (1 - driven.creepage) / Carter::R),
                            fmt::format("counter_body.center=[0.0, {}]", Carter::R + 0.5)});
  EXPECT_NEAR(from_afar.creepage / turns.creepage, 1, 1e-9);
}

/// Backwards, everything is the mirror image.
TEST_F(RollingScenes, RollingBackwardsIsTheMirrorImage) {
  const Found there = found(cylinder());
  const Found back = found(
      cylinder(), {"rolling.velocity=[-1000.0, 0.0]", "counter_body.press.2.direction=[1.0, 0.0]"});
  EXPECT_NEAR(back.creepage / there.creepage, -1, 1e-6);
  EXPECT_NEAR(back.power / there.power, 1, 1e-6);
}

TEST_F(RollingScenes, FarBeyondStickItSlides) {
  const double creepage = 20 * Carter::f * Carter::a() / Carter::R;
  const Found slides = found(cylinder(fmt::format("creepage = [{}, 0.0]", creepage)));
  EXPECT_EQ(slides.stick, 0);
  EXPECT_NEAR(slides.force / (Carter::f * Carter::P), 1, 1e-4);
  EXPECT_NEAR(slides.flux / (Carter::k * Carter::P * creepage * Carter::V), 1, 0.01);
}

/// The surface recedes as a whole: k times the power of friction by f, all along the path.
TEST_F(RollingScenes, TheDepthIsTheMeanOverThePath) {
  for (const char* method : {"esdirk-3", "erk-2", "bdf"}) {
    const auto model = this->model(cylinder());
    const ModelRun run = run_model(*model, method, 0, 1e-4, 1000);
    const double power = observed(*model, run.last(), "friction_power");
    const double area = Carter::k * power / Carter::f * 1000;
    EXPECT_NEAR(observed(*model, run.last(), "worn_volume") / area, 1, 1e-5) << method;
    EXPECT_NEAR(observed(*model, run.last(), "wear_depth") * Carter::path / area, 1, 1e-5);
  }
}

/// Finite strains with the same small slopes agree.
TEST_F(RollingScenes, LargeStrainsTendToSmallOnes) {
  const Found small = found(cylinder()), finite = found(cylinder(), {"body.material=neo-hookean"});
  EXPECT_NEAR(finite.creepage / small.creepage, 1, 0.05);
  EXPECT_NEAR(finite.power / small.power, 1, 0.03);
}

TEST_F(RollingScenes, SolversAgree) {
  EXPECT_NEAR(found(cylinder(), {"solver.method=direct"}).creepage /
                  found(cylinder(), {"solver.method=block"}).creepage,
              1, 1e-8);
}

TEST_F(RollingScenes, JacobianEqualsFiniteDifferences) {
  for (const char* material : {"linear", "neo-hookean"}) {
    const auto model =
        this->model(cylinder("", 0.3), {"mesh.file=coarse.geo", "wear.coefficient=1e-6",
                                        fmt::format("body.material={}", material)});
    const auto [y, branch] = near_the_start(*model);
    check_jacobian(model->system(), 0, y, 0.2, &branch, 1e-4);
  }
}

/// In space the ball is dragged along the creepage, and the force turns with it.
TEST_F(RollingScenes, ABallIsDraggedAlongTheCreepage) {
  const auto guide = [&](const std::string& rolling) {
    const auto model = this->model(ball(rolling));
    Counters counters;
    const State start = model->start(counters);
    return Vector<2>(observed(*model, start, "guide_x"), observed(*model, start, "guide_y"));
  };
  const Vector<2> lateral = guide("creepage = [0.0, 1e-3, 0.0]"),
                  opposite = guide("creepage = [0.0, -1e-3, 0.0]"),
                  sliding = guide("creepage = [0.3, 0.4, 0.0]"), spin = guide("spin = 2e-2");
  EXPECT_GT(std::abs(lateral[1]), 5);
  EXPECT_NEAR(opposite[1] / lateral[1], -1, 1e-6);
  EXPECT_NEAR(opposite[0] / lateral[0], 1, 1e-6);
  EXPECT_NEAR(sliding.norm() / (0.3 * 400), 1, 0.01);  // on the slopes of the ball
  EXPECT_NEAR(sliding[1] / sliding[0], 4.0 / 3, 0.02);
  EXPECT_GT(std::abs(spin[1]), 1);  // spin alone pushes sideways
  // It is about the place where the ball touches, a node beside the middle of the surface.
  const auto beside = this->model(ball("spin = 2e-2", 0.1));
  const Vector<3> centre =
      dynamic_cast<const WearModel<3>&>(*beside).assembly().interface.rolling->centre;
  EXPECT_LT((centre - Vector<3>(0.1, 0, 0)).norm(), 1e-9);
}

/// What has no friction does not wear.
TEST_F(RollingScenes, ContactWhereNoMaterialComesFromIsToldOf) {
  for (const char* material : {"linear", "neo-hookean"}) {
    const auto model =
        this->model(cylinder("creepage = [1e-3, 0.0]"),
                    {"counter_body.center=[-2.0, 6.0]", fmt::format("body.material={}", material)});
    Counters counters;
    const State start = model->start(counters);
    const Examination facts = model->examine(start);
    EXPECT_GT(facts.without_friction, 1e-3);
    EXPECT_THAT(doubts(facts), ::testing::Contains(HasSubstr("without friction")));
    EXPECT_EQ(observed(*model, start, "friction_power"), 0);
    EXPECT_EQ(observed(*model, start, "wear_flux"), 0) << material;
  }
}

/// Unlike bodies that roll freely creep by 0.915 beta a / R for small friction, far from where the
/// whole contact slips the same way (K. L. Johnson, Contact Mechanics, sec. 8.2).
TEST_F(RollingScenes, FreeRollingOfUnlikeBodiesIsFoundForSmallFriction) {
  constexpr double nu = 0.3, beta = (1 - 2 * nu) / (2 * (1 - nu));
  const double a = std::sqrt(4 * Carter::P * Carter::R * (1 - nu * nu) / (M_PI * Carter::E));
  for (const double friction : {0.002, 0.0005}) {
    const Found rolls = found(cylinder("", nu), {"counter_body.press.2.force=0",
                                                 fmt::format("friction.coefficient={}", friction)});
    EXPECT_NEAR(rolls.creepage * Carter::R / (beta * a), 0.915, 0.045) << friction;
    EXPECT_LT(std::abs(rolls.force), 1e-6 * friction * Carter::P);
  }
}

TEST_F(RollingScenes, AForceThatFrictionDoesNotBalanceIsRefused) {
  expect_refused(cylinder(), {"counter_body.press.2.force=12.0"},
                 "from t = 0 s on the force along the surface, 12, is more");
  expect_refused(
      cylinder(),
      {fmt::format("counter_body.press.2.force={}", Carter::Q),
       "counter_body.press.2.factors=[1.0, 3.0]", "counter_body.press.2.times=[0.0, 1000.0]"},
      fmt::format("from t = {:.4g} s", 500 * (1 / Carter::ratio - 1)));
}

TEST_F(RollingScenes, WhatDoesNotGoTogetherIsRefused) {
  expect_refused(cylinder(), {"rolling.creepage=[1e-3, 0.0]"}, "counter_body.press.2.direction");
  expect_refused(cylinder(), {"rolling.velocity=[0.0, 10.0]"}, "along the surfaces of wear.on");
  expect_refused(cylinder(), {"rolling.velocity=[0.0, 0.0]"}, "not zero");
  expect_refused(cylinder(), {"rolling.spin=1.0"}, "none in the plane");
  expect_refused(cylinder(), {"friction.coefficient=0"}, "above zero");
  const std::string moves = "counter_body.motion.velocity=[999.0, 0.0]";
  expect_refused(cylinder(), {moves}, "whose force determines it");
  expect_refused(cylinder("creepage = [1e-3, 0.0]"), {moves}, "none beside counter_body.motion");
  expect_refused(cylinder("#"), {"counter_body.motion.velocity=[999.0, 0.0, 1.0]"},
                 "none across the plane");
  expect_refused(cylinder(), {"friction.stick=false"}, "true or none");
  expect_refused(cylinder(), {"wear.surfaces.surface.path=0.01"}, "at least the length");
  expect_refused(cylinder(), {"cycle.period=1.0", "cycle.phases=4", "cycle.x=\"sin(2*pi*tau)\""},
                 "no [cycle]");
  std::string text = cylinder();
  text.replace(text.find(", surfaces"),
               std::string(", surfaces = { surface = { path = 100 } }").size(), "");
  expect_refused(text, {}, "expected also wear.surfaces.surface.path");
  text = cylinder("creepage = [1e-3, 0.0]");
  text.replace(text.find("velocity = [1000, 0.0]"), 22, "");
  expect_refused(text, {}, "expected also rolling.velocity");
}

}  // namespace
}  // namespace gnomon::stick_test
