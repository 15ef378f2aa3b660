#include <cmath>
#include <gnomon/shapes/counter_body.hpp>
#include <gnomon/shapes/profile.hpp>

#include "support/derivatives.hpp"

namespace gnomon::counter_body_test {
namespace {

using namespace testing;

// What looks the same while it turns stays where it is; a cam does not.
TEST(CounterShape, TurnsIntoItselfIfItIsRound) {
  const Vector<3> c(0.3, -0.4, 2), e = Vector<3>(1, 2, -0.5).normalized();
  const Tensor<3> own = spin_about(e, 3), other = spin_about({0, 0, 1}, 3);
  const SplineCurve cam({{1, 0}, {0.2, 1}, {-1.5, 0}, {0, -1}}, true);
  const SplineCurve wheel({{4, 0}, {3.2, 1}, {1.5, 0}, {3, -1}}, true);
  for (const auto& shape : {cylinder(c, e, 0.7), torus(c, e, 2, 0.7), cone<3>(c, e, 0.4),
                            plane<3>(c, e), revolved(profile(wheel), c, e)}) {
    EXPECT_TRUE(turns_into_itself<3>(shape, own, c));
    EXPECT_FALSE(turns_into_itself<3>(shape, other, c));
    EXPECT_TRUE(turns_into_itself<3>(complement(shape), own, c));
  }
  EXPECT_TRUE(turns_into_itself<3>(ball<3>(c, 1), other, c));
  EXPECT_FALSE(turns_into_itself<3>(ball<3>(c, 1), own, c + Vector<3>(0.1, 0, 0)));
  EXPECT_FALSE(turns_into_itself<2>(profile(cam), spin_in_plane(2), {0, 0}));
  EXPECT_TRUE(turns_into_itself<2>(ball<2>({0, 3}, 1), spin_in_plane(2), {0, 3}));
}

// A cam that turns is the cam seen from turned axes, and a quarter turn by hand.
TEST(CounterBody, ACamTurns) {
  CounterBody<2> body;
  const Vector<2> centre(0.2, -0.1);
  body.shape = profile(SplineCurve({{1, 0}, {0.2, 1}, {-1.5, 0}, {0, -1}}, true));
  body.turning = Turning<2>{spin_in_plane(2), centre};
  const Vector<2> x(2, 0.3);
  const auto start = body.shape.at(x);
  EXPECT_DOUBLE_EQ(body.unchecked_distance(x, 0).gap, start.gap);
  const Vector<2> from = x - centre;
  const auto quarter = body.unchecked_distance(centre + Vector<2>(-from[1], from[0]), M_PI / 4);
  EXPECT_NEAR(quarter.gap, start.gap, 1e-14);
  EXPECT_NEAR((quarter.normal - Vector<2>(-start.normal[1], start.normal[0])).norm(), 0, 1e-14);
  const double h = 1e-5;
  Vector<2> slope;
  Tensor<2> turn;
  for (int i = 0; i < 2; ++i) {
    const auto above = body.unchecked_distance(x + h * Vector<2>::Unit(i), 0.37);
    const auto below = body.unchecked_distance(x - h * Vector<2>::Unit(i), 0.37);
    slope[i] = (above.gap - below.gap) / (2 * h);
    turn.col(i) = (above.normal - below.normal) / (2 * h);
  }
  const auto at = body.unchecked_distance(x, 0.37);
  EXPECT_GT(std::abs(at.gap - start.gap), 1e-2);
  expect_same_matrix(at.normal, slope, 1e-8);
  expect_same_matrix(at.normal_by_x, turn, 1e-6);
  const Turning<3> spin{spin_about({1, 2, -0.5}, 3), Vector<3>::Zero()};
  const Tensor<3> R = spin.rotation(0.4);
  EXPECT_NEAR((R * R.transpose() - Tensor<3>::Identity()).norm(), 0, 1e-15);
  EXPECT_NEAR(std::acos((R.trace() - 1) / 2), 1.2, 1e-14);
  EXPECT_NEAR((spin.rotation(0.2) * spin.rotation(0.2) - R).norm(), 0, 1e-15);
  expect_same_matrix((spin.rotation(1e-6) - spin.rotation(-1e-6)) / 2e-6, spin.spin, 1e-9);
}

// A shape that surrounds a cavity is come upon from within; a seat and a rail from afar.
TEST(CounterBody, TravelsIntoCavities) {
  CounterBody<2> cup;
  cup.shape = complement(ball<2>({0, 3}, 3));
  cup.approach = Vector<2>(0, 1);
  EXPECT_NEAR(cup.travel_to({0, 0.25}), 0.25, 1e-12);
  EXPECT_NEAR(cup.travel_to({0, 1}), 1, 1e-12);
  CounterBody<3> seat, groove;
  seat.shape = complement(cone<3>({0, 0, -1}, {0, 0, 1}, M_PI / 3));
  seat.approach = groove.approach = Vector<3>(0, 0, 1);
  EXPECT_NEAR(seat.travel_to({3, 0, 2}), 3 - 3 / std::sqrt(3.0), 1e-12);
  groove.shape = complement(torus({0, 0, 0}, {0, 0, 1}, 5, 2));
  EXPECT_NEAR(groove.travel_to({3, 4, -1.5}), 0.5, 1e-12);
  // Of two cavities along the way it is the one that x is in, touches or is nearest to.
  CounterBody<3> ring;
  ring.shape = complement(torus({0, 0, 21}, {0, 1, 0}, 15, 6));
  ring.approach = Vector<3>(0, 0, 1);
  for (const double z : {-0.4, 0.0, 0.4, 11.0}) EXPECT_NEAR(ring.travel_to({0, 0, z}), z, 1e-12);
  for (const double z : {29.5, 30.0, 41.0}) EXPECT_NEAR(ring.travel_to({0, 0, z}), z - 30, 1e-12);
  CounterBody<2> rail;
  rail.shape = profile(SplineCurve({{0, 0}, {1, 0.5}, {2, 0}}, false).reversed());
  EXPECT_NEAR(rail.travel_to({1, 2}), 1.5, 1e-12);
  rail.approach = Vector<2>(0, -1);
  EXPECT_TRUE(std::isinf(rail.travel_to({1, 2})));
}

}  // namespace
}  // namespace gnomon::counter_body_test
