// Worn surfaces on different meshes: what is linear along the surface is compared exactly.

#include <gtest/gtest.h>

#include <cmath>
#include <gnomon/results/surface_difference.hpp>

namespace gnomon::surface_difference_test {
namespace {

/// A straight surface of length 1 that has worn by depth + slope x, with pressures of 5 + x. Its
/// nodes have slid by `slide` along it.
ContactSurface surface(int elements, double depth, double slope, double slide = 0) {
  ContactSurface result;
  for (int k = 0; k <= elements; ++k) {
    const double x = static_cast<double>(k) / elements;
    result.initial.push_back({x, 0, 0});
    result.worn.push_back({x + slide, depth + slope * (x + slide), 0});
    result.wear_depth.push_back(depth + slope * x);
    result.pressure.push_back(5 + x);
  }
  return result;
}

TEST(SurfaceDifference, OfTheSameSurfaceOnOtherMeshesIsNothing) {
  const SurfaceDifference difference =
      surface_difference(surface(7, 0.01, 0.02), surface(10, 0.01, 0.02));
  for (const double distance : difference.distance) EXPECT_NEAR(distance, 0, 1e-12);
  for (const double pressure : difference.pressure) EXPECT_NEAR(pressure, 0, 1e-11);
  EXPECT_NEAR(shape_error(surface(7, 0.01, 0.02), surface(10, 0.01, 0.02)), 0, 1e-12);
}

TEST(SurfaceDifference, OfADeeperOneIsTheDepthAtEachNodeOfTheReference) {
  const ContactSurface reference = surface(10, 0.01, 0);
  EXPECT_NEAR(shape_error(surface(7, 0.013, 0), reference), 0.003 * std::sqrt(11), 1e-12);
  EXPECT_NEAR(shape_error(surface(14, 0.013, 0), reference), 0.003 * std::sqrt(11), 1e-12);
  EXPECT_NEAR(shape_error(surface(10, 0.013, 0), reference), 0.003 * std::sqrt(11), 1e-12);
}

// A node that slides along the surface changes the paper's error, and not the shape.
TEST(SurfaceDifference, LeavesSlidingOut) {
  const ContactSurface slid = surface(10, 0.01, 0.02, 1e-3), reference = surface(10, 0.01, 0.02);
  EXPECT_NEAR(shape_error(slid, reference), 1e-3 * std::sqrt(11 * (1 + 4e-4)), 1e-12);
  EXPECT_LT(distance_error(slid, reference), 1e-7);
}

TEST(SurfaceDifference, OfPressuresIsTheLargest) {
  ContactSurface high = surface(7, 0.01, 0);
  high.pressure[3] += 2;
  EXPECT_NEAR(pressure_error(high, surface(10, 0.01, 0)), 2, 1e-11);
}

}  // namespace
}  // namespace gnomon::surface_difference_test
