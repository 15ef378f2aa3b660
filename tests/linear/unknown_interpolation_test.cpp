// Interpolation between unknowns: functions that it must reproduce, held values included.

#include "linear/unknown_interpolation.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <gnomon/mesh/extrusion.hpp>
#include <gnomon/mesh/semi_coarsening.hpp>

namespace gnomon::unknown_interpolation_test {
namespace {

/// A bar along x. All of u is held where y = 0, and u_x where x = 0.
struct Bar {
  Mesh<3> mesh;
  StiffnessLayout layout;

  Bar() {
    const Mesh<2> section = structured_quadrilaterals(
        9, 7, [](double s, double t) { return Vector<2>(std::pow(s, 1.3), t); });
    mesh = extrude(section, {0, 0.1, 0.2, 0.4, 0.7, 1, 1.5, 2, 3}).mesh;
    for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node) {
      const Vector<3>& X = mesh.nodes[node];
      layout.position.push_back({X[0], X[1], X[2]});
      for (char i : {0, 1, 2}) {
        if (X[1] == 0 || (X[0] == 0 && i == 0)) continue;
        layout.group.push_back(node);
        layout.component.push_back(i);
      }
    }
    layout.coarsening =
        std::make_shared<const std::vector<NodeInterpolation>>(semi_coarsening(mesh, {.few = 30}));
  }
};

// u = (x y, y, y) is zero where it is held, and linear along every grid line.
TEST(UnknownInterpolation, ReproducesFunctionsThatFulfilTheSupports) {
  const Bar bar;
  const std::vector<SparseRows> levels = unknown_interpolations(bar.layout);
  ASSERT_GE(levels.size(), 3u);
  std::vector<double> fine;
  std::vector<int> group = bar.layout.group,
                   component(bar.layout.component.begin(), bar.layout.component.end());
  std::vector<Vector<3>> position = bar.mesh.nodes;
  const auto function = [](const Vector<3>& X, int i) { return i == 0 ? X[0] * X[1] : X[1]; };
  for (std::size_t l = 0; l < levels.size(); ++l) {
    const SparseRows& rows = levels[l];
    ASSERT_EQ(rows.rows(), std::ssize(group));
    // The unknowns of the next level, by the nodes that it keeps.
    const NodeInterpolation& nodes = (*bar.layout.coarsening)[l];
    std::vector<int> next_group, next_component;
    std::vector<Vector<3>> next_position;
    for (std::size_t k = 0; k < nodes.kept.size(); ++k) {
      next_position.push_back(position[nodes.kept[k]]);
      for (std::size_t u = 0; u < group.size(); ++u)
        if (group[u] == nodes.kept[k]) {
          next_group.push_back(static_cast<int>(k));
          next_component.push_back(component[u]);
        }
    }
    ASSERT_EQ(rows.cols(), std::ssize(next_group));
    for (std::size_t u = 0; u < group.size(); ++u) {
      double sum = 0;
      for (SparseRows::InnerIterator entry(rows, static_cast<Eigen::Index>(u)); entry; ++entry) {
        const auto column = entry.col();
        EXPECT_EQ(next_component[column], component[u]);
        sum += entry.value() * function(next_position[next_group[column]], next_component[column]);
      }
      EXPECT_NEAR(sum, function(position[group[u]], component[u]), 1e-12) << l << " " << u;
    }
    group = next_group;
    component = next_component;
    position = next_position;
  }
}

// The shape of a groove: unknowns at one end of the bar, in two components.
TEST(UnknownInterpolation, LeavesOutLevelsThatMergeNothing) {
  Bar bar;
  StiffnessLayout plane = bar.layout;
  plane.group.clear();
  plane.component.clear();
  for (std::size_t u = 0; u < bar.layout.group.size(); ++u)
    if (bar.mesh.nodes[bar.layout.group[u]][0] == 0) {
      plane.group.push_back(bar.layout.group[u]);
      plane.component.push_back(bar.layout.component[u]);
    }
  Eigen::Index rows = std::ssize(plane.group);
  const auto levels = unknown_interpolations(plane);
  EXPECT_FALSE(levels.empty());
  for (const SparseRows& level : levels) {
    EXPECT_EQ(level.rows(), rows);
    EXPECT_LT(level.cols(), rows);
    EXPECT_GT(level.cols(), 0);
    const Eigen::VectorXd sums = level * Eigen::VectorXd::Ones(level.cols());
    EXPECT_LE(sums.maxCoeff(), 1 + 1e-14);
    rows = level.cols();
  }
}

TEST(UnknownInterpolation, NeedsACoarsening) {
  Bar bar;
  bar.layout.coarsening = nullptr;
  EXPECT_TRUE(unknown_interpolations(bar.layout).empty());
}

}  // namespace
}  // namespace gnomon::unknown_interpolation_test
