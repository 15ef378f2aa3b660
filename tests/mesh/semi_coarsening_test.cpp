// Coarser meshes and the interpolation from them: what they reproduce exactly.

#include <gmock/gmock.h>

#include <gnomon/mesh/extrusion.hpp>
#include <gnomon/mesh/grid_lines.hpp>
#include <gnomon/mesh/quarter_ball.hpp>
#include <gnomon/mesh/semi_coarsening.hpp>
#include <map>
#include <set>

namespace gnomon::semi_coarsening_test {
namespace {

using ::testing::ElementsAre;
using Lines = std::vector<double>;

Mesh<2> rectangle(const Lines& x, const Lines& y) {
  return structured_quadrilaterals(static_cast<int>(x.size()) - 1, static_cast<int>(y.size()) - 1,
                                   [&](double s, double t) {
                                     return Vector<2>(x[std::lround(s * double(x.size() - 1))],
                                                      y[std::lround(t * double(y.size() - 1))]);
                                   });
}

Lines uniform(int cells) {
  Lines lines;
  for (int k = 0; k <= cells; ++k) lines.push_back(k);
  return lines;
}

Mesh<3> graded_block() {
  return extrude(rectangle(graded_grid_lines(1, 4, 60, 16), graded_grid_lines(1, 0, 40, 13)),
                 graded_grid_lines(0.5, 3, 30, 17))
      .mesh;
}

Mesh<3> ball() {
  return quarter_ball({.radius = 1,
                       .patch_half_width = 0.4,
                       .contact_radius = 0.2,
                       .across = 8,
                       .height = 5,
                       .layers = 6});
}

/// Positions of the nodes of each level, from the finest on.
template <int dim>
std::vector<std::vector<Vector<dim>>> positions(const Mesh<dim>& mesh,
                                                const std::vector<NodeInterpolation>& levels) {
  std::vector<std::vector<Vector<dim>>> result = {mesh.nodes};
  for (const NodeInterpolation& level : levels) {
    std::vector<Vector<dim>> coarse;
    for (int node : level.kept) coarse.push_back(result.back()[node]);
    result.push_back(coarse);
  }
  return result;
}

double interpolated(const NodeInterpolation& level, int node, const auto& coarse_value) {
  double sum = 0;
  for (int k = level.start[node]; k < level.start[node + 1]; ++k)
    sum += level.weight[k] * coarse_value(level.coarse[k]);
  return sum;
}

std::set<double> coordinates(const std::vector<Vector<2>>& nodes, int axis) {
  std::set<double> result;
  for (const Vector<2>& x : nodes) result.insert(x[axis]);
  return result;
}

// Pairs of cells that are both narrower than 3, 6, 12, 24 times the narrowest.
TEST(SemiCoarsening, MergesThinLayersFirst) {
  const Mesh<2> mesh = rectangle({0, 1, 2, 3, 4, 6, 10, 18}, uniform(8));
  const auto levels = semi_coarsening(mesh, {.few = 4});
  ASSERT_EQ(levels.size(), 4u);
  const auto nodes = positions(mesh, levels);
  EXPECT_THAT(coordinates(nodes[1], 0), ElementsAre(0, 2, 4, 6, 10, 18));
  EXPECT_THAT(coordinates(nodes[2], 0), ElementsAre(0, 4, 10, 18));
  EXPECT_THAT(coordinates(nodes[3], 0), ElementsAre(0, 10, 18));
  EXPECT_THAT(coordinates(nodes[4], 0), ElementsAre(0, 18));
  EXPECT_THAT(coordinates(nodes[1], 1), ElementsAre(0, 2, 4, 6, 8));
  EXPECT_THAT(coordinates(nodes[2], 1), ElementsAre(0, 4, 8));
  EXPECT_THAT(coordinates(nodes[3], 1), ElementsAre(0, 8));
  for (std::size_t l = 1; l < nodes.size(); ++l)
    EXPECT_EQ(nodes[l].size(), coordinates(nodes[l], 0).size() * coordinates(nodes[l], 1).size());
}

TEST(SemiCoarsening, SkipsALevelThatWouldKeepMostNodes) {
  const Mesh<2> mesh = rectangle({0, 1, 2, 100, 200, 300, 400, 500, 600}, {0, 50, 100});
  const auto levels = semi_coarsening(mesh, {.few = 20});
  ASSERT_EQ(levels.size(), 1u);
  const auto nodes = positions(mesh, levels);
  EXPECT_LE(nodes[1].size(), 0.75 * double(nodes[0].size()));
}

TEST(SemiCoarsening, EndsWhereAFactorIsCheap) {
  const Mesh<3> mesh = graded_block();
  const auto levels = semi_coarsening(mesh);
  EXPECT_GE(levels.size(), 3u);
  EXPECT_LT(levels.back().kept.size(), 200u);
  EXPECT_GE(levels[levels.size() - 2].kept.size(), 200u);
  EXPECT_TRUE(semi_coarsening(rectangle(uniform(9), uniform(9))).empty());
}

// All that the cost of a cycle depends on.
TEST(SemiCoarsening, AddsLittleToTheFinestLevel) {
  for (const Mesh<3>& mesh : {graded_block(), ball()}) {
    std::size_t sum = mesh.nodes.size();
    for (const NodeInterpolation& level : semi_coarsening(mesh)) sum += level.kept.size();
    EXPECT_LT(double(sum), 2 * double(mesh.nodes.size()));
  }
}

// The grid lines of the block are straight, those of the ball are not.
TEST(SemiCoarsening, InterpolatesConstantAndLinearFunctionsExactly) {
  const auto check = [](const Mesh<3>& mesh, bool straight) {
    const auto levels = semi_coarsening(mesh);
    const auto nodes = positions(mesh, levels);
    ASSERT_FALSE(levels.empty());
    for (std::size_t l = 0; l < levels.size(); ++l)
      for (int node = 0; node < static_cast<int>(nodes[l].size()); ++node) {
        ASSERT_NEAR(interpolated(levels[l], node, [](int) { return 1.0; }), 1, 1e-14);
        for (int axis = 0; axis < 3 && straight; ++axis)
          ASSERT_NEAR(
              interpolated(levels[l], node, [&](int coarse) { return nodes[l + 1][coarse][axis]; }),
              nodes[l][node][axis], 1e-12)
              << l << " " << node;
      }
  };
  check(graded_block(), true);
  check(ball(), false);
}

TEST(SemiCoarsening, KeepsTheValuesAtCoarseNodes) {
  for (const NodeInterpolation& level : semi_coarsening(ball()))
    for (std::size_t coarse = 0; coarse < level.kept.size(); ++coarse) {
      const int row = level.start[level.kept[coarse]];
      ASSERT_EQ(level.start[level.kept[coarse] + 1], row + 1);
      ASSERT_EQ(level.coarse[row], static_cast<int>(coarse));
      ASSERT_EQ(level.weight[row], 1);
    }
}

TEST(SemiCoarsening, UsesAtMostEightNeighboursAscending) {
  for (const Mesh<3>& mesh : {graded_block(), ball()})
    for (const NodeInterpolation& level : semi_coarsening(mesh))
      for (std::size_t node = 0; node + 1 < level.start.size(); ++node) {
        const auto first = level.coarse.begin() + level.start[node],
                   last = level.coarse.begin() + level.start[node + 1];
        ASSERT_LE(last - first, 8);
        ASSERT_EQ(std::adjacent_find(first, last, std::greater_equal<>()), last);
      }
}

// Without lines in the section, a long bar cannot become small.
TEST(SemiCoarsening, GivesUpWhereLinesOfADirectionAreMissing) {
  Mesh<2> section = rectangle(uniform(8), uniform(8));
  for (auto& cell : section.cells)  // cut off from its neighbours: no two cells share a node
    for (int& node : cell) {
      section.nodes.push_back(section.nodes[node]);
      node = static_cast<int>(section.nodes.size()) - 1;
    }
  Lines lines = uniform(40);
  EXPECT_TRUE(semi_coarsening(extrude(section, lines).mesh, {.many = 400}).empty());
}

TEST(SemiCoarsening, OfARingSumsWeightsOfOneNode) {
  Mesh<2> ring;
  const int count = 16;
  for (int j = 0; j <= 16; ++j)
    for (int k = 0; k < count; ++k) {
      const double turn = 2 * M_PI * k / count, radius = 1 + 0.4 * j;
      ring.nodes.emplace_back(radius * std::cos(turn), radius * std::sin(turn));
    }
  for (int j = 0; j < 16; ++j)
    for (int k = 0; k < count; ++k) {
      const int next = (k + 1) % count;
      ring.cells.push_back(
          {j * count + k, (j + 1) * count + k, (j + 1) * count + next, j * count + next});
    }
  const auto levels = semi_coarsening(ring, {.few = 1});
  ASSERT_FALSE(levels.empty());
  EXPECT_EQ(levels.back().kept.size(), 2u);  // one round, one across
  for (const NodeInterpolation& level : levels)
    for (std::size_t node = 0; node + 1 < level.start.size(); ++node)
      ASSERT_NEAR(interpolated(level, static_cast<int>(node), [](int) { return 1.0; }), 1, 1e-14);
}

}  // namespace
}  // namespace gnomon::semi_coarsening_test
