// Two bodies in steady rolling: Carter's and unlike rollers, wear of both, derivatives, limits.
#include <gnomon/checks/checks.hpp>
#include <gnomon/linear/jacobian_block.hpp>

#include "stick/rolling_scenes.hpp"

namespace gnomon::pair_rolling_test {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::HasSubstr;

/// Similar bodies: stick of half width b = a - creepage R / f at the leading edge (F. W. Carter).
TEST_F(PairRolling, SimilarBodiesCreepAsCarters) {
  constexpr double f = 0.3, creepage = 5e-4, V = 1000;
  const auto model = this->model(rolling_cap(V * (1 + creepage)), {});
  Counters counters;
  const State start = model->start(counters);
  const double a = Mindlin::a(), b = a - creepage * Mindlin::R / f;
  const double Q = f * Mindlin::P * (1 - b * b / (a * a));
  const double power = observed(*model, start, "friction_power");
  EXPECT_NEAR(observed(*model, start, "stick_area") / (2 * b), 1, 0.05);
  // A tenth of a on blocks of 56 a: -9 %; on 560 a -4.4 %, at a 24th of a -0.07 %.
  EXPECT_NEAR(power / (creepage * Q * V), 1, 0.1);
  EXPECT_NEAR(observed(*model, start, "wear_flux") / (1e-9 * power / f), 1, 1e-6);
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 1000);
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume") / (1e-9 * power / f * 1000), 1, 1e-3);
}

/// Without creepage similar bodies exert no friction on each other.
TEST_F(PairRolling, SimilarBodiesRollFreely) {
  const auto model = this->model(rolling_cap(1000), {});
  Counters counters;
  const State start = model->start(counters);
  const ContactSurface surface = model->contact(start).value();
  // Most at the node that enters: a gap on a slope counts as a shift until it is closed.
  for (std::size_t c = 0; c < surface.node.size(); ++c)
    EXPECT_NEAR(surface.phase_traction[2 * c], 0, 0.07 * 0.3 * Mindlin::p0());
  EXPECT_LT(observed(*model, start, "friction_power"), 1e-3 * 0.3 * Mindlin::P * 0.5);
}

TEST_F(PairRolling, FarBeyondStickItSlides) {
  const auto model = this->model(rolling_cap(1020), {});
  Counters counters;
  EXPECT_NEAR(observed(*model, model->start(counters), "friction_power") / (0.3 * Mindlin::P * 20),
              1, 0.02);
}

/// The cap, whose surface is curved, is the slave then. Its track is half as long, so that it wears
/// twice as deep.
TEST_F(PairRolling, BothSurfacesWearAlongTheirTracks) {
  folder_.write("both.geo", rail_and_tread(two_half_planes(16, 14, 1.32)));
  const auto model = this->model(rolling_cap(1020) + "[wear.surfaces.tread]\npath = 50.0\n",
                                 {"mesh.file=both.geo", "wear.on=[\"face\", \"tread\"]"});
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 1000);
  const double worn = 1e-9 * Mindlin::P * 20 * 1000;
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume_cap") / worn, 1, 0.02);
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume_cap") /
                  observed(*model, run.last(), "worn_volume_flat"),
              1, 1e-3);
  const ContactSurface surface = model->contact(run.last()).value();
  EXPECT_NEAR(std::ranges::max(surface.wear_depth) / (worn / 50), 1, 5e-3);
}

/// A force on either body finds the creepage that makes it, and the opposite one its mirror image.
TEST_F(PairRolling, AForceFindsItsCreepage) {
  constexpr double creepage = 5e-4;
  Counters counters;
  const auto given = this->model(rolling_cap(1000 * (1 + creepage)), {});
  const double power = observed(*given, given->start(counters), "friction_power");
  const double force = observed(*given, given->start(counters), "force_support_3_x");
  const auto found = [&](const std::string& body, double of) {
    const auto model =
        this->model(rolling_cap(1000), {fmt::format("motion.{}.force={:.15g}", body, of)});
    const State start = model->start(counters);
    EXPECT_NEAR(std::abs(observed(*model, start, "force_support_3_x") / of), 1, 1e-8);
    return std::pair(observed(*model, start, "creepage_x"),
                     observed(*model, start, "friction_power"));
  };
  const auto [driven, driven_power] = found("1", force);
  EXPECT_NEAR(driven / creepage, 1, 1e-3);  // by the velocity of the one body or of the other
  EXPECT_NEAR(driven_power / power, 1, 1e-3);
  const auto [beside, beside_power] = found("2", -force);
  EXPECT_NEAR(beside / driven, 1, 1e-8);
  EXPECT_NEAR(beside_power / driven_power, 1, 1e-8);
  EXPECT_NEAR(found("1", -force).first / driven, -1, 0.03);
}

