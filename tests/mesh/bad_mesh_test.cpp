// Every kind of bad mesh is refused in one line that says what, where and what was expected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/imported_body.hpp>
#include <limits>

#include "support/imported.hpp"

namespace gnomon::bad_mesh_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

using Kind = ElementKind;

struct BadMesh {
  const char* name;
  int dim;  // asked for
  std::function<ImportedMesh()> make;
  std::vector<const char*> said;
};

void PrintTo(const BadMesh& bad, std::ostream* stream) {
  *stream << bad.name;
}

/// The unit square of n x n cells after a change.
std::function<ImportedMesh()> changed_square(int n, std::function<void(ImportedMesh&)> change) {
  return [n, change] {
    ImportedMesh mesh = square(n);
    change(mesh);
    return mesh;
  };
}

std::function<ImportedMesh()> changed_cube(int n, std::function<void(ImportedMesh&)> change) {
  return [n, change] {
    ImportedMesh mesh = cube(n);
    change(mesh);
    return mesh;
  };
}

/// A cell of 1 x 1 beside two of half its height.
ImportedMesh hanging_in_the_plane() {
  Builder b(2);
  for (double x : {0, 1, 2})
    for (double y : {0, 1}) b.node(x, y);
  const int low = b.node(1, 0.5), right = b.node(2, 0.5);
  b.cell(Kind::quadrilateral, {0, 2, 3, 1});
  b.cell(Kind::quadrilateral, {2, 4, right, low});
  b.cell(Kind::quadrilateral, {low, right, 5, 3});
  return b.mesh;
}

/// A cube beside one of a quarter of its side.
ImportedMesh hanging_in_space() {
  Builder b(3);
  const auto brick = [&b](double x, double width, double height) {
    std::vector<int> n;
    for (double z : {0.0, height})
      for (const auto& [dx, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, width}, {0.0, width}})
        n.push_back(b.node(x + dx, y, z));
    b.cell(Kind::hexahedron, {n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7]});
  };
  brick(0, 1, 1);
  brick(1, 0.5, 0.5);
  return b.mesh;
}

ImportedMesh without_cells(ImportedMesh mesh, std::initializer_list<int> gone) {
  ElementList kept;
  for (int cell = 0; cell < mesh.cells.size(); ++cell)
    if (std::find(gone.begin(), gone.end(), cell) == gone.end())
      kept.add(mesh.cells.kinds[cell], mesh.cells.tags[cell], mesh.cells.at(cell));
  mesh.cells = kept;
  mesh.groups.clear();
  return mesh;
}

ImportedMesh pyramid() {
  Builder b(3);
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) b.node(x, y);
  const int tip = b.node(0.5, 0.5, 1);
  b.cell(Kind::pyramid, {0, 1, 2, 3, tip});
  return b.mesh;
}

/// Triangles upon a quadrilateral.
ImportedMesh covered_twice() {
  Builder b(2);
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) b.node(x, y);
  b.cell(Kind::quadrilateral, {0, 1, 2, 3});
  b.cell(Kind::triangle, {0, 1, 2});
  b.cell(Kind::triangle, {0, 2, 3});
  return b.mesh;
}

/// One quadrilateral.
std::function<ImportedMesh()> quadrilateral(std::array<std::array<double, 2>, 4> corners) {
  return [corners] {
    Builder b(2);
    for (const auto& [x, y] : corners) b.node(x, y);
    b.cell(Kind::quadrilateral, {0, 1, 2, 3});
    return b.mesh;
  };
}

