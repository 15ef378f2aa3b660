// Cells split into four or eight: the boundary stays on circles and spheres, and flat where it was.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/imported_body.hpp>

#include "support/hexahedra.hpp"
#include "support/imported.hpp"

namespace gnomon::splitting_test {
namespace {

using namespace testing;

/// A quarter of a ring of radii 1 and 2; elements along the circle become longer.
ImportedMesh ring(int elements) {
  return imported<2>(structured_quadrilaterals(elements, 3, [](double s, double t) {
    const double angle = M_PI_2 * (1 - s) * (1 - 0.2 * s), radius = 1 + t;
    return Vector<2>(radius * std::cos(angle), radius * std::sin(angle));
  }));
}

/// A part of a hollow ball of radii 1 and 2, between planes through its centre.
ImportedMesh shell(int elements) {
  return imported<3>(structured_hexahedra(elements, elements, 2, [](double r, double s, double t) {
    return Vector<3>(Vector<3>(r - 0.3, s - 0.4, 1).normalized() * (1 + t));
  }));
}

/// A quarter of a pipe of radii 1 and 2, of length 1.
ImportedMesh pipe(int elements) {
  return imported<3>(structured_hexahedra(elements, 2, 2, [](double r, double s, double t) {
    const double angle = M_PI_2 * (1 - r), radius = 1 + t;
    return Vector<3>(radius * std::cos(angle), radius * std::sin(angle), -s);
  }));
}

/// How far the nodes of a part are from a radius about an axis (2D, and `along_z`) or a point.
template <int dim>
double deviation(const ImportedBody<dim>& body, const std::string& part, double radius,
                 bool along_z = false) {
  double most = 0;
  for (const auto& facet : body.mesh.boundary.at(part))
    for (int node : facet) {
      Vector<dim> X = body.mesh.nodes[node];
      if (along_z) X[dim - 1] = 0;
      most = std::max(most, std::abs(X.norm() - radius));
    }
  return most;
}

TEST(Splitting, KeepsCircles) {
  for (const int elements : {3, 8})
    for (const int splits : {1, 3})
      for (const auto& [part, radius] : {std::pair("bottom", 1.0), {"top", 2.0}})
        EXPECT_LT(deviation(check_mesh<2>(ring(elements), {}, splits), part, radius), 1e-14);
}

/// How far the boundary of the unit circle is off, that is stretched to an ellipse for the split.
double off_ellipse(int elements, int splits) {
  ImportedMesh mesh = ring(elements);
  for (auto& X : mesh.nodes) X[0] *= 2;
  ImportedBody<2> body = check_mesh<2>(mesh, {}, splits);
  for (auto& X : body.mesh.nodes) X[0] /= 2;
  return deviation(body, "bottom", 1);
}

TEST(Splitting, FollowsOtherCurvesWithFourthOrder) {
  EXPECT_LT(off_ellipse(16, 1), 1e-4);
  EXPECT_GT(off_ellipse(8, 1) / off_ellipse(16, 1), 11);  // 16
  EXPECT_LT(off_ellipse(16, 3), 2 * off_ellipse(16, 1));  // further splits follow the same curve
}

ImportedMesh of_triangles(ImportedMesh mesh) {
  return with_triangles(std::move(mesh), [](int) { return true; });
}

// Unsplit they keep their chords, whose middles are nodes.
TEST(Splitting, KeepsCirclesOfTriangles) {
  EXPECT_GT(deviation(check_mesh<2>(of_triangles(ring(4)), {}, 0), "bottom", 1), 1e-3);
  EXPECT_LT(deviation(check_mesh<2>(of_triangles(ring(4)), {}, 1), "bottom", 1), 1e-14);
  EXPECT_LT(deviation(check_mesh<2>(of_triangles(ring(4)), {}, 2), "top", 2), 1e-14);
}

// Two bodies: the inner row of cells is one of its own.
TEST(Splitting, KeepsTheCircleBetweenBodies) {
  ImportedMesh mesh = ring(4);
  std::erase_if(mesh.groups, [](const MeshGroup& group) { return group.dimension == 2; });
  mesh.groups.push_back({"lining", 2, {0, 1, 2, 3}});
  mesh.groups.push_back({"body", 2, {4, 5, 6, 7, 8, 9, 10, 11}});
  const ImportedBody<2> body = check_mesh<2>(mesh, {}, 2);
  int on_bond = 0;
  for (const auto& X : body.mesh.nodes) on_bond += std::abs(X.norm() - 4.0 / 3) < 1e-14;
  EXPECT_EQ(on_bond, 17);
}

TEST(Splitting, KeepsStraightSidesAndCorners) {
  const ImportedBody<2> body = check_mesh<2>(ring(4), {}, 2);
  EXPECT_EQ(body.mesh.cells.size(), 16u * 12);
  for (const auto& facet : body.mesh.boundary.at("right"))
    for (int node : facet) EXPECT_NEAR(body.mesh.nodes[node][1], 0, 1e-15);
  const ImportedBody<2> square = check_mesh<2>(testing::square(2), {}, 2);
  EXPECT_EQ(square.mesh.boundary.at("top").size(), 8u);
  for (const auto& X : square.mesh.nodes) {
    EXPECT_EQ(std::fmod(8 * X[0], 1), 0);
    EXPECT_EQ(std::fmod(8 * X[1], 1), 0);
  }
}

TEST(Splitting, KeepsSpheres) {
  for (const auto& [part, radius] : {std::pair("bottom", 1.0), {"top", 2.0}}) {
    const double coarse = deviation(check_mesh<3>(shell(3), {}, 1), part, radius),
                 fine = deviation(check_mesh<3>(shell(6), {}, 1), part, radius);
    EXPECT_LT(fine, 1e-4 * radius);
    EXPECT_GT(coarse / fine, 9);
  }
}

TEST(Splitting, KeepsRimsAndFlatEndsInSpace) {
  for (const auto& [part, radius] : {std::pair("bottom", 1.0), {"top", 2.0}})
    EXPECT_LT(deviation(check_mesh<3>(pipe(4), {}, 2), part, radius, true), 1e-13);
  const ImportedBody<3> body = check_mesh<3>(pipe(4), {}, 1);
  EXPECT_EQ(body.mesh.cells.size(), 8u * 16);
  expect_sound(body.mesh);
  for (const auto& facet : body.mesh.boundary.at("front"))
    for (int node : facet) EXPECT_NEAR(body.mesh.nodes[node][2], 0, 1e-15);
  // The volume is that of the pipe, much more nearly than that of the coarse mesh.
  const double exact = 3 * M_PI / 4;
  EXPECT_LT(std::abs(volume(body.mesh) - exact),
            0.3 * std::abs(volume(check_mesh<3>(pipe(4)).mesh) - exact));
}

TEST(Splitting, RefusesMoreCellsThanFit) {
  try {
    check_mesh<3>(cube(5), {}, 6);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("125 cells split 6 times are more than 20"));
  }
}

}  // namespace
}  // namespace gnomon::splitting_test
