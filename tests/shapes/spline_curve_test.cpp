#include <gmock/gmock.h>

#include <cmath>
#include <gnomon/shapes/spline_curve.hpp>
#include <random>

#include "support/derivatives.hpp"

namespace gnomon::spline_curve_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using Points = std::vector<Vector<2>>;

Points wavy(int count, double amplitude) {
  Points points;
  for (int k = 0; k < count; ++k)
    points.emplace_back(k + 0.3 * std::sin(k), amplitude * std::sin(1.7 * k) + 0.1 * k);
  return points;
}

Points circle(int count, double radius) {
  Points points;
  for (int k = 0; k < count; ++k)
    points.emplace_back(radius * std::cos(2 * M_PI * k / count),
                        radius * std::sin(2 * M_PI * k / count));
  return points;
}

/// Through its points, and C2 there; an open one goes on straight.
void check_smoothness(const SplineCurve& curve, const Points& points) {
  double bend = 0;
  for (std::size_t k = 0; k < curve.knots().size(); ++k) {
    const double s = curve.knots()[k], h = 1e-9 * curve.length();
    EXPECT_NEAR((curve.at(s).position - points[k % points.size()]).norm(), 0, 1e-13);
    const auto before = curve.at(s - h), after = curve.at(s + h);
    EXPECT_NEAR((before.position - after.position).norm(), 0, 1e-6);
    EXPECT_NEAR((before.first - after.first).norm(), 0, 1e-6);
    EXPECT_NEAR((before.second - after.second).norm(), 0, 1e-6);
    bend = std::max(bend, after.second.norm());
  }
  EXPECT_GT(bend, 0.1);
  const double h = 1e-5;
  for (double part : {-0.1, 0.03, 0.4, 0.77, 1.2}) {
    const double s = part * curve.length();
    const auto below = curve.at(s - h), here = curve.at(s), above = curve.at(s + h);
    EXPECT_NEAR((here.first - (above.position - below.position) / (2 * h)).norm(), 0, 1e-8);
    EXPECT_NEAR((here.second - (above.first - below.first) / (2 * h)).norm(), 0, 1e-6);
  }
}

TEST(SplineCurve, GoesThroughItsPointsAndIsTwiceDifferentiable) {
  const Points open = wavy(9, 0.7);
  check_smoothness({open, false}, open);
  Points closed = circle(7, 1.3);
  closed[3] *= 1.4;
  check_smoothness({closed, true}, closed);
  closed.push_back(closed.front());  // a repeated end changes nothing
  EXPECT_EQ(SplineCurve(closed, true).length(),
            SplineCurve({closed.begin(), closed.end() - 1}, true).length());
}

TEST(SplineCurve, IsNaturalAndStraightBeyondItsEnds) {
  const SplineCurve curve(wavy(6, 0.7), false);
  EXPECT_NEAR(curve.at(0).second.norm(), 0, 1e-14);
  EXPECT_NEAR(curve.at(curve.length()).second.norm(), 0, 1e-13);
  const auto end = curve.at(curve.length()), beyond = curve.at(curve.length() + 5);
  EXPECT_NEAR((beyond.position - end.position - 5 * end.first).norm(), 0, 1e-13);
  const SplineCurve two({{0, 0}, {3, 4}}, false);
  EXPECT_NEAR((two.at(2.5).position - Vector<2>(1.5, 2)).norm(), 0, 1e-15);
}

// Through n points of a circle a periodic spline is off by O(n^-4).
TEST(SplineCurve, ApproachesACircleAtOrderFour) {
  const auto error = [](int count) {
    const SplineCurve curve(circle(count, 2), true);
    double most = 0;
    for (int k = 0; k < 1000; ++k)
      most = std::max(most, std::abs(curve.at(k * curve.length() / 1000).position.norm() - 2));
    return most;
  };
  EXPECT_NEAR(std::log2(error(16) / error(32)), 4, 0.2);
  EXPECT_NEAR(SplineCurve(circle(64, 2), true).signed_area(), 4 * M_PI, 1e-4);
  EXPECT_NEAR(SplineCurve(circle(64, 2), true).reversed().signed_area(), -4 * M_PI, 1e-4);
}

/// By brute force: 200,000 points of the curve, then a parabola through the best three.
double sampled_distance(const SplineCurve& curve, const Vector<2>& x) {
  constexpr int n = 100'000;
  const double from = curve.closed() ? 0 : -3 * curve.length();
  const double span = curve.closed() ? curve.length() : 7 * curve.length();
  double least = 1e300, at = 0;
  for (int k = 0; k <= n; ++k) {
    const double s = from + span * k / n;
    if (const double d = (curve.at(s).position - x).squaredNorm(); d < least) least = d, at = s;
  }
  for (double h = span / n; h > 1e-10 * span; h /= 2)
    for (const double s : {at - h, at + h})
      if (const double d = (curve.at(s).position - x).squaredNorm(); d < least) least = d, at = s;
  return std::sqrt(least);
}

