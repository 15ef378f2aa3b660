#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/mesh/imported_body.hpp>
#include <random>

#include "mesh/import_nodes.hpp"
#include "support/hexahedra.hpp"
#include "support/imported.hpp"

namespace gnomon::subdivision_test {
namespace {

using namespace testing;
using Kind = ElementKind;

double cross(const Vector<2>& a, const Vector<2>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

double area(const Mesh<2>& mesh) {
  double sum = 0;
  for (const auto& cell : mesh.cells)
    sum += cross(mesh.nodes[cell[2]] - mesh.nodes[cell[0]],
                 mesh.nodes[cell[3]] - mesh.nodes[cell[1]]) /
           2;
  return sum;
}

/// A square of cells, of which those of a chessboard's one colour are cut into triangles, with
/// its inner nodes moved.
ImportedMesh mixed_square(bool all) {
  constexpr int n = 6;
  ImportedMesh mesh = square(n);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-0.03, 0.03);
  for (auto& X : mesh.nodes)
    if (X[0] > 0 && X[0] < 1 && X[1] > 0 && X[1] < 1)
      X = {X[0] + shift(random), X[1] + shift(random), 0};
  return with_triangles(std::move(mesh),
                        [all](int cell) { return all || (cell + cell / n) % 2 == 0; });
}

TEST(Subdivision, OfTrianglesAndQuadrilateralsKeepsTheArea) {
  for (bool all : {true, false}) {
    const ImportedMesh mesh = mixed_square(all);
    const ImportedBody<2> body = check_mesh<2>(mesh);
    EXPECT_EQ(body.mesh.cells.size(), all ? 6u * 36 : 6u * 18 + 4u * 18);
    EXPECT_NEAR(area(body.mesh), 1, 1e-14);
    EXPECT_EQ(body.exterior.size(), 2u * 24);
    for (const char* name : {"bottom", "right", "top", "left"})
      EXPECT_EQ(body.mesh.boundary.at(name).size(), 12u) << name;
    EXPECT_THAT(body.remarks, ::testing::Contains(::testing::HasSubstr("were subdivided into")));
  }
}

/// A cube cut into six tetrahedra along a diagonal, every cell of n^3; inner nodes moved.
ImportedMesh tetrahedra(int n) {
  ImportedMesh mesh = cube(n);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-0.05, 0.05);
  for (auto& X : mesh.nodes)
    if (std::all_of(X.begin(), X.end(), [](double x) { return x > 0 && x < 1; }))
      for (double& x : X) x += shift(random) / n;
  ElementList cut;
  // The paths from corner 0 to corner 6, one for each order of the axes.
  constexpr int paths[6][2] = {{1, 2}, {3, 2}, {1, 5}, {4, 5}, {3, 7}, {4, 7}};
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const auto c = mesh.cells.at(cell);
    for (const auto& [a, b] : paths)
      cut.add(Kind::tetrahedron, cell, std::array{c[0], c[a], c[b], c[6]});
  }
  mesh.cells = cut;
  ElementList triangles;
  for (int facet = 0; facet < mesh.facets.size(); ++facet) {
    // Diagonals of opposite sides are parallel: from the least to the greatest corner.
    const auto f = mesh.facets.at(facet);
    const auto least = std::min_element(f.begin(), f.end()) - f.begin();
    const auto at = [&](int k) { return f[(least + k) % 4]; };
    triangles.add(Kind::triangle, facet, std::array{at(0), at(1), at(2)});
    triangles.add(Kind::triangle, facet, std::array{at(0), at(2), at(3)});
  }
  mesh.facets = triangles;
  for (MeshGroup& group : mesh.groups) {
    std::vector<int> both;
    for (int member : group.members)
      if (group.dimension == 2) both.insert(both.end(), {2 * member, 2 * member + 1});
    group.members = both;
  }
  return mesh;
}

TEST(Subdivision, OfTetrahedraKeepsTheVolumeAndFitsAtEveryFacet) {
  const ImportedBody<3> body = check_mesh<3>(tetrahedra(3));
  EXPECT_EQ(body.mesh.cells.size(), 4u * 6 * 27);
  EXPECT_NEAR(volume(body.mesh), 1, 1e-13);
  expect_sound(body.mesh);
  EXPECT_EQ(body.exterior.size(), 6u * 9 * 2 * 3);
  for (const char* name : {"bottom", "top", "left", "right", "front", "back"}) {
    double area = 0;
    for (const auto& facet : body.mesh.boundary.at(name))
      area += facet_area(body.mesh, facet).norm();
    EXPECT_NEAR(area, 1, 1e-14) << name;
  }
}

TEST(Subdivision, OfWedgesAndHexahedraSideBySide) {
  // A cube and half a cube behind it, cut along the diagonal.
  Builder b(3);
  for (double z : {0, 1})
    for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}}) b.node(x, y, z);
  b.cell(Kind::hexahedron, {0, 1, 2, 3, 5, 6, 7, 8});
  b.cell(Kind::wedge, {1, 4, 2, 6, 9, 7});
  const int low = b.facet(Kind::triangle, {1, 4, 2}),
            side = b.facet(Kind::quadrilateral, {4, 2, 7, 9});
  b.group("low", 2, {low});
  b.group("side", 2, {side});
  const ImportedBody<3> body = check_mesh<3>(b.mesh);
  EXPECT_EQ(body.mesh.cells.size(), 8u + 6);
  EXPECT_NEAR(volume(body.mesh), 1.5, 1e-14);
  double enclosed = 0;  // by the outer facets alone, since neighbours share the others
  for (const auto& facet : body.exterior) enclosed += cone_volume(body.mesh, facet);
  EXPECT_NEAR(enclosed, 1.5, 1e-14);
  EXPECT_EQ(body.mesh.boundary.at("low").size(), 3u);
  EXPECT_EQ(body.mesh.boundary.at("side").size(), 4u);
  EXPECT_EQ(body.remarks,
            std::vector<std::string>{"1 hexahedron and 1 wedge were subdivided into 14 hexahedra"});
}

TEST(Subdivision, NamesPartsByTheElementTheyComeFrom) {
  const ImportedMesh mesh = subdivide(tetrahedra(1));
  ASSERT_EQ(mesh.cells.size(), 24);
  EXPECT_EQ(mesh.cells.tags, std::vector<std::int64_t>(24, 0));
  EXPECT_EQ(mesh.node_tags[7], 8);
  EXPECT_EQ(mesh.node_tags[8], 0);
}

}  // namespace
}  // namespace gnomon::subdivision_test
