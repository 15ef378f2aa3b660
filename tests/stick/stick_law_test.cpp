// Coulomb's law with stick: the branches, and their derivatives.
#include <gnomon/cycles/cycle_quadrature.hpp>
#include <gnomon/laws/stick_friction.hpp>

#include "support/derivatives.hpp"

namespace gnomon::stick_law_test {
namespace {

using namespace testing;

const Vector<3> normal = Vector<3>(0.3, -0.2, 1).normalized();

TEST(StickFriction, SticksBelowTheLimit) {
  const Vector<3> lambda(1, 2, 0), slip(1e-3, 0, 0);
  const StickFriction<3> law(lambda, slip, normal, 10, 100, true);
  EXPECT_TRUE(law.sticks);
  EXPECT_NEAR(law.traction.dot(normal), 0, 1e-14);
  const Vector<3> along = slip - normal * normal.dot(slip);
  EXPECT_NEAR((law.constraint - (along - normal * normal.dot(lambda) / 100)).norm(), 0, 1e-14);
}

TEST(StickFriction, SlipsAtTheLimitAlongTheTrialTraction) {
  const Vector<3> lambda(1, 2, 0), slip(1e-3, 0, 0);
  const StickFriction<3> law(lambda, slip, normal, 1.5, 100, true);
  EXPECT_FALSE(law.sticks);
  EXPECT_NEAR(law.traction.norm(), 1.5, 1e-14);
  EXPECT_NEAR(law.traction.dot(normal), 0, 1e-14);
  EXPECT_GT(law.excess, 0);
  EXPECT_NEAR((law.constraint - (law.traction - lambda) / 100).norm(), 0, 1e-14);
}

TEST(StickFriction, AnOpenNodeHasNoTraction) {
  const StickFriction<3> law(Vector<3>(1, 2, 0), Vector<3>(1e-3, 0, 0), normal, -5, 100, false);
  EXPECT_TRUE(law.traction.isZero(0));
  EXPECT_TRUE(law.constraint.isApprox(Vector<3>(-0.01, -0.02, 0)));
}

TEST(StickFriction, AGivenBranchGoesOnBeyondItsBorder) {
  const Vector<3> lambda(1, 2, 0), slip(1e-3, 0, 0);
  EXPECT_TRUE(StickFriction<3>(lambda, slip, normal, 1.5, 100, true, true).sticks);
  EXPECT_FALSE(StickFriction<3>(lambda, slip, normal, 10, 100, true, false).sticks);
}

TEST(CyclePath, EndsAtAllExtremesAndAtTheEnd) {
  const std::vector<CyclePoint> points = path_points(5, {0.25, 0.75});
  ASSERT_EQ(points.size(), 5u);
  double before = 0;
  for (const CyclePoint& point : points) {
    EXPECT_NEAR(point.weight, point.position - before, 1e-15);
    before = point.position;
  }
  EXPECT_EQ(points.back().position, 1);
  for (const double extreme : {0.25, 0.75})
    EXPECT_TRUE(std::ranges::any_of(
        points, [&](const CyclePoint& at) { return std::abs(at.position - extreme) < 1e-15; }));
  EXPECT_EQ(path_points(1, {0.0, 0.25, 0.75}).size(), 3u);
}

}  // namespace
}  // namespace gnomon::stick_law_test
