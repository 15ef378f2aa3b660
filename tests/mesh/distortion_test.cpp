#include <gnomon/mesh/distortion.hpp>
#include <random>

#include "support/hexahedra.hpp"
#include "support/structured_hexahedra.hpp"

namespace gnomon::distortion_test {
namespace {

using namespace testing;

Mesh<2> rectangles() {
  return structured_quadrilaterals(20, 30,
                                   [](double s, double t) { return Vector<2>(2 * s, 1 + 30 * t); });
}

Mesh<3> boxes() {
  return structured_hexahedra(
      6, 5, 4, [](double r, double s, double t) { return Vector<3>(2 * r, 3 * s, t); });
}

/// Nodes on the boundary stay, those inside move by up to `most` in each component, most of them by
/// more than a tenth of it.
template <int dim>
void expect_moved_inside(const Mesh<dim>& before, const Mesh<dim>& after, double most) {
  std::set<int> boundary;
  for (const auto& [name, part] : before.boundary)
    for (int node : before.boundary_nodes(name)) boundary.insert(node);
  long moved = 0;
  for (int node = 0; node < static_cast<int>(before.nodes.size()); ++node) {
    const double way = (after.nodes[node] - before.nodes[node]).cwiseAbs().maxCoeff();
    EXPECT_LE(way, boundary.contains(node) ? 0 : most);
    moved += way > most / 10;
  }
  EXPECT_GT(moved, 0.95 * static_cast<double>(before.nodes.size() - boundary.size()));
}

TEST(Distortion, MovesNodesInsideOnlyAndKeepsRectanglesConvex) {
  Mesh<2> mesh = rectangles();
  distort(mesh, 0.249);
  expect_moved_inside<2>(rectangles(), mesh, 0.0249);
  double area = 0;
  for (const auto& cell : mesh.cells) {
    CellNodal<2> X;
    for (int a = 0; a < 4; ++a) X.row(a) = mesh.nodes[cell[a]].transpose();
    EXPECT_GT(scaled_jacobian<2>(X), 0);
    area += cell_volume<2>(X);
  }
  EXPECT_NEAR(area, 60, 1e-12);
}

TEST(Distortion, KeepsBoxesSound) {
  Mesh<3> mesh = boxes();
  distort(mesh, 0.15);
  expect_moved_inside<3>(boxes(), mesh, 0.15 * 0.25);
  expect_sound(mesh);
}

// The first two numbers of the standard's mt19937, scaled to [-1, 1].
TEST(Distortion, IsTheSameOnEveryMachine) {
  Mesh<2> mesh =
      structured_quadrilaterals(2, 2, [](double s, double t) { return Vector<2>(2 * s, 2 * t); });
  distort(mesh, 0.5);
  std::mt19937 generator(5489);
  generator.discard(2 * 4);  // of the nodes before
  for (int i = 0; i < 2; ++i)
    EXPECT_NEAR(mesh.nodes[4][i], 1 + 0.5 * (2 * double(generator()) / 4294967295.0 - 1), 1e-15);
}

TEST(Distortion, OfNothingIsNothing) {
  Mesh<2> mesh = rectangles();
  distort(mesh, 0);
  EXPECT_EQ(mesh.nodes, rectangles().nodes);
}

}  // namespace
}  // namespace gnomon::distortion_test
