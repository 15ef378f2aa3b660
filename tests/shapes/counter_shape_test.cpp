#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <gnomon/base/error.hpp>
#include <gnomon/shapes/counter_body.hpp>
#include <gnomon/shapes/counter_shape_kind.hpp>
#include <gnomon/shapes/profile.hpp>
#include <gnomon/shapes/shape_keys.hpp>

#include "support/derivatives.hpp"

namespace gnomon::counter_shape_test {
namespace {

using namespace testing;

template <int dim>
struct Named {
  std::string name;
  CounterShape<dim> shape;
  /// A point of the surface by parameters in [0, 1], for projections that do not use the distance.
  std::function<Vector<dim>(const Vector<dim>& parameters)> point;
};

/// A bean, anticlockwise about `c`.
SplineCurve bean(const Vector<2>& c) {
  std::vector<Vector<2>> points;
  for (int k = 0; k < 11; ++k) {
    const double angle = 2 * M_PI * (k + 0.1 * std::sin(k)) / 11;
    const double r = 1.5 + 0.4 * std::cos(2 * angle) + 0.1 * std::sin(3 * angle);
    points.push_back(c + r * Vector<2>(std::cos(angle), std::sin(angle)));
  }
  return {points, true};
}

/// A rail, whose ends go on straight.
SplineCurve rail() {
  return {{{-2, -1}, {-1, -1.3}, {0.2, -0.8}, {0.9, -1.1}, {2, -0.7}}, false};
}

std::vector<Named<2>> shapes_2d() {
  const Vector<2> c(0.3, -2), n = Vector<2>(0.6, 0.8), m(n[1], -n[0]);
  const auto wedge = [=](const Vector<2>& s) -> Vector<2> {
    const double l = 40 * (s[0] - 0.5);
    return c + std::abs(l) * std::cos(0.7) * n + l * std::sin(0.7) * m;
  };
  const SplineCurve ring = bean(c), track = rail();
  const auto round = [=](const Vector<2>& s) -> Vector<2> {
    return ring.at(s[0] * ring.length()).position;
  };
  return {{"wedge", cone<2>(c, 2 * n, 0.7), wedge},
          {"groove", complement(cone<2>(c, n, 0.7)), wedge},
          {"bean", profile(ring), round},
          {"bean's mould", complement(profile(ring)), round},
          {"rail", profile(track),
           [=](const Vector<2>& s) -> Vector<2> {
             return track.at((9 * s[0] - 4) * track.length()).position;
           }},
          {"plane", plane<2>(c, 3 * n),
           [=](const Vector<2>& s) -> Vector<2> {
             return c + 20 * (s[0] - 0.5) * Vector<2>(n[1], -n[0]);
           }},
          {"ball", ball<2>(c, 1.5), [=](const Vector<2>& s) -> Vector<2> {
             return c + 1.5 * Vector<2>(std::cos(2 * M_PI * s[0]), std::sin(2 * M_PI * s[0]));
           }}};
}

std::vector<Named<3>> shapes_3d() {
  const Vector<3> c(0.3, -0.4, -2), e = Vector<3>(1, 2, -0.5).normalized();
  const Vector<3> a = e.unitOrthogonal(), b = e.cross(a);
  const auto round = [=](double s) -> Vector<3> {
    return std::cos(2 * M_PI * s) * a + std::sin(2 * M_PI * s) * b;
  };
  const auto tube = [=](const Vector<3>& s) -> Vector<3> {
    const double angle = 2 * M_PI * s[1];
    return c + (2 + 0.7 * std::cos(angle)) * round(s[0]) + 0.7 * std::sin(angle) * e;
  };
  const auto flank = [=](const Vector<3>& s) -> Vector<3> {
    return c + 20 * std::abs(s[1]) * (std::cos(0.7) * e + std::sin(0.7) * round(s[0]));
  };
  const SplineCurve ring = bean({3, 0.5});
  Tensor<3> frame;
  frame << a, e, b;
  return {{"cone", cone<3>(c, 2 * e, 0.7), flank},
          {"seat", complement(cone<3>(c, e, 0.7)), flank},
          {"torus", torus(c, 3 * e, 2, 0.7), tube},
          {"ring groove", complement(torus(c, e, 2, 0.7)), tube},
          {"revolved", revolved(profile(ring), c, e),
           [=](const Vector<3>& s) -> Vector<3> {
             const Vector<2> at = ring.at(s[1] * ring.length()).position;
             return c + at[0] * round(s[0]) + at[1] * e;
           }},
          {"extruded", extruded(profile(ring), c, frame),
           [=](const Vector<3>& s) -> Vector<3> {
             const Vector<2> at = ring.at(s[1] * ring.length()).position;
             return c + at[0] * a + at[1] * e + 20 * (s[0] - 0.5) * b;
           }},
          {"plane", plane<3>(c, 0.5 * e),
           [=](const Vector<3>& s) -> Vector<3> {
             return c + 20 * (s[0] - 0.5) * a + 20 * (s[1] - 0.5) * b;
           }},
          {"ball", ball<3>(c, 1.5),
           [=](const Vector<3>& s) -> Vector<3> {
             const double z = std::clamp(2 * s[1] - 1, -1.0, 1.0);
             return c + 1.5 * (z * e + std::sqrt(std::max(0.0, 1 - z * z)) * round(s[0]));
           }},
          {"cylinder", cylinder(c, 4 * e, 1.5), [=](const Vector<3>& s) -> Vector<3> {
             return c + 20 * (s[1] - 0.5) * e + 1.5 * round(s[0]);
           }}};
}

/// The distance from the surface by a search on its points: a grid, then finer grids around the
/// nearest point.
template <int dim>
double projected_distance(const Named<dim>& named, const Vector<dim>& x) {
  Vector<dim> best = Vector<dim>::Constant(0.5);
  double least = 1e9;
  constexpr int n = 20;
  for (double width = 0.5; width > 1e-9; width /= 4) {
    const Vector<dim> middle = best;
    for (int i = -n; i <= n; ++i)
      for (int j = dim == 3 ? -n : 0; j <= (dim == 3 ? n : 0); ++j) {
        Vector<dim> s = middle;
        s[0] += width * i / n;
        if (dim == 3) s[1] += width * j / n;
        if (const double d = (named.point(s) - x).norm(); d < least) least = d, best = s;
      }
  }
  return least;
}

/// Points inside of corners and centres are left out: there is no normal (at throws).
template <int dim>
void check(const Named<dim>& named, bool is_straight) {
  SCOPED_TRACE(named.name + " in " + std::to_string(dim) + "D");
  int curved = 0;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const Vector<dim> x = noise<Vector<dim>>(3, seed);
    SCOPED_TRACE(seed);
    const SignedDistance<dim> at = named.shape.unchecked(x);
    EXPECT_TRUE(at.unique);
    EXPECT_NEAR(at.normal.norm(), 1, 1e-14);
    EXPECT_NEAR((at.normal_by_x - at.normal_by_x.transpose()).norm(), 0, 1e-14);
    EXPECT_NEAR((at.normal_by_x * at.normal).norm(), 0, 1e-13);
    EXPECT_NEAR(std::abs(at.gap), projected_distance(named, x), 1e-8);
    // On the surface, and so of the right sign on the right side, at x less gap n.
    EXPECT_NEAR(named.shape.unchecked(x - at.gap * at.normal).gap, 0, 1e-13);
    const double outside = named.shape.unchecked(x - (at.gap - 1e-4) * at.normal).gap;
    EXPECT_TRUE(outside > 0 || named.name == "seat");  // beyond whose tip is no surface
    Vector<dim> slope;
    Tensor<dim> turn;
    const double h = 1e-5;
    for (int i = 0; i < dim; ++i) {
      const auto above = named.shape.at(x + h * Vector<dim>::Unit(i));
      const auto below = named.shape.at(x - h * Vector<dim>::Unit(i));
      slope[i] = (above.gap - below.gap) / (2 * h);
      turn.col(i) = (above.normal - below.normal) / (2 * h);
    }
    expect_same_matrix(at.normal, slope, 1e-8);
    if (at.normal_by_x.norm() == 0) {
      EXPECT_LT(turn.norm(), 1e-10);
    } else {
      ++curved;
      expect_same_matrix(at.normal_by_x, turn, 1e-6);
    }
  }
  EXPECT_EQ(curved == 0, is_straight);
}

/// Of the points that are looked at none is before the tip of the wedge.
bool is_straight(const std::string& name) {
  return name == "plane" || name == "wedge" || name == "groove";
}

TEST(CounterShape, IsASignedDistanceWithItsDerivatives) {
  for (const auto& named : shapes_2d()) check(named, is_straight(named.name));
  for (const auto& named : shapes_3d()) check(named, is_straight(named.name));
}

TEST(CounterShape, GapAndNormalByHand) {
  const auto below = ball<3>({0, 0, 5}, 5).at({0, 0, -0.25});
  EXPECT_DOUBLE_EQ(below.gap, 0.25);
  EXPECT_NEAR((below.normal - Vector<3>(0, 0, -1)).norm(), 0, 1e-15);
  const auto beside = cylinder({0, 7, 5}, {0, 2, 0}, 5).at({6, -3, 5});
  EXPECT_DOUBLE_EQ(beside.gap, 1);
  EXPECT_NEAR((beside.normal - Vector<3>(1, 0, 0)).norm(), 0, 1e-15);
  EXPECT_THROW(ball<2>({1, 2}, 3).at({1, 2}), RecoverableError);
  EXPECT_THROW(cylinder({0, 7, 5}, {0, 2, 0}, 5).at({0, 1, 5}), RecoverableError);
}

/// Moved by that far the shape touches x, coming from outside, and not before.
template <int dim>
void expect_first_touch(const CounterBody<dim>& body, const Vector<dim>& x) {
  const double w = body.travel_to(x);
  ASSERT_TRUE(std::isfinite(w));
  const auto at = [&](double shift) { return body.shape.at(body.seen(x, w - shift)); };
  EXPECT_NEAR(at(0).gap, 0, 1e-13);
  EXPECT_GT(at(0).normal.dot(body.approach), 0);
  for (double before = 1e-3; before < 100; before *= 1.2) EXPECT_GT(at(before).gap, 0);
}

TEST(CounterBody, TravelsUntilItTouches) {
  CounterBody<3> flat, round, pipe;
  flat.shape = plane<3>({0.3, 0.1, -0.7}, {0.6, 0, 0.8});
  round.shape = ball<3>({0.1, 0.2, 5}, 2);
  pipe.shape = cylinder({0.1, 0.2, 5}, {1, 0.1, -0.2}, 2);
  round.approach = pipe.approach = Vector<3>(0, 0.6, -0.8);
  pipe.position = Vector<3>(0.1, 0.1, 0.1);
  for (const Vector<3>& x : {Vector<3>(0.2, 3, 0), Vector<3>(0.5, 0.4, 4.9), Vector<3>(0, 4, 1)})
    for (const CounterBody<3>* body : {&flat, &round, &pipe}) expect_first_touch(*body, x);
  // By hand; in the last the ball only just touches.
  EXPECT_DOUBLE_EQ(round.travel_to({0.1, 0.2, 5}), -2);
  EXPECT_NEAR(flat.travel_to({0.3, 0.1, 1}), 1.7, 1e-15);
  EXPECT_NEAR(round.travel_to(Vector<3>(2.1, 0.2, 5) + 3 * round.approach), 3, 1e-5);
  EXPECT_TRUE(std::isinf(round.travel_to({2.2, 0.2, 0})));
  EXPECT_TRUE(std::isinf(pipe.travel_to(Vector<3>(0, 0, 5) + 2.5 * Vector<3>(0.04, 0.8, 0.6))));
  CounterBody<2> disk;
  disk.shape = ball<2>({1, -3}, 2);
  expect_first_touch<2>(disk, {0.1, 0.3});
  EXPECT_TRUE(std::isinf(disk.travel_to({3.01, 0})));
  disk.shape = plane<2>({0, 0}, {0, -1});  // would have to come through the body
  EXPECT_TRUE(std::isinf(disk.travel_to({3, 1})));
  EXPECT_TRUE(std::isinf(disk.travel_to({0, 0})));
  // Nearly along the surface.
  CounterBody<2> grazing;
  grazing.approach = Vector<2>(1, 1e-3).normalized();
  EXPECT_NEAR(grazing.travel_to({5, 0.1}), 0.1 / grazing.approach[1], 1e-10);
}

Scene scene_of(const std::string& text, std::vector<Key> keys) {
  keys.insert(keys.begin(), run_keys().begin(), run_keys().end());
  return parse_scene("problem = \"any\"\ntime.end = 1.0\nintegrator.name = \"any\"\n" + text,
                     "scene.toml", {}, [&](const std::string&) { return keys; });
}

TEST(CounterShape, IsMadeOfASceneByItsName) {
  const auto& kind = Registry<CounterShapeKind>::find("cylinder", "shape");
  std::vector<Key> keys = kind.keys;
  keys.insert(keys.end(), kind.keys_in_space.begin(), kind.keys_in_space.end());
  const auto make = [&](const std::string& axis) {
    return kind.in_space(
        scene_of("[counter_body]\ncenter = [0.0, 7.0, 5.0]\naxis = " + axis + "\nradius = 5.0\n",
                 keys),
        Section::plane);
  };
  EXPECT_DOUBLE_EQ(make("[0.0, 2.0, 0.0]").at({6, -3, 5}).gap, 1);
  EXPECT_THROW(make("[0.0, 0.0, 0.0]"), InputError);
  EXPECT_THAT(Registry<CounterShapeKind>::names(),
              ::testing::IsSupersetOf({"ball", "cone", "cylinder", "plane", "profile", "torus"}));
  const auto& flat = Registry<CounterShapeKind>::find("plane", "shape");
  EXPECT_DOUBLE_EQ(flat.in_plane(scene_of("", flat.keys), Section::plane).at({4, 2}).gap, 2);
  const auto& disk = Registry<CounterShapeKind>::find("ball", "shape");
  const Scene scene =
      scene_of("counter_body.center = [1.0, -1.0]\ncounter_body.radius = 1.0\n", disk.keys);
  EXPECT_DOUBLE_EQ(disk.in_plane(scene, Section::plane).at({1, 2}).gap, 2);
}

}  // namespace
}  // namespace gnomon::counter_shape_test