TEST(SplineCurve, NearestPointIsTheGlobalOne) {
  Points star = circle(14, 2);
  for (std::size_t k = 0; k < star.size(); k += 2) star[k] *= 1.8;
  int beyond = 0, knots = 0;
  for (const SplineCurve& curve : {SplineCurve(wavy(12, 1.5), false), SplineCurve(star, true),
                                   SplineCurve({{-1, 0}, {1, 0.5}}, false)})
    for (unsigned seed = 1; seed <= 12; ++seed) {
      const Vector<2> x = noise<Vector<2>>(6, seed);
      const auto nearest = curve.nearest(x);
      EXPECT_TRUE(nearest.unique);
      EXPECT_NEAR(nearest.distance, sampled_distance(curve, x), 1e-9);
      EXPECT_NEAR((nearest.place.position - x).dot(nearest.place.first.normalized()), 0, 1e-12);
      EXPECT_EQ(curve.nearest(x).parameter, nearest.parameter);
      beyond += nearest.parameter < 0 || nearest.parameter > curve.length();
      // From the curve itself, and from its points.
      const auto on = curve.nearest(nearest.place.position);
      EXPECT_NEAR(on.distance, 0, 1e-12);
      EXPECT_TRUE(on.unique);
      const auto at_knot = curve.nearest(curve.at(curve.knots()[1]).position);
      EXPECT_NEAR(at_knot.distance, 0, 1e-14);
      knots += at_knot.unique;
    }
  EXPECT_GT(beyond, 3);
  EXPECT_EQ(knots, 36);
}

TEST(SplineCurve, SaysWhereTheNearestPointIsNotUnique) {
  Points ellipse = circle(24, 1);
  for (auto& point : ellipse) point[0] *= 2;
  const SplineCurve curve(ellipse, true);
  EXPECT_FALSE(curve.nearest({0, 0}).unique);    // above and below
  EXPECT_FALSE(curve.nearest({0.7, 0}).unique);  // on the medial axis
  EXPECT_TRUE(curve.nearest({0.7, 1e-6}).unique);
  EXPECT_TRUE(curve.nearest({1.9, 0}).unique);  // beyond the centre of curvature
  EXPECT_TRUE(curve.nearest({0, 5}).unique);
  const SplineCurve valley({{-2, 1}, {0, 0}, {2, 1}}, false);
  EXPECT_FALSE(valley.nearest({0, 30}).unique);
  EXPECT_TRUE(valley.nearest({0, 0.1}).unique);
  EXPECT_TRUE(valley.nearest({0, -30}).unique);
}

/// What the constructor says.
std::string refusal(const Points& points, bool closed) {
  try {
    const SplineCurve curve(points, closed);
  } catch (const CurveError& error) {
    return error.what();
  }
  return "";
}

TEST(SplineCurve, RefusesWhatIsNoCurve) {
  EXPECT_THAT(refusal({}, false), HasSubstr("2 to 10000 different points"));
  EXPECT_THAT(refusal({{1, 2}}, false), HasSubstr("got 1"));
  EXPECT_THAT(refusal({{1, 2}, {3, 4}}, true), HasSubstr("3 to 10000"));
  EXPECT_THAT(refusal({{1, 2}, {3, 4}, {1, 2}}, true), HasSubstr("got 2"));
  EXPECT_THAT(refusal({{1, 2}, {3, 4}, {3, 4}, {5, 5}}, false),
              HasSubstr("points 2 and 3 coincide"));
  EXPECT_THAT(refusal({{1, 2}, {NAN, 4}}, false), HasSubstr("at point 2"));
  EXPECT_THAT(refusal({{1, 2}, {INFINITY, 4}}, false), HasSubstr("finite"));
  EXPECT_THAT(refusal(Points(10'001, Vector<2>(0, 0)), false), HasSubstr("got 10001"));
  // An eight, a loop, and an open curve whose straight end crosses it.
  EXPECT_THAT(
      refusal({{0, 0}, {1, 1}, {2, 0}, {1, -1}, {0, 0.5}, {-1, -1}, {-2, 0}, {-1, 1}}, true),
      HasSubstr("crosses itself"));
  EXPECT_THAT(refusal({{0, 0}, {2, 0}, {2, 2}, {1, 2}, {1, -2}}, false),
              HasSubstr("crosses itself: between points"));
  EXPECT_THAT(refusal({{0, 0}, {3, 0}, {4, 1}, {3, 2}, {2, 1.5}}, false),
              HasSubstr("beyond point 5"));
  EXPECT_THAT(refusal({{0, 0}, {1, 0}, {0.001, 0}}, false), HasSubstr("turns back"));
  EXPECT_EQ(refusal({{0, 0}, {3, 0}, {4, 1}, {4, 3}}, false), "");
}

// Whatever the numbers: a curve or one line, and distances that are finite.
TEST(SplineCurve, SurvivesArbitraryPoints) {
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> number(-1, 1);
  int made = 0;
  for (int k = 0; k < 2000; ++k) {
    Points points(2 + generator() % 6);
    for (auto& point : points)
      point = std::pow(10, 3 * number(generator)) * Vector<2>(number(generator), number(generator));
    const bool closed = k % 2;
    try {
      const SplineCurve curve(points, closed);
      ++made;
      for (unsigned j = 0; j < 5; ++j) {
        const Vector<2> x = std::pow(10, 6 * number(generator)) * points[0];
        EXPECT_TRUE(std::isfinite(curve.nearest(x).distance));
      }
    } catch (const CurveError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
  }
  EXPECT_GT(made, 300);
}

}  // namespace
}  // namespace gnomon::spline_curve_test