/// Half-planes of nu = 0.3, one with ten times the modulus: beta of Dundurs is 0.234. With large
/// friction nearly all sticks, and the softer one rolls freely with 0.644 beta a / R more than the
/// other (tools/validation/unlike_rollers.py; 2 / pi where tractions leave the pressure alone).
/// With 0.3 beta there are three zones of slip, the middle one opposite (R. H. Bentall, K. L.
/// Johnson).
TEST_F(PairRolling, UnlikeBodiesCreepWhereTheyRollFreely) {
  constexpr double beta = 0.2338, modulus = 1 / (0.91 / 2e4 + 0.91 / 2e5);
  const double a = Mindlin::a(), by_R = a / Mindlin::R, P = M_PI * modulus * a * by_R / 4;
  const auto rolls = [&](double creepage, double friction) {
    return this->model(rolling_cap(1000 * (1 + creepage * by_R)),
                       {"body.1.young_modulus=2e4", fmt::format("pair.1.friction={}", friction),
                        fmt::format("load.1.force=[0.0, {:.17g}]", -P)});
  };
  const auto force_on_sides = [](const Model& model, const State& state) {
    return observed(model, state, "force_support_3_x");
  };
  {
    const auto model = this->model(
        rolling_cap(1000), {"body.1.young_modulus=2e4", "pair.1.friction=0.5", "motion.1.force=0",
                            fmt::format("load.1.force=[0.0, {:.17g}]", -P)});
    Counters counters;
    EXPECT_NEAR(observed(*model, model->start(counters), "creepage_x") / by_R / (0.644 * beta), 1,
                0.03);
  }

  // From cold with much friction, where the tangential multiplier may not be too stiff.
  const auto sticky = rolls(0.05, 2);
  Counters of_sticky;
  EXPECT_GT(observed(*sticky, sticky->start(of_sticky), "stick_area"), 1.7 * a);

  constexpr double friction = 0.07, free = 0.1791;  // creepage by a / R, from there
  const auto model = rolls(free, friction);
  Counters counters;
  const State start = model->start(counters);
  EXPECT_NEAR(force_on_sides(*model, start) / (friction * P), 0, 0.06);
  const ContactSurface surface = model->contact(start).value();
  const auto slip = of_phase(surface, surface.phase_slip, 0, 0);
  const auto of_zone = [&](double from, double to) {
    double sum = 0;
    for (std::size_t c = 0; c < slip.size(); ++c)
      if (const double x = surface.initial[c][0] / a; x > from && x < to) sum += slip[c];
    return sum;
  };
  const double entering = of_zone(-1, -0.7), middle = of_zone(0.5, 0.75),
               leaving = of_zone(0.92, 1);
  EXPECT_GT(std::abs(middle), 1e-9);
  EXPECT_LT(entering * middle, 0);
  EXPECT_LT(leaving * middle, 0);
  EXPECT_LT(std::abs(of_zone(-0.5, 0.3)), 1e-6 * std::abs(middle));
}

/// With little force nothing slips on a coarse mesh, and nothing wears.
TEST_F(PairRolling, FrictionWithoutThePowerOfWhatDrivesSimilarBodiesIsTold) {
  for (const double young : {2e5, 1e5})
    for (const double force : {0.4, 2.5}) {
      const auto model = this->model(rolling_cap(1000),
                                     {fmt::format("motion.1.force={}", force), "mesh.factor=1.5",
                                      fmt::format("body.1.young_modulus={}", young)});
      Counters counters;
      const State start = model->start(counters);
      const double driving = std::abs(observed(*model, start, "force_support_3_x") *
                                      observed(*model, start, "creepage_x") * 1000),
                   part = observed(*model, start, "friction_power") / driving;
      if (force < 1) EXPECT_LT(part, 0.9);
      const bool similar = young == 2e5;
      const Examination facts = model->examine(start);
      // The force along the contact has a part of the pressures, on slopes.
      EXPECT_NEAR(facts.power_by_driving, similar ? part : 1, 2e-3);
      const std::vector<std::string> found = doubts(facts);
      const std::string said =
          part < 1e-6 ? "all that rolls sticks" : "times the power of what drives it";
      EXPECT_EQ(std::ranges::count_if(found,
                                      [&said](const std::string& doubt) {
                                        return doubt.find(said) != std::string::npos;
                                      }),
                similar && std::abs(part - 1) > 0.1);
    }
}

