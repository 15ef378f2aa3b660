// The phases of a cycle: what they integrate exactly, with and without corners, and what they are
// compared with.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <gnomon/cycles/cycle_quadrature.hpp>

namespace gnomon::cycle_quadrature_test {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::SizeIs;

double mean(const std::vector<CyclePoint>& points, const auto& f) {
  double sum = 0;
  for (const CyclePoint& point : points) sum += point.weight * f(point.position);
  return sum;
}

double speed(double tau) {
  return std::abs(std::cos(2 * M_PI * tau));
}

double one(double) {
  return 1;
}

TEST(MergedKinks, AreOneWhereTheyAreNearAlsoAroundTheEnd) {
  EXPECT_THAT(merged_kinks({0.2, 0.5}, {0.2 + 1e-10, 0.7}), ElementsAre(0.2, 0.5, 0.7));
  EXPECT_THAT(merged_kinks({0, 0.5}, {1 - 1e-10}), ElementsAre(0, 0.5));
  EXPECT_THAT(merged_kinks({}, {1 - 1e-10}), ElementsAre(1 - 1e-10));
  EXPECT_THAT(merged_kinks({0.5}, {0.5 + 1e-7}), SizeIs(2));  // there may be a stroke between
}

// The trapezoidal rule integrates trigonometric polynomials below degree P exactly.
TEST(CycleQuadrature, EqualPointsAreExactForTrigonometricPolynomials) {
  const std::vector<CyclePoint> points = CycleQuadrature(8, {}).points();
  ASSERT_EQ(points.size(), 8u);
  for (int degree = 1; degree < 8; ++degree)
    EXPECT_NEAR(mean(points, [&](double tau) { return std::cos(2 * M_PI * degree * tau + 1); }), 0,
                1e-14);
  EXPECT_NEAR(mean(points, [](double tau) { return std::cos(2 * M_PI * 8 * tau); }), 1, 1e-14);
}

// Gauss's formula with n points is exact for polynomials of degree 2 n - 1 between the kinks.
TEST(CycleQuadrature, GaussBetweenKinksIsExactForPieces) {
  const std::vector<CyclePoint> points = CycleQuadrature(10, {0.2, 0.8}).points();
  ASSERT_EQ(points.size(), 10u);
  const auto piece =
      [](double tau) {  // a parabola in one part, a cubic around the end in the other
        const double s = tau < 0.5 ? tau : tau - 1;
        return tau > 0.2 && tau < 0.8 ? tau * tau : s * s * s + 0.5;
      };
  const double exact = (0.512 - 0.008) / 3 + 0.5 * 0.4;
  EXPECT_NEAR(mean(points, piece), exact, 1e-14);
  EXPECT_TRUE(std::ranges::is_sorted(points, {}, &CyclePoint::position));
}

// |cos| has its kinks where the motion reverses: spectral between them, of order two without.
TEST(CycleQuadrature, KinksMatterForTheMeanSpeed) {
  EXPECT_NEAR(mean(CycleQuadrature(16, {0.25, 0.75}).points(), speed), 2 / M_PI, 1e-12);
  const double coarse = std::abs(mean(CycleQuadrature(18, {}).points(), speed) - 2 / M_PI);
  const double fine = std::abs(mean(CycleQuadrature(38, {}).points(), speed) - 2 / M_PI);
  EXPECT_GT(fine, 1e-5);
  EXPECT_NEAR(std::log(coarse / fine) / std::log(38.0 / 18), 2, 0.2);
}

TEST(CycleQuadrature, ChosenPositionsHaveHalfOfTheirDistances) {
  const CycleQuadrature chosen({0.1, 0.2, 0.6}, {});
  const std::vector<CyclePoint> points = chosen.points();
  EXPECT_THAT(
      (std::vector{points[0].weight, points[1].weight, points[2].weight}),
      ElementsAre(DoubleNear(0.3, 1e-15), DoubleNear(0.25, 1e-15), DoubleNear(0.45, 1e-15)));
  EXPECT_FALSE(chosen.stands_for_intervals());
  EXPECT_EQ(chosen.refined(4).points().size(), 12u);
  EXPECT_NEAR(mean(chosen.comparison().points(), one), 1, 1e-15);
}

TEST(CycleQuadrature, MiddlesGoAroundTheCycle) {
  EXPECT_THAT(with_middles({0.1, 0.2, 0.6}),
              ElementsAre(DoubleNear(0.1, 1e-15), DoubleNear(0.15, 1e-15), DoubleNear(0.2, 1e-15),
                          DoubleNear(0.4, 1e-15), DoubleNear(0.6, 1e-15), DoubleNear(0.85, 1e-15)));
  EXPECT_THAT(with_middles({0.4, 0.9}),
              ElementsAre(DoubleNear(0.15, 1e-15), 0.4, DoubleNear(0.65, 1e-15), 0.9));
  EXPECT_THAT(with_middles({0.3}), ElementsAre(0.3, DoubleNear(0.8, 1e-15)));
}

// The intervals of equal points together are the cycle, each of the weight of its point; kinks
// inside them do no harm.
TEST(CycleQuadrature, FewerPointsThanPartsStandForTheirIntervals) {
  const std::vector<double> kinks = {0.05, 0.25, 0.33, 0.61, 0.75};
  EXPECT_FALSE(CycleQuadrature(5, kinks).stands_for_intervals());
  const CycleQuadrature quadrature(3, kinks);
  ASSERT_TRUE(quadrature.stands_for_intervals());
  for (const CycleQuadrature& of : {quadrature, quadrature.comparison().refined(1)})
    EXPECT_NEAR(mean(of.points(), one), 1, 1e-14);
  const auto intervals = quadrature.intervals();
  const std::vector<CyclePoint> points = quadrature.points();
  ASSERT_EQ(intervals.size(), points.size());
  double path = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    EXPECT_NEAR(mean(intervals[p], one), points[p].weight, 1e-13);
    for (const CyclePoint& point : intervals[p])
      EXPECT_LE(std::abs(std::remainder(point.position - points[p].position, 1)), 0.5 / 3 + 1e-12);
    path += mean(intervals[p], speed);
  }
  EXPECT_NEAR(path, 2 / M_PI, 1e-12);
}

