// Order along the boundary in the plane, and contact patches on it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/mesh/imported_body.hpp>
#include <numbers>
#include <random>

#include "support/imported.hpp"

namespace gnomon::boundary_order_test {
namespace {

using namespace testing;

/// The same mesh with its nodes, cells and facets in any order, as unstructured meshers leave them.
ImportedMesh shuffled(const ImportedMesh& mesh, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<int> now(mesh.nodes.size());
  for (std::size_t n = 0; n < now.size(); ++n) now[n] = static_cast<int>(n);
  std::shuffle(now.begin(), now.end(), random);
  ImportedMesh result = mesh;
  for (std::size_t n = 0; n < now.size(); ++n) {
    result.nodes[now[n]] = mesh.nodes[n];
    result.node_tags[now[n]] = mesh.node_tags[n];
  }
  for (ElementList* list : {&result.cells, &result.facets})
    for (int& node : list->nodes) node = now[node];
  for (MeshGroup& group : result.groups)
    std::shuffle(group.members.begin(), group.members.end(), random);
  return result;
}

/// A ring of 24 x 2 cells; boundary "inner" and "outer", closed.
ImportedMesh ring() {
  Builder b(2);
  constexpr int around = 24, layers = 2;
  for (int j = 0; j <= layers; ++j)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      b.node((1 + j) * std::cos(angle), (1 + j) * std::sin(angle));
    }
  std::vector<int> inner, outer;
  for (int i = 0; i < around; ++i) {
    const int next = (i + 1) % around;
    for (int j = 0; j < layers; ++j)
      b.cell(ElementKind::quadrilateral,
             {j * around + i, (j + 1) * around + i, (j + 1) * around + next, j * around + next});
    inner.push_back(b.facet(ElementKind::line, {i, next}));
    outer.push_back(b.facet(ElementKind::line, {layers * around + i, layers * around + next}));
  }
  b.group("inner", 1, inner);
  b.group("outer", 1, outer);
  b.group("arc", 1, {outer.end()[-2], outer.end()[-1], outer[0], outer[1]});
  return b.mesh;
}

/// Facets follow each other, the numbers of their nodes ascend, and the body lies to the left.
void expect_in_order(const ImportedBody<2>& body, const std::string& name, bool closed) {
  const auto& facets = body.mesh.boundary.at(name);
  for (std::size_t k = 0; k + 1 < facets.size(); ++k) {
    EXPECT_EQ(facets[k][1], facets[k + 1][0]) << name;
    EXPECT_LT(facets[k][0], facets[k][1]) << name;
  }
  EXPECT_EQ(facets.back()[1] == facets.front()[0], closed) << name;
  EXPECT_EQ(facets.back()[0] < facets.back()[1], !closed) << name;
}

TEST(BoundaryOrder, AscendsAlongTheSurfaceThatIsAskedFor) {
  // All four sides have names, so the numbers cannot ascend along each of them.
  for (unsigned seed : {1, 2, 3, 4})
    for (const char* name : {"bottom", "right", "top", "left"})
      expect_in_order(check_mesh<2>(shuffled(square(6), seed), {name}), name, false);
}

TEST(BoundaryOrder, KeepsPartsWholeWhereOnlySomeOfTheBoundaryIsNamed) {
  ImportedMesh mesh = square(6);
  std::erase_if(mesh.groups, [](const MeshGroup& group) {
    return group.name != "top" && group.name != "left" && group.name != "body";
  });
  for (unsigned seed : {1, 2, 3, 4}) {
    const ImportedBody<2> body = check_mesh<2>(shuffled(mesh, seed));
    expect_in_order(body, "top", false);
    expect_in_order(body, "left", false);
  }
}

TEST(BoundaryOrder, OfClosedCurvesAndOfAnArcOnOne) {
  for (unsigned seed : {1, 2, 3, 4}) {
    const ImportedBody<2> body = check_mesh<2>(shuffled(ring(), seed));
    expect_in_order(body, "inner", true);
    expect_in_order(body, "outer", true);
    expect_in_order(body, "arc", false);
  }
}

TEST(ContactPatches, OfAClosedCurveLookOutwardsAndHaveItsLength) {
  const ImportedBody<2> body = check_mesh<2>(shuffled(ring(), 5));
  for (const auto& [name, sign, radius] : {std::tuple{"outer", 1, 3.0}, {"inner", -1, 1.0}}) {
    const auto patches = contact_patches<2>(body.mesh, body.mesh.boundary.at(name), body.exterior);
    ASSERT_EQ(patches.size(), 24u);
    double length = 0;
    for (const auto& patch : patches) {
      EXPECT_EQ(patch.corners.size(), 2u);
      EXPECT_TRUE(patch.corners_beyond.empty());
      EXPECT_NEAR((patch.initial_normal - sign * patch.initial_position / radius).norm(), 0, 1e-14);
      length += patch.initial_area;
    }
    EXPECT_NEAR(length, 48 * radius * std::sin(std::numbers::pi / 24), 1e-13);
  }
}

TEST(ContactPatches, AtCornersSeeTheSideBeyond) {
  const ImportedBody<2> body = check_mesh<2>(shuffled(square(3), 6));
  const auto patches = contact_patches<2>(body.mesh, body.mesh.boundary.at("top"), body.exterior);
  ASSERT_EQ(patches.size(), 4u);
  for (const auto& patch : patches) {
    const double x = patch.initial_position[0];
    const bool end = x == 0 || x == 1;
    EXPECT_EQ(patch.corners.size(), end ? 1u : 2u);
    EXPECT_EQ(patch.corners_beyond.size(), end ? 1u : 0u);
    EXPECT_EQ(patch.initial_normal, Vector<2>(0, 1));
  }
}

TEST(ContactPatches, InSpaceSeeTheSidesBeyond) {
  const ImportedBody<3> body = check_mesh<3>(shuffled(cube(3), 7));
  const auto patches = contact_patches<3>(body.mesh, body.mesh.boundary.at("top"), body.exterior);
  ASSERT_EQ(patches.size(), 16u);
  double area = 0;
  for (const auto& patch : patches) {
    const std::size_t all = patch.corners.size() + patch.corners_beyond.size();
    const bool corner = patch.corners.size() == 1;
    EXPECT_EQ(all, corner ? 3u : 4u);
    EXPECT_EQ(patch.initial_normal, Vector<3>(0, 0, 1));
    area += patch.initial_area;
  }
  EXPECT_NEAR(area, 1, 1e-14);
}

}  // namespace
}  // namespace gnomon::boundary_order_test