const BadMesh bad_meshes[] = {
    {"OnlyCurves",
     2,
     changed_square(1, [](ImportedMesh& m) { m.dimension = 1; }),
     {"has no cells", "Physical Surface"}},
    {"NoCells",
     2,
     changed_square(1, [](ImportedMesh& m) { m.cells = {}; }),
     {"has no cells, only points or curves"}},
    {"PlaneForSpace",
     3,
     [] { return square(1); },
     {"is a mesh in 2D, expected one in 3D", "Physical Volume"}},
    {"SpaceForPlane", 2, [] { return cube(1); }, {"is a mesh in 3D, expected one in 2D"}},
    {"NotANumber",
     2,
     changed_square(2, [](ImportedMesh& m) { m.nodes[4][1] = std::nan(""); }),
     {"node 5 lies at (0.5, nan, 0), expected finite coordinates"}},
    {"Infinite",
     2,
     changed_square(
         2, [](ImportedMesh& m) { m.nodes[0][0] = std::numeric_limits<double>::infinity(); }),
     {"node 1 lies at (inf, 0, 0)"}},
    {"FarBeyondAllNumbers",
     3,
     changed_cube(1, [](ImportedMesh& m) { m.nodes[7][2] = 1e200; }),
     {"node 8 lies at (1, 1, 1e+200)"}},
    {"OnePlace",
     2,
     changed_square(1,
                    [](ImportedMesh& m) {
                      m.nodes.assign(4, {1, 2, 0});
                    }),
     {"all its nodes at one place"}},
    {"UnknownNode",
     2,
     changed_square(1, [](ImportedMesh& m) { m.cells.nodes[2] = 77; }),
     {"element 501 has a node that is not in the file"}},
    {"UnknownNodeOfAFacet",
     2,
     changed_square(1, [](ImportedMesh& m) { m.facets.nodes[2] = -4; }),
     {"element 102 has a node that is not in the file"}},
    {"PlaneOfXAndZ",
     2,
     changed_square(1,
                    [](ImportedMesh& m) {
                      for (auto& X : m.nodes) std::swap(X[1], X[2]);
                    }),
     {"plane of x and z, expected that of x and y", "Rotate"}},
    {"PlaneOfYAndZ",
     2,
     changed_square(1,
                    [](ImportedMesh& m) {
                      for (auto& X : m.nodes) std::swap(X[0], X[2]);
                    }),
     {"plane of y and z"}},
    {"SurfaceInSpace",
     2,
     changed_square(2, [](ImportedMesh& m) { m.nodes[4][2] = 0.25; }),
     {"is a surface in space (z from 0 to 0.25)"}},
    {"CornerTwice",
     2,
     changed_square(1, [](ImportedMesh& m) { m.cells.nodes[2] = m.cells.nodes[1]; }),
     {"element 501 has two corners at one node", "expected a quadrilateral"}},
    {"CornersMerged",
     2,
     quadrilateral({{{0, 0}, {1, 0}, {1, 1e-12}, {0, 1}}}),
     {"element 501 has two corners at one node"}},
    {"Crossing",
     2,
     quadrilateral({{{0, 0}, {1, 0}, {0, 1}, {1, 1}}}),
     {"element 501 at (0.5, 0.5) crosses itself"}},
    {"Folded",
     2,
     quadrilateral({{{0, 0}, {4, 0}, {1, 1}, {0, 4}}}),
     {"element 501 at (1.25, 1.25) is folded", "below 180 degrees"}},
    {"StraightAngle", 2, quadrilateral({{{0, 0}, {2, 0}, {1, 1}, {0, 2}}}), {"is folded"}},
    {"NoArea", 2, quadrilateral({{{0, 0}, {1, 0}, {3, 0}, {4, 0}}}), {"has no area"}},
    {"NoVolume",
     3,
     changed_cube(1,
                  [](ImportedMesh& m) {
                    for (auto& [x, y, z] : m.nodes) x += 0.3 * z, y += 0.1 * z, z = 0;
                  }),
     {"element 501", "has no volume"}},
    {"FoldedInSpace",
     3,
     changed_cube(1,
                  [](ImportedMesh& m) {
                    m.nodes[0] = {0.9, 0.9, 0.9};
                  }),
     {"element 501", "is folded", "positive Jacobian"}},
    {"FoldedByOneNode",
     3,
     changed_cube(3,
                  [](ImportedMesh& m) {
                    m.nodes[21] = {1.2, 0.3, 0.3};
                  }),
     {"is folded"}},
    {"Overlapping",
     2,
     changed_square(2,
                    [](ImportedMesh& m) {
                      m.cells.add(Kind::quadrilateral, 900, std::array{1, 5, 8, 4});
                    }),
     {"more than two cells meet at a side of element"}},
    {"CoveredTwice",
     2,
     covered_twice,
     {"element 501 at (0.25, 0.25) and element 502 at", "overlap, expected cells side by side"}},
    {"HangingNode", 2, hanging_in_the_plane, {"node 7 hangs", "(1, 0.5)", "Coherence"}},
    {"HangingNodeInSpace", 3, hanging_in_space, {"hangs", "side of a cell"}},
    {"TwoParts",
     2,
     [] {
       return without_cells(square(3), {1, 4, 7});
     },
     {"consists of 2 parts", "3 cells with element 501", "element 503", "as a Physical Surface"}},
    {"PartsThatTouchInANode",
     2,
     [] {
       return without_cells(square(2), {1, 2});
     },
     {"consists of 2 parts that share no side"}},
    {"PartsThatTouchInAnEdge",
     3,
     [] {
       return without_cells(cube(2), {1, 2, 5, 6});
     },
     {"consists of 2 parts that share no side", "[[body]] for each", "as a Physical Volume"}},
    {"PinchedNode",
     2,
     [] {
       return without_cells(square(4), {6, 9});
     },
     {"touches itself in node 13 at (0.5, 0.5) only"}},
    {"PinchedEdge",
     3,
     [] {
       return without_cells(cube(2), {0, 3});
     },
     {"touches itself in the edge from node"}},
    {"Pyramid", 3, pyramid, {"element 501 is a pyramid", "hexahedra, tetrahedra or wedges"}},
};

class BadMeshes : public ::testing::TestWithParam<BadMesh> {};

TEST_P(BadMeshes, AreRefusedInOneLine) {
  std::string message;
  try {
    if (GetParam().dim == 2)
      check_mesh<2>(GetParam().make());
    else
      check_mesh<3>(GetParam().make());
    FAIL() << "accepted";
  } catch (const InputError& error) {
    message = error.what();
  }
  EXPECT_THAT(message, ::testing::StartsWith("part.msh: "));
  for (const char* said : GetParam().said) EXPECT_THAT(message, HasSubstr(said));
  EXPECT_EQ(message.find('\n'), message.npos);
}

INSTANTIATE_TEST_SUITE_P(All, BadMeshes, ::testing::ValuesIn(bad_meshes),
                         [](const auto& info) { return info.param.name; });

TEST(BadMeshes, SoundOnesAreTaken) {
  EXPECT_EQ(check_mesh<2>(square(3)).remarks, std::vector<std::string>());
  EXPECT_EQ(check_mesh<3>(cube(2)).remarks, std::vector<std::string>());
}

}  // namespace
}  // namespace gnomon::bad_mesh_test