// Waves of P periods in a cycle are constant at P equal points, and not where they are compared.
TEST(CycleQuadrature, IsComparedWithPointsThatSeeOtherWaves) {
  for (const int count : {1, 4, 16}) {
    const CycleQuadrature quadrature(count, {});
    EXPECT_EQ(quadrature.comparison().points().size(), 2u * count);
    for (int waves = count; waves <= 8 * count; waves += count) {
      const auto wave = [&](double tau) { return std::cos(2 * M_PI * waves * tau); };
      EXPECT_NEAR(mean(quadrature.points(), wave), 1, 1e-12);
      EXPECT_LT(mean(quadrature.comparison().points(), wave), 0.9) << count << " " << waves;
    }
  }
}

// Twice as many as there are parts: one point in each part may miss as much in all of them.
TEST(CycleQuadrature, IsComparedWithTwoPointsInEveryPart) {
  std::vector<double> kinks;
  for (int k = 0; k < 16; ++k) kinks.push_back((k + 0.5) / 16);
  EXPECT_EQ(CycleQuadrature(4, kinks).comparison().points().size(), 32u);
  EXPECT_EQ(CycleQuadrature(20, kinks).comparison().points().size(), 40u);
}

TEST(CycleQuadrature, FinePointsAreExactBetweenKinks) {
  EXPECT_NEAR(mean(CycleQuadrature(2, {0.25, 0.75}).fine_points(), speed), 2 / M_PI, 1e-13);
  const auto jump = [](double tau) { return tau < 0.3 || tau > 0.612345 ? 1.0 : 5.0; };
  EXPECT_NEAR(mean(CycleQuadrature(2, {0.3, 0.612345}).fine_points(), jump), 1 + 4 * 0.312345,
              1e-13);
}

// A function that bends inside of a short part, where one point takes it for straight.
TEST(CycleQuadrature, IsComparedWithTwiceThePointsOfEachPart) {
  const CycleQuadrature quadrature(8, {0, 0.4, 0.45, 0.5});
  const auto within = [](const std::vector<CyclePoint>& points) {
    return std::ranges::count_if(points, [](const CyclePoint& point) {
      return 0.4 < point.position && point.position < 0.45;
    });
  };
  EXPECT_EQ(within(quadrature.points()), 1);
  EXPECT_EQ(within(quadrature.comparison().points()), 2);
  EXPECT_EQ(quadrature.comparison().points().size(), 16u);
}

}  // namespace
}  // namespace gnomon::cycle_quadrature_test
