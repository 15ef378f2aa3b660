#include <gtest/gtest.h>

#include <cmath>
#include <gnomon/shapes/counter_surface.hpp>
#include <map>
#include <set>

namespace gnomon::counter_surface_test {
namespace {

template <int dim>
FacetedSurface<dim> surface_of(const CounterShape<dim>& shape, const Box<dim>& box, int most) {
  return zero_level<dim>([&](const Vector<dim>& x) { return shape.unchecked(x); }, box, most);
}

const Box<3> around_ball{Vector<3>(-1.7, -1.6, -1.5), Vector<3>(1.6, 1.7, 1.8)};

/// The area, with its sign, that a closed curve encloses.
double enclosed(const FacetedSurface<2>& surface) {
  double area = 0;
  for (const auto& [a, b] : surface.facets) {
    const Vector<2>&p = surface.points[a], &q = surface.points[b];
    area += (p[0] * q[1] - p[1] * q[0]) / 2;
  }
  return area;
}

/// The volume, with its sign, that a closed surface encloses.
double enclosed(const FacetedSurface<3>& surface) {
  double volume = 0;
  for (const auto& facet : surface.facets) {
    Vector<3> corner[4], middle = Vector<3>::Zero();
    for (int i = 0; i < 4; ++i) middle += (corner[i] = surface.points[facet[i]]) / 4;
    for (int i = 0; i < 4; ++i) volume += middle.dot(corner[i].cross(corner[(i + 1) % 4])) / 6;
  }
  return volume;
}

// The points lie on the surface, and chords enclose less than arcs by a part of order h^2.
TEST(CounterSurface, EnclosesADiskAndABall) {
  const Box<2> box{Vector<2>(-1.5, -1.7), Vector<2>(1.6, 1.5)};
  double before = 0;
  for (const int most : {20, 40, 80}) {
    const auto disk = surface_of<2>(ball<2>({0.1, -0.1}, 1), box, most);
    for (const Vector<2>& x : disk.points) EXPECT_NEAR((x - Vector<2>(0.1, -0.1)).norm(), 1, 1e-14);
    const double missing = M_PI - enclosed(disk);
    EXPECT_GT(missing, 0);
    if (before > 0) {
      EXPECT_NEAR(std::log2(before / missing), 2, 0.3);
    }
    before = missing;
  }
  const auto sphere = surface_of<3>(ball<3>({0, 0, 0.1}, 1), around_ball, 24);
  for (const Vector<3>& x : sphere.points) EXPECT_NEAR((x - Vector<3>(0, 0, 0.1)).norm(), 1, 1e-14);
  EXPECT_NEAR(enclosed(sphere) / (4 * M_PI / 3), 1, 0.02);
  EXPECT_LT(enclosed(sphere), 4 * M_PI / 3);
}

// A socket is the same surface, seen from the other side.
TEST(CounterSurface, FacetsTellTheSideOfTheBody) {
  const auto shape = ball<3>({0, 0, 0.1}, 1);
  const double whole = enclosed(surface_of<3>(shape, around_ball, 16));
  EXPECT_NEAR(enclosed(surface_of<3>(complement(shape), around_ball, 16)), -whole, 1e-12);
}

// Every side of a facet belongs to two facets, in opposite directions: torus, Euler's number 0.
TEST(CounterSurface, AClosedSurfaceHasNoGaps) {
  const auto ring = surface_of<3>(torus({0.02, 0.01, 0}, {1, 2, 3}, 1, 0.4), around_ball, 30);
  std::map<std::pair<int, int>, int> sides;
  std::set<int> used;
  for (const auto& facet : ring.facets)
    for (int i = 0; i < 4; ++i) {
      ++sides[{facet[i], facet[(i + 1) % 4]}];
      used.insert(facet[i]);
    }
  for (const auto& [side, count] : sides) {
    EXPECT_EQ(count, 1);
    EXPECT_EQ(sides.count({side.second, side.first}), 1u);
  }
  EXPECT_EQ(used.size(), ring.points.size());
  EXPECT_EQ(long(used.size()) - long(sides.size()) / 2 + long(ring.facets.size()), 0);
}

// Open surfaces end within a cell of the box; what passes by has none.
TEST(CounterSurface, ReachesTheEndsOfTheBox) {
  const Box<2> box{Vector<2>(0, 0), Vector<2>(8, 4)};
  const auto line = surface_of<2>(plane<2>({0, 1}, {1, 10}), box, 64);
  const Box<2> seen = Box<2>::around(line.points);
  EXPECT_LT(seen.low[0], 0.125);
  EXPECT_GT(seen.high[0], 8 - 0.125);
  EXPECT_EQ(line.facets.size() + 1, line.points.size());
  EXPECT_TRUE(surface_of<2>(plane<2>({0, 5}, {0, 1}), box, 64).facets.empty());
  const Box<2> wide = box.widened(0.25);
  EXPECT_EQ(wide.low, Vector<2>(-2, -2));
  EXPECT_EQ(wide.high, Vector<2>(10, 6));
}

// Where the distance has several normals or none: an edge, a tip, the centre of a ball on a node.
TEST(CounterSurface, EdgesAndCentresDoNoHarm) {
  const Box<2> box{Vector<2>(-1, -1), Vector<2>(1, 1)};
  for (const auto& shape : {cone<2>({0.1, 0}, {0, 1}, 0.5), ball<2>({0, 0}, 0.4),
                            complement(cone<2>({0.1, 0}, {0, 1}, 0.5))}) {
    const auto surface = surface_of<2>(shape, box, 40);
    EXPECT_FALSE(surface.facets.empty());
    for (const Vector<2>& x : surface.points) {
      ASSERT_TRUE(x.allFinite());
      EXPECT_LT(std::abs(shape.unchecked(x).gap), 0.05);
    }
  }
}

}  // namespace
}  // namespace gnomon::counter_surface_test