/// Of a tread on a soft core what the forces do is no power of friction: it bends in the contact.
TEST_F(PairRolling, ALayeredBodyIsNotSimilarToAnother) {
  std::string bodies = rail(two_half_planes(6, 5, 2.2, 0.12));
  bodies.replace(bodies.find("(\"cap\") = {21, 22, 23, 24}"), 26,
                 "(\"cap\") = {21, 22, 24}; Physical Surface(\"core\") = {23}");
  folder_.write("layers.geo", bodies);
  std::string text = rolling_cap(1000);
  text.replace(text.find("{ name = \"flat\""), 0,
               "{ name = \"core\", young_modulus = 2e5, poisson_ratio = 0.3, material = "
               "\"linear\" }, ");
  const auto part = [&](const std::string& modulus) {
    const auto model = this->model(
        text, {"mesh.file=layers.geo", "motion.1.force=2.5", "body.2.young_modulus=" + modulus});
    Counters counters;
    return model->examine(model->start(counters)).power_by_driving;
  };
  EXPECT_NE(part("2e5"), 1);
  EXPECT_EQ(part("2e3"), 1);
}

TEST_F(PairRolling, ThatAllSticksIsTold) {
  EXPECT_THAT(doubts({.power_by_driving = -3.5e-14}), Contains(HasSubstr("all that rolls sticks")));
}

/// A disc of 6 mm radius in its unrolled frame: R^2 falls in proportion to time where the law has
/// the path that is left, and the depth does without.
TEST_F(PairRolling, TheSquareOfTheRadiusFallsSteadily) {
  constexpr double R = 6, depth = 0.6, time = 1000, path = 2 * M_PI * R;
  const double k = depth * path / (Mindlin::P * 20 * time);  // full slip at a creepage of 0.02
  const std::vector<std::pair<std::string, double>> laws = {
      {"k * p * v", depth}, {"k * p * v / (1 - h / 6)", R - std::sqrt(R * R - 2 * R * depth)}};
  for (const auto& [law, expected] : laws) {
    const auto model =
        this->model(rolling_cap(1020), {fmt::format("wear.rate=\"{}\"", law),
                                        fmt::format("wear.coefficient={:.17g}", k),
                                        fmt::format("wear.surfaces.face.path={:.17g}", path)});
    const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, time);
    EXPECT_NEAR(observed(*model, run.last(), "wear_depth") / expected, 1, 3e-3) << law;
    const Examination facts = model->examine(run.last());
    EXPECT_NEAR(facts.worn_radius, expected / R, 3e-3 * expected / R);
    EXPECT_THAT(doubts(facts), Contains(HasSubstr("radius of a roller with this path has worn")));
  }
}

TEST_F(PairRolling, WhatDoesNotGoTogetherIsRefused) {
  std::string text = rolling_cap(1000);
  expect_refused(text, {"motion.1.force=1", "motion.2.force=1"}, "a force on one of the two");
  expect_refused(text, {"motion.1.force_across=1"}, "none in the plane");
  expect_refused(text, {"motion.1.rotation=1", "motion.1.center=[0.0, 0.0]"},
                 "either a rotation about");
  expect_refused(text, {"shape.constraint=multiplier"}, "where bodies roll");
  expect_refused(text, {"pair.1.friction=0"}, "a coefficient above zero where bodies roll");
  expect_refused(text, {"motion.1.velocity=[0.0, 0.0]"},
                 "motion.1.velocity: expected one other than zero where bodies roll");
  text.erase(text.find("[wear.surfaces.face]"));
  expect_refused(text, {}, "expected also wear.surfaces.face.path");
}

}  // namespace
}  // namespace gnomon::pair_rolling_test
