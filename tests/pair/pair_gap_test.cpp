// Wear as a gap of two bodies: what it keeps of the moving mesh, and what it adds.

#include <gnomon/model/gap_motion.hpp>
#include <gnomon/model/magnitudes.hpp>

#include "support/derivatives.hpp"
#include "support/problem_run.hpp"
#include "support/two_bodies.hpp"

namespace gnomon::pair_gap_test {
namespace {

using namespace testing;

/// Blocks with waves on meshes that match, closed throughout.
TwoBodies closed_waves(double upper, double lower) {
  TwoBodies pair{.upper = {.along = 8, .high = 5, .wear = upper},
                 .lower = {.along = 8, .high = 5, .wear = lower},
                 .force = 60};
  pair.kinematics = Kinematics::small;
  pair.upper.surface = [](double x) { return 0.01 * std::cos(M_PI * x); };
  return pair;
}

AssemblyParts<2> with_gap(const TwoBodies& pair) {
  AssemblyParts<2> parts = two_bodies<2>(pair);
  parts.following = parts.shape;
  parts.shape = gap_motion(parts);
  parts.condensed = true;
  return parts;
}

struct Ended {
  double pressure;
  std::array<double, 2> depth;  ///< of the upper and of the lower body
  std::optional<GapError> error;
};

Ended run_of(const AssemblyParts<2>& parts) {
  const WearModel<2> model(parts);
  const State end = run_model(model, "esdirk-4", 10, 0, 100).last();
  const ContactSurface surface = model.contact(end).value();
  const Model& abilities = model;
  Ended result{*value_of(model.observe(end), "max_pressure"), {}, abilities.examine(end).gap_error};
  for (std::size_t c = 0; c < surface.node.size(); ++c) {
    double& depth = result.depth[model.assembly().carries[c] ? 0 : 1];
    depth = std::max(depth, surface.wear_depth[c]);
  }
  return result;
}

// Both depths are in the gap, so that pressures see their sum alone; they divide as the
// coefficients do. The normal of the contact is that of the slave, so that this is exact to the
// square of the slope.
TEST(PairGap, OnlyTheSumOfTheCoefficientsMatters) {
  const Ended both = run_of(with_gap(closed_waves(1.5e-6, 0.5e-6))),
              upper = run_of(with_gap(closed_waves(2e-6, 0))),
              lower = run_of(with_gap(closed_waves(0, 2e-6)));
  ASSERT_GT(upper.depth[0], 5e-3);
  for (const Ended& one : {upper, lower}) EXPECT_NEAR(both.pressure / one.pressure, 1, 1e-3);
  EXPECT_NEAR((both.depth[0] + both.depth[1]) / upper.depth[0], 1, 1e-3);
  EXPECT_NEAR(lower.depth[1] / upper.depth[0], 1, 1e-3);
  EXPECT_NEAR(both.depth[0] / both.depth[1], 3, 3e-3);
}

// What lies flat on each other recedes as a whole, and the thinner body is worn through first.
TEST(PairGap, IsJudgedByTheThinnerBody) {
  TwoBodies pair{.upper = {.size = 0.5, .wear = 1e-6}, .lower = {.size = 4, .wear = 1e-6}};
  const Magnitudes flat = magnitudes_of(two_bodies<2>(pair), 100);
  EXPECT_GT(flat.deepest, 0);
  EXPECT_NEAR(flat.thinning, flat.deepest / 0.5, 1e-12);
  EXPECT_EQ(flat.slope, 0);
  pair.upper.surface = [](double x) { return 0.01 * x * x; };
  EXPECT_GT(magnitudes_of(two_bodies<2>(pair), 100).slope, 0);
}

TEST(PairGap, IsAMovingMeshWhereTheWornSlopeIsSmall) {
  const TwoBodies pair = closed_waves(1.5e-6, 0.5e-6);
  const Ended gap = run_of(with_gap(pair)), moving = run_of(two_bodies<2>(pair));
  EXPECT_NEAR(gap.depth[0] / moving.depth[0], 1, 1e-3);
  EXPECT_NEAR(gap.depth[1] / moving.depth[1], 1, 1e-3);
  ASSERT_TRUE(gap.error && gap.error->failure.empty());
  EXPECT_FALSE(moving.error);
  // Of the pressures of the whole contact, so that it is below the change of the largest.
  EXPECT_GT(gap.error->pressure, 0);
  EXPECT_LT(gap.error->pressure, 0.02);
}

// It turns about a point 20 mm above the contact, and comes down by what wears.
TEST(PairMotion, ABodyThatLeavesItsAxisIsToldOf) {
  TwoBodies pair = closed_waves(2e-5, 0);
  AssemblyParts<2> parts = two_bodies<2>(pair);
  MortarPair<2>& contact = parts.pairs.front();
  Tensor<2> spin;
  spin << 0, -1, 1, 0;
  contact.motion = {};
  contact.motion.spin = -spin;
  contact.motion.velocity = spin * Vector<2>(1, 20);
  contact.spins[0] = spin;
  const WearModel<2> model(parts);
  const Model& abilities = model;
  const State end = run_model(model, "esdirk-3", 0, 1e-4, 100).last();
  const auto moved = abilities.examine(end).moved_axis;
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->body, "upper");
  EXPECT_GT(moved->way, 0.5);
  EXPECT_NEAR(moved->part, moved->way / 20, 1e-3);
}

// A body that turns over the cycle is met from many sides: its nodes wear along their normals.
TEST(PairGap, TurningBodiesWearAlongTheirNormals) {
  AssemblyParts<2> parts = two_bodies<2>(closed_waves(1e-6, 1e-6));
  const auto oblique = [](const ShapeMotion<2>& shape) { return !shape.along.empty(); };
  EXPECT_FALSE(oblique(gap_motion(parts)));  // m is the direction of approach, y
  Phase<2> phase{.counter_body = parts.interface.partner, .places = {}};
  phase.places.resize(2);
  phase.places[0].turn << 0, -1, 1, 0;
  parts.phases = {phase};
  EXPECT_TRUE(oblique(gap_motion(parts)));
}

}  // namespace
}  // namespace gnomon::pair_gap_test
