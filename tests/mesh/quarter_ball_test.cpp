#include <gnomon/base/error.hpp>
#include <gnomon/mesh/quarter_ball.hpp>
#include <numbers>

#include "support/hexahedra.hpp"

namespace gnomon::quarter_ball_test {
namespace {

using namespace testing;

QuarterBall ball(int across, int height, int layers) {
  return {.radius = 5,
          .patch_half_width = 2.5,
          .contact_radius = 3,
          .across = across,
          .height = height,
          .layers = layers};
}

TEST(QuarterBall, IsSound) {
  for (const QuarterBall& b : {ball(1, 1, 1), ball(4, 2, 3), ball(3, 4, 2)}) {
    const Mesh<3> mesh = quarter_ball(b);
    EXPECT_EQ(static_cast<int>(mesh.cells.size()), b.elements());
    EXPECT_EQ(static_cast<int>(mesh.nodes.size()), b.nodes());
    expect_sound(mesh);
  }
}

// Sec. 4.2 of the paper: 16384 elements and 18021 nodes.
TEST(QuarterBall, HasThePapersCounts) {
  const Mesh<3> mesh = quarter_ball(ball(16, 8, 12));
  EXPECT_EQ(mesh.cells.size(), 16384u);
  EXPECT_EQ(mesh.nodes.size(), 18021u);
}

TEST(QuarterBall, VolumeConvergesToThatOfTheBall) {
  const double exact = std::numbers::pi / 3 * 125;  // a quarter of 4/3 pi R^3
  const double coarse = exact - volume(quarter_ball(ball(6, 8, 3)));
  const double fine = exact - volume(quarter_ball(ball(12, 16, 6)));
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.1);
}

TEST(QuarterBall, ElementsAreWellShapedFromCoarseToFull) {
  for (const QuarterBall& b : {ball(5, 2, 3), ball(10, 3, 5), ball(20, 6, 9), ball(16, 8, 12)})
    EXPECT_GT(least_scaled_jacobian(quarter_ball(b)), 0.5);
}

TEST(QuarterBall, BoundaryPartsLieWhereTheirNamesSay) {
  const Mesh<3> mesh = quarter_ball(ball(4, 3, 3));
  EXPECT_EQ(mesh.boundary.size(), 4u);
  for (int node : mesh.boundary_nodes("symmetry")) EXPECT_EQ(mesh.nodes[node][1], 0);
  for (int node : mesh.boundary_nodes("top")) EXPECT_EQ(mesh.nodes[node][2], 5);
  for (const char* part : {"contact", "free"})
    for (int node : mesh.boundary_nodes(part))
      EXPECT_NEAR((mesh.nodes[node] - Vector<3>(0, 0, 5)).norm(), 5, 1e-14);
  const auto contact = node_set(mesh.boundary_nodes("contact"));
  for (int node : mesh.boundary_nodes("free")) {
    const double distance = mesh.nodes[node].head<2>().norm();
    EXPECT_TRUE(distance > 3 || contact.contains(node));
  }
  EXPECT_EQ(*std::min_element(mesh.nodes.begin(), mesh.nodes.end(),
                              [](auto& a, auto& b) { return a[2] < b[2]; }),
            Vector<3>::Zero());
}

// The size of the elements near the pole: arc 2.5 mm in 20 elements along both axes of the patch.
TEST(QuarterBall, ElementsOfTheContactZoneHaveOneSize) {
  const Mesh<3> mesh = quarter_ball(ball(20, 6, 9));
  double least = 1, largest = 0;
  for (const auto& facet : mesh.boundary.at("contact")) {
    double far = 0;
    for (int node : facet) far = std::max(far, mesh.nodes[node].head<2>().norm());
    if (far > 2.3) continue;
    for (int k = 0; k < 4; ++k) {
      const double edge = (mesh.nodes[facet[k]] - mesh.nodes[facet[(k + 1) % 4]]).norm();
      least = std::min(least, edge);
      largest = std::max(largest, edge);
    }
  }
  EXPECT_GT(least, 0.85 * 0.125);
  EXPECT_LT(largest, 1.05 * 0.125);
}

TEST(QuarterBall, RefusesWhatCannotBe) {
  EXPECT_THROW(quarter_ball(ball(0, 1, 1)), InputError);
  QuarterBall wide = ball(2, 1, 1);
  wide.patch_half_width = 6;
  EXPECT_THROW(quarter_ball(wide), InputError);
}

}  // namespace
}  // namespace gnomon::quarter_ball_test
