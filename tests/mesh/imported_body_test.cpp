// What is repaired in a mesh of another program, and what becomes of its groups.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/base/error.hpp>
#include <gnomon/mesh/imported_body.hpp>
#include <random>

#include "support/hexahedra.hpp"
#include "support/imported.hpp"
#include "support/structured_hexahedra.hpp"

namespace gnomon::imported_body_test {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

double area(const Mesh<2>& mesh) {
  double sum = 0;
  for (const auto& cell : mesh.cells) {
    const Vector<2> a = mesh.nodes[cell[2]] - mesh.nodes[cell[0]];
    const Vector<2> b = mesh.nodes[cell[3]] - mesh.nodes[cell[1]];
    sum += (a[0] * b[1] - a[1] * b[0]) / 2;
  }
  return sum;
}

/// Area within the curves that the facets make up, by Green's theorem.
double enclosed_area(const ImportedBody<2>& body) {
  double sum = 0;
  for (const auto& [a, b] : body.exterior) {
    const Vector<2>&X = body.mesh.nodes[a], &Y = body.mesh.nodes[b];
    sum += (X[0] * Y[1] - X[1] * Y[0]) / 2;
  }
  return sum;
}

/// Turns about half of the elements inside out by their order, as files do.
void turn_some(ElementList& list, unsigned seed) {
  std::mt19937 random(seed);
  for (int e = 0; e < list.size(); ++e) {
    if (random() % 2) continue;
    const auto begin = list.nodes.begin() + list.start[e],
               end = list.nodes.begin() + list.start[e + 1];
    if (list.kinds[e] == ElementKind::hexahedron)
      std::swap_ranges(begin, begin + 4, begin + 4);
    else
      std::reverse(begin, end);
  }
}

TEST(ImportedBody, OfAStructuredMeshIsThatMesh) {
  const Mesh<3> mesh = structured_hexahedra(
      3, 2, 4, [](double r, double s, double t) { return Vector<3>(r, s, 2 * t); });
  const ImportedBody<3> body = check_mesh<3>(imported(mesh));
  EXPECT_EQ(body.mesh.nodes, mesh.nodes);
  EXPECT_EQ(body.mesh.cells, mesh.cells);
  ASSERT_EQ(body.mesh.boundary.size(), mesh.boundary.size());
  for (const auto& [name, facets] : mesh.boundary)
    EXPECT_EQ(body.mesh.boundary.at(name).size(), facets.size()) << name;
  EXPECT_EQ(body.exterior.size(), 2u * (3 * 2 + 3 * 4 + 2 * 4));
  EXPECT_EQ(body.cell_groups.at("body").size(), mesh.cells.size());
  EXPECT_EQ(body.node_tags[5], 6);
  EXPECT_EQ(body.cell_tags[5], 506);
}

TEST(ImportedBody, TurnsCellsAndFacetsOfAnyOrientation) {
  for (unsigned seed : {1, 2, 3}) {
    ImportedMesh plane = square(4), space = cube(3);
    for (ImportedMesh* mesh : {&plane, &space}) {
      turn_some(mesh->cells, seed);
      turn_some(mesh->facets, seed + 10);
    }
    const ImportedBody<2> flat = check_mesh<2>(plane);
    EXPECT_NEAR(area(flat.mesh), 1, 1e-14);
    EXPECT_NEAR(enclosed_area(flat), 1, 1e-14);
    EXPECT_THAT(flat.remarks, ElementsAre(HasSubstr("turned to counter-clockwise order")));
    for (const auto& [a, b] : flat.mesh.boundary.at("top"))
      EXPECT_LT(flat.mesh.nodes[b][0], flat.mesh.nodes[a][0]);
    const ImportedBody<3> solid = check_mesh<3>(space);
    expect_sound(solid.mesh);
    EXPECT_NEAR(volume(solid.mesh), 1, 1e-14);
    for (const auto& facet : solid.mesh.boundary.at("top"))
      EXPECT_GT(facet_area(solid.mesh, facet)[2], 0);
  }
}

TEST(ImportedBody, MergesNodesAtOnePlace) {
  // Every cell has nodes of its own, moved by less than the tolerance.
  const ImportedMesh whole = cube(4);
  Builder split(3);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> shift(-3e-9, 3e-9);
  for (int cell = 0; cell < whole.cells.size(); ++cell) {
    std::vector<int> own;
    for (int node : whole.cells.at(cell)) {
      const auto& X = whole.nodes[node];
      own.push_back(split.node(X[0] + shift(random), X[1] + shift(random), X[2] + shift(random)));
    }
    split.mesh.cells.add(ElementKind::hexahedron, 501 + cell, own);
  }
  const ImportedBody<3> body = check_mesh<3>(split.mesh);
  EXPECT_EQ(body.mesh.nodes.size(), 125u);
  EXPECT_EQ(body.exterior.size(), 6u * 16);
  EXPECT_NEAR(volume(body.mesh), 1, 1e-7);
  EXPECT_THAT(body.remarks.at(0), HasSubstr("387 nodes at the place of another were merged"));
}

TEST(ImportedBody, LeavesNodesApartThatAreApart) {
  const Mesh<2> thin =
      structured_quadrilaterals(10, 10, [](double s, double t) { return Vector<2>(s, 1e-6 * t); });
  EXPECT_EQ(check_mesh<2>(imported(thin)).mesh.nodes.size(), 121u);
}

TEST(ImportedBody, LeavesOutNodesOfNoCell) {
  ImportedMesh mesh = square(2);
  mesh.nodes.insert(mesh.nodes.begin(), {5, 5, 0});
  mesh.node_tags.insert(mesh.node_tags.begin(), 99);
  for (ElementList* list : {&mesh.cells, &mesh.facets})
    for (int& node : list->nodes) ++node;
  const ImportedBody<2> body = check_mesh<2>(mesh);
  EXPECT_EQ(body.mesh.nodes.size(), 9u);
  EXPECT_EQ(std::count(body.node_tags.begin(), body.node_tags.end(), 99), 0);
  EXPECT_THAT(body.remarks, ElementsAre(HasSubstr("1 node of no cell was left out")));
}

TEST(ImportedBody, SaysWhichFacetsAreOfNodesOfNoCell) {
  ImportedMesh plane = square(2), space = cube(1);
  plane.nodes.push_back({2, 2, 0});
  plane.node_tags.push_back(10);
  plane.groups.push_back({"loose", 1, {add_facet(plane, {8, 9})}});
  space.nodes.push_back({0, 0, 2});
  space.node_tags.push_back(9);
  space.groups.push_back({"loose", 2, {add_facet(space, {0, 1, 2, 8})}});
  EXPECT_THAT(check_mesh<2>(plane).unusable.at("loose"), HasSubstr("no sides of cells"));
  EXPECT_THAT(check_mesh<3>(space).unusable.at("loose"), HasSubstr("no sides of cells"));
}

TEST(ImportedBody, TakesCellsOnceThatAreListedInTwoGroups) {
  ImportedMesh mesh = square(2);
  mesh.cells.add(ElementKind::quadrilateral, 900,
                 std::vector<int>(mesh.cells.at(1).begin(), mesh.cells.at(1).end()));
  mesh.groups.push_back({"half", 2, {4}});
  const ImportedBody<2> body = check_mesh<2>(mesh);
  EXPECT_EQ(body.mesh.cells.size(), 4u);
  EXPECT_THAT(body.cell_groups.at("half"), ElementsAre(1));
  EXPECT_THAT(body.remarks, ElementsAre(HasSubstr("1 cell listed twice")));
}

TEST(ImportedBody, TakesAConstantHeightForZero) {
  ImportedMesh mesh = square(2);
  for (auto& X : mesh.nodes) X[2] = 7.5;
  EXPECT_THAT(check_mesh<2>(mesh).remarks, ElementsAre(HasSubstr("z = 7.5")));
}

TEST(ImportedBody, RemarksBadlyShapedAndLongCells) {
  ImportedMesh bad = square(2);
  bad.nodes[4] = {0.735, 0.245, 0};  // an angle of nearly 180 degrees
  EXPECT_THAT(check_mesh<2>(bad).remarks, ElementsAre(HasSubstr("badly shaped")));
  const Mesh<2> thin =
      structured_quadrilaterals(2, 2, [](double s, double t) { return Vector<2>(5000 * s, t); });
  EXPECT_THAT(check_mesh<2>(imported(thin)).remarks,
              ElementsAre(HasSubstr("5e+03 times the shortest")));
}

TEST(ImportedBody, TakesFacetsOnceAndJoinsGroupsOfOneName) {
  ImportedMesh mesh = square(3);
  MeshGroup& bottom = mesh.groups[0];
  ASSERT_EQ(bottom.name, "bottom");
  bottom.members.push_back(add_facet(mesh, {1, 0}));  // again, the other way round
  mesh.groups.push_back({"bottom", 1, {bottom.members[1]}});
  const ImportedBody<2> body = check_mesh<2>(mesh);
  EXPECT_EQ(body.mesh.boundary.at("bottom").size(), 3u);
  EXPECT_THAT(body.remarks,
              ElementsAre(HasSubstr("several groups of curves are called \"bottom\"")));
}

TEST(ImportedBody, SaysWhichPartsOverlap) {
  ImportedMesh mesh = square(3);
  mesh.groups.push_back({"wear", 1, {mesh.groups[0].members[2], mesh.groups[2].members[0]}});
  const ImportedBody<2> body = check_mesh<2>(mesh);
  EXPECT_THAT(body.remarks, ElementsAre(HasSubstr("\"bottom\" and \"wear\" have 1 facet in common"),
                                        HasSubstr("\"right\" and \"wear\" have 1 facet")));
}

/// Why a name is no boundary part.
template <int dim>
std::string refusal(const ImportedBody<dim>& body, const std::string& name) {
  try {
    boundary_part(body, name);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BoundaryPart, IsRefusedWithWhatTheMeshHas) {
  ImportedMesh mesh = square(2);
  mesh.groups.push_back({"empty", 1, {}});
  mesh.groups.push_back({"inside", 1, {add_facet(mesh, {1, 4}), mesh.groups[0].members[0]}});
  mesh.groups.push_back({"across", 1, {add_facet(mesh, {0, 4})}});
  mesh.groups.push_back({"spots", 0, {0, 8}});
  const ImportedBody<2> body = check_mesh<2>(mesh);
  EXPECT_EQ(refusal(body, "bottom"), "accepted");
  EXPECT_THAT(refusal(body, "botom"), HasSubstr("part.msh: has no curve called \"botom\", did you "
                                                "mean \"bottom\"? It has \"bottom\", \"left\""));
  EXPECT_THAT(refusal(body, "surface of the pin"),
              HasSubstr("it has \"bottom\", \"left\", \"right\""));
  EXPECT_THAT(refusal(body, "empty"), HasSubstr("\"empty\" has no elements"));
  EXPECT_THAT(
      refusal(body, "inside"),
      HasSubstr("1 of its 2 facets lie inside the body, or its nodes coincide with those of "
                "another side, the first has the number 109"));
  EXPECT_THAT(refusal(body, "across"), HasSubstr("1 of its 1 facets are no sides of cells"));
  EXPECT_THAT(refusal(body, "body"), HasSubstr("is a group of surfaces, expected one of curves"));
  EXPECT_THAT(refusal(body, "spots"), HasSubstr("is a group of points, expected one of curves"));
  EXPECT_EQ(body.point_groups.at("spots").size(), 2u);
  // Where points will do, they are among the names.
  EXPECT_EQ(group_nodes(body, "spots"), body.point_groups.at("spots"));
  EXPECT_EQ(group_nodes(body, "bottom"), body.mesh.boundary_nodes("bottom"));
  try {
    group_nodes(body, "spot");
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean \"spots\"? It has \"bottom\""));
  }
  mesh.groups.clear();
  EXPECT_THAT(refusal(check_mesh<2>(mesh), "bottom"),
              HasSubstr("has no curve called \"bottom\", nor any other; in Gmsh: Physical Curve"));
}

TEST(BoundaryPart, OfTrianglesOnHexahedraIsRefused) {
  ImportedMesh mesh = cube(1);
  mesh.groups.push_back({"split", 2, {add_facet(mesh, {0, 1, 2})}});
  mesh.groups.push_back({"edge", 1, {0, 1}});
  const ImportedBody<3> body = check_mesh<3>(mesh);
  EXPECT_THAT(refusal(body, "split"), HasSubstr("are no sides of cells"));
  EXPECT_THAT(refusal(body, "edge"), HasSubstr("is a group of curves, expected one of surfaces"));
}

}  // namespace
}  // namespace gnomon::imported_body_test
