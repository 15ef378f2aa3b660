#include <gtest/gtest.h>

#include <gnomon/mesh/flat_part.hpp>
#include <numbers>

#include "support/structured_hexahedra.hpp"

namespace gnomon::flat_part_test {
namespace {

/// A sector of a ring, turned by `angle` about the origin: sides "left" and "right" are arcs.
Mesh<2> sector(double angle) {
  return structured_quadrilaterals(8, 5, [angle](double s, double t) {
    const double a = angle + t;
    return Vector<2>((2 - s) * std::cos(a), (2 - s) * -std::sin(a));
  });
}

TEST(FlatPart, IsFoundWithItsOuterNormalAtAnyAngle) {
  for (double angle : {0.0, 0.3, 2.0, -1.0}) {
    const Mesh<2> mesh = sector(angle);
    const FlatPart<2> bottom = flat_part(mesh, mesh.boundary.at("bottom"));
    EXPECT_TRUE(bottom.flat);
    EXPECT_NEAR((bottom.normal - Vector<2>(std::sin(angle), std::cos(angle))).norm(), 0, 1e-14);
    EXPECT_LT(bottom.deviation, 1e-15);
    for (const char* arc : {"left", "right"}) {
      const FlatPart<2> part = flat_part(mesh, mesh.boundary.at(arc));
      EXPECT_FALSE(part.flat) << arc;
      EXPECT_GT(part.deviation, 0.05) << arc;
    }
  }
}

TEST(FlatPart, InSpace) {
  const Mesh<3> mesh = testing::structured_hexahedra(3, 3, 3, [](double r, double s, double t) {
    return Vector<3>(r + 0.2 * t, s, t + 1e-4 * r * (1 - r) * t);
  });
  const FlatPart<3> right = flat_part(mesh, mesh.boundary.at("right"));
  EXPECT_TRUE(right.flat);
  EXPECT_NEAR((right.normal - Vector<3>(1, 0, -0.2).normalized()).norm(), 0, 1e-14);
  EXPECT_FALSE(flat_part(mesh, mesh.boundary.at("top")).flat);
  EXPECT_TRUE(flat_part(mesh, mesh.boundary.at("top"), 1e-3).flat);
}

TEST(FlatPart, IsNotWhatLooksBothWaysOrIsEmpty) {
  const Mesh<2> mesh =
      structured_quadrilaterals(4, 1, [](double s, double t) { return Vector<2>(s, 1e-9 * t); });
  auto facets = mesh.boundary.at("bottom");
  EXPECT_TRUE(flat_part(mesh, facets).flat);
  const auto& top = mesh.boundary.at("top");
  facets.insert(facets.end(), top.begin(), top.begin() + 2);
  EXPECT_FALSE(flat_part(mesh, facets).flat);
  EXPECT_FALSE(flat_part(mesh, {}).flat);
  auto closed = mesh.boundary.at("bottom");
  closed.insert(closed.end(), top.begin(), top.end());
  EXPECT_FALSE(flat_part(mesh, closed).flat);
}

TEST(PlanesOf, CountsPlanesThatAreApart) {
  const Mesh<2> ring = sector(0.3);
  EXPECT_EQ(planes_of(ring, ring.boundary.at("bottom")), 1);
  EXPECT_EQ(planes_of(ring, ring.boundary.at("left")), 0) << "an arc";
  const Mesh<3> cube = testing::structured_hexahedra(
      3, 3, 3, [](double r, double s, double t) { return Vector<3>(r, s, t); });
  auto facets = cube.boundary.at("left");
  for (const char* other : {"right", "top"}) {
    const auto& more = cube.boundary.at(other);
    facets.insert(facets.end(), more.begin(), more.end());
  }
  EXPECT_EQ(planes_of(cube, facets), 3);
}

}  // namespace
}  // namespace gnomon::flat_part_test
