// The lines of a surface that is uniform along straight lines or circles.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/surface_lines.hpp>

#include "support/structured_hexahedra.hpp"

namespace gnomon::surface_lines_test {
namespace {

using namespace testing;

/// Of the top of a block, 4 by 3 elements, that is bent by an angle about z at a radius of 1 to 2.
SurfaceLines lines_of_ring(double angle, const Streamlines<3>& along) {
  const Mesh<3> mesh = structured_hexahedra(4, 3, 1, [&](double s, double t, double z) {
    const double turn = angle * (1 - s * s);
    return Vector<3>((1 + t) * std::cos(turn), (1 + t) * std::sin(turn), z);
  });
  return lines_of_surface<3>(mesh, mesh.boundary.at("top"), along);
}

TEST(SurfaceLines, AreCircles) {
  const Streamlines<3> about_z{-Vector<3>::UnitZ(), Vector<3>(0, 0, 5)};
  for (const double angle : {0.5, 3.0, 6.0}) {
    const SurfaceLines lines = lines_of_ring(angle, about_z);
    double length = 0;  // R sin theta of the four edges
    for (const double part : {1, 3, 5, 7}) length += 1.5 * std::sin(part / 16 * angle);
    EXPECT_NEAR(lines.length, length, 1e-12);
    ASSERT_EQ(lines.nodes.size(), 4u);
    for (const std::vector<int>& line : lines.nodes) EXPECT_EQ(line.size(), 5u);
  }
  EXPECT_THROW(lines_of_ring(3, {Vector<3>::UnitZ(), Vector<3>(0, 0.1, 0)}), InputError);
  EXPECT_THROW(lines_of_ring(3, {Vector<3>::UnitX()}), InputError);
}

/// A rim of radius 20 and a face beside it, 4 elements round about by 3 across, subdivided twice:
/// new nodes lie on the chords of what was there before.
SurfaceLines lines_of_subdivided(bool face, int halvings, double across) {
  const Mesh<3> mesh =
      structured_hexahedra(4 << halvings, 3 << halvings, 1, [&](double s, double t, double z) {
        const double place = 4 * s, whole = std::min(3.0, std::floor(place)), part = place - whole,
                     from = 0.1 * whole, to = 0.1 * (whole + 1);
        const auto at = [&](double r, double height) {
          return Vector<3>((1 - part) * r * std::cos(from) + part * r * std::cos(to),
                           (1 - part) * r * std::sin(from) + part * r * std::sin(to), height);
        };
        return face ? at(20 + across * t, z) : at(20 + z, across * t);
      });
  return lines_of_surface<3>(mesh, mesh.boundary.at("top"),
                             {Vector<3>::UnitZ(), Vector<3>::Zero()});
}

TEST(SurfaceLines, AreCirclesWithNodesOnChords) {
  for (const bool face : {false, true})
    for (const int halvings : {1, 2}) {
      const SurfaceLines lines = lines_of_subdivided(face, halvings, 3);
      EXPECT_EQ(lines.nodes.size(), std::size_t(3 << halvings) + 1);
      for (const std::vector<int>& line : lines.nodes)
        EXPECT_EQ(line.size(), std::size_t(4 << halvings) + 1);
    }
  // Circles nearer to each other than chords are deep are not taken for one.
  EXPECT_THROW(lines_of_subdivided(true, 1, 0.05), InputError);
}

TEST(SurfaceLines, MayBeClosed) {
  Mesh<3> mesh;
  constexpr int around = 8;
  for (const double radius : {1.0, 3.0})
    for (int k = 0; k < around; ++k)
      mesh.nodes.emplace_back(radius * std::cos(2 * M_PI * k / around),
                              radius * std::sin(2 * M_PI * k / around), 0);
  std::vector<Mesh<3>::Facet> facets;
  for (int k = 0; k < around; ++k) {
    const int next = (k + 1) % around;
    facets.push_back({k, around + k, around + next, next});
  }
  const SurfaceLines lines =
      lines_of_surface<3>(mesh, facets, {Vector<3>::UnitZ(), Vector<3>::Zero()});
  EXPECT_NEAR(lines.length, 2 * around * std::sin(M_PI / 4), 1e-12);
  EXPECT_EQ(lines.nodes.size(), 2u);
  facets.pop_back();
  EXPECT_NEAR(lines_of_surface<3>(mesh, facets, {Vector<3>::UnitZ(), Vector<3>::Zero()}).length,
              2 * (around - 1) * std::sin(M_PI / 4), 1e-12);
}

TEST(SurfaceLines, AreACircleInThePlane) {
  constexpr int around = 12;
  Mesh<2> mesh;
  std::vector<Mesh<2>::Facet> facets;
  const Streamlines<2> about{Vector<2>::Zero(), Vector<2>(1, 2)};
  for (int k = 0; k < around; ++k) {
    const double angle = 2 * M_PI * k / around;
    mesh.nodes.push_back(*about.centre + 3 * Vector<2>(std::cos(angle), std::sin(angle)));
    facets.push_back({k, (k + 1) % around});
  }
  SurfaceLines lines = lines_of_surface<2>(mesh, facets, about);
  ASSERT_EQ(lines.nodes.size(), 1u);
  EXPECT_EQ(lines.nodes.front().size(), 12u);
  EXPECT_NEAR(lines.length, 3 * around * std::sin(M_PI / 6), 1e-12);
  facets.erase(facets.begin() + 4);
  lines = lines_of_surface<2>(mesh, facets, about);
  EXPECT_THAT(lines.nodes.front(), ::testing::ElementsAre(5, 6, 7, 8, 9, 10, 11, 0, 1, 2, 3, 4));
  EXPECT_NEAR(lines.length, 3 * (around - 1) * std::sin(M_PI / 6), 1e-12);
  facets.erase(facets.begin() + 8);  // two arcs
  EXPECT_THROW(lines_of_surface<2>(mesh, facets, about), InputError);
}

// However small the steps between the radii of its nodes are.
TEST(SurfaceLines, AreNoCircleAboutAnotherPoint) {
  Mesh<2> mesh;
  std::vector<Mesh<2>::Facet> facets;
  for (int k = 0; k < 2000; ++k) {
    const double angle = 2 * M_PI * k / 2000;
    mesh.nodes.emplace_back(3 * std::cos(angle), 3 * std::sin(angle));
    facets.push_back({k, (k + 1) % 2000});
  }
  EXPECT_NO_THROW(lines_of_surface<2>(mesh, facets, {Vector<2>::Zero(), Vector<2>::Zero()}));
  EXPECT_THROW(lines_of_surface<2>(mesh, facets, {Vector<2>::Zero(), Vector<2>(0.01, 0)}),
               InputError);
}

TEST(SurfaceLines, DoNotReachTheAxis) {
  const Mesh<3> mesh = structured_hexahedra(4, 3, 1, [](double s, double t, double z) {
    return Vector<3>(t * std::cos(s), t * std::sin(s), z);
  });
  EXPECT_THROW(
      lines_of_surface<3>(mesh, mesh.boundary.at("top"), {Vector<3>::UnitZ(), Vector<3>::Zero()}),
      InputError);
}

TEST(SurfaceLines, AreStraight) {
  const Vector<2> along = Vector<2>(3, 4) / 5, normal(-along[1], along[0]);
  const Mesh<2> mesh = structured_quadrilaterals(
      5, 1, [&](double s, double t) { return Vector<2>(2 * s * s * along + t * normal); });
  const SurfaceLines lines = lines_of_surface<2>(mesh, mesh.boundary.at("top"), {along});
  ASSERT_EQ(lines.nodes.size(), 1u);
  EXPECT_EQ(lines.nodes.front().size(), 6u);
  EXPECT_NEAR(lines.length, 2, 1e-12);
  EXPECT_THROW(lines_of_surface<2>(mesh, mesh.boundary.at("top"), {Vector<2>(0.6, 0.8001)}),
               InputError);
}

/// The tread of a wheel: its edges follow the direction in which it rolls, as chords.
TEST(SurfaceLines, MayBeCurved) {
  const Mesh<3> mesh = structured_hexahedra(4, 3, 1, [&](double s, double t, double z) {
    const double turn = 0.3 * (2 * s - 1);
    return Vector<3>((1 + z) * std::sin(turn), t, (1 + z) * std::cos(turn));
  });
  const SurfaceLines lines =
      lines_of_surface<3>(mesh, mesh.boundary.at("top"), {Vector<3>::UnitX()});
  EXPECT_NEAR(lines.length, 2 * 2 * std::sin(0.3), 1e-12);
  ASSERT_EQ(lines.nodes.size(), 4u);
  for (const std::vector<int>& line : lines.nodes) {
    EXPECT_EQ(line.size(), 5u);
    for (const int node : line) EXPECT_EQ(mesh.nodes[node][1], mesh.nodes[line.front()][1]);
  }
  const Vector<3> oblique = Vector<3>(1, 1, 0).normalized();
  EXPECT_THROW(lines_of_surface<3>(mesh, mesh.boundary.at("top"), {oblique}), InputError);
}

}  // namespace
}  // namespace gnomon::surface_lines_test
