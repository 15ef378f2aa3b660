// The grid lines that are found in meshes whose lines are known.

#include <gmock/gmock.h>

#include <algorithm>
#include <gnomon/mesh/extrusion.hpp>
#include <gnomon/mesh/quarter_ball.hpp>
#include <gnomon/mesh/semi_coarsening.hpp>
#include <random>

#include "support/structured_hexahedra.hpp"

namespace gnomon::cell_layers_test {
namespace {

using ::testing::UnorderedElementsAre;

/// Numbers of layers in the stacks.
std::vector<std::size_t> heights(const CellLayers& layers) {
  std::vector<std::size_t> result;
  for (const auto& stack : layers.thickness) result.push_back(stack.size());
  return result;
}

std::size_t lines_at(const CellLayers& layers, int node) {
  const auto& passages = layers.passages[node];
  return std::count_if(passages.begin(), passages.end(),
                       [](const auto& passage) { return passage.stack >= 0; });
}

Mesh<3> bent_block(int nx, int ny, int nz) {
  return testing::structured_hexahedra(nx, ny, nz, [](double r, double s, double t) {
    return Vector<3>(2 * r * r + 0.1 * s, 3 * s + 0.2 * r * t, 5 * t + r * s);
  });
}

/// The same mesh with its nodes, cells and the axes of its cells in other orders.
Mesh<3> shuffled(const Mesh<3>& mesh) {
  std::mt19937 random(3);
  std::vector<int> number(mesh.nodes.size());
  for (std::size_t k = 0; k < number.size(); ++k) number[k] = static_cast<int>(k);
  std::shuffle(number.begin(), number.end(), random);
  Mesh<3> result;
  result.nodes.resize(mesh.nodes.size());
  for (std::size_t k = 0; k < number.size(); ++k) result.nodes[number[k]] = mesh.nodes[k];
  for (Mesh<3>::Cell cell : mesh.cells) {
    for (int& node : cell) node = number[node];
    const Mesh<3>::Cell old = cell;
    if (random() % 2)  // a quarter turn about t
      cell = {old[1], old[2], old[3], old[0], old[5], old[6], old[7], old[4]};
    else  // r, s, t become t, r, s
      cell = {old[0], old[4], old[5], old[1], old[3], old[7], old[6], old[2]};
    result.cells.push_back(cell);
  }
  std::shuffle(result.cells.begin(), result.cells.end(), random);
  return result;
}

TEST(CellLayers, OfABlockAreThoseOfItsDirections) {
  const int n[] = {3, 4, 5};
  const Mesh<3> mesh = bent_block(n[0], n[1], n[2]);
  const CellLayers layers = cell_layers(mesh);
  EXPECT_THAT(heights(layers), UnorderedElementsAre(3u, 4u, 5u));
  const int stride[] = {1, n[0] + 1, (n[0] + 1) * (n[1] + 1)};
  for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node)
    for (int axis = 0; axis < 3; ++axis) {
      const int place = node / stride[axis] % (n[axis] + 1);
      const auto& passages = layers.passages[node];
      const auto along = [&](int other) {
        return std::count_if(passages.begin(), passages.end(), [&](const auto& passage) {
          return passage.stack >= 0 && (passage.before == other || passage.after == other) &&
                 passage.before + passage.after == 2 * node &&
                 layers.thickness[passage.stack].size() == std::size_t(n[axis]) &&
                 (passage.place == place || passage.place == n[axis] - place);
        });
      };
      EXPECT_EQ(along(node + stride[axis]), place > 0 && place < n[axis] ? 1 : 0)
          << node << " " << axis;
    }
}

TEST(CellLayers, DoNotDependOnNumbersOrOrientations) {
  const Mesh<3> mesh = bent_block(3, 4, 5);
  const CellLayers layers = cell_layers(shuffled(mesh));
  EXPECT_THAT(heights(layers), UnorderedElementsAre(3u, 4u, 5u));
  std::size_t lines = 0;
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    lines += lines_at(layers, static_cast<int>(node));
  EXPECT_EQ(lines, 2u * 5 * 6 + 4u * 3 * 6 + 4u * 5 * 4);  // nodes between layers, per direction
}

TEST(CellLayers, HaveTheMeanLengthOfTheirEdges) {
  const Mesh<3> mesh =
      extrude(structured_quadrilaterals(1, 2,
                                        [](double s, double t) { return Vector<2>(7 * s, 3 * t); }),
              {0, 1, 3, 7})
          .mesh;
  std::vector<std::vector<double>> thickness = cell_layers(mesh).thickness;
  for (auto& stack : thickness)
    if (stack.size() == 3 && stack[0] > stack[2]) std::reverse(stack.begin(), stack.end());
  EXPECT_THAT(thickness, UnorderedElementsAre(std::vector<double>{7}, std::vector<double>{1.5, 1.5},
                                              std::vector<double>{1, 2, 4}));
}

// The core's three directions, of which each continues in some of the outer blocks, and the layers
// round the core.
TEST(CellLayers, OfAQuarterBallGoOnFromBlockToBlock) {
  const Mesh<3> mesh = quarter_ball({.radius = 1,
                                     .patch_half_width = 0.4,
                                     .contact_radius = 0.2,
                                     .across = 4,
                                     .height = 3,
                                     .layers = 5});
  EXPECT_THAT(heights(cell_layers(mesh)), UnorderedElementsAre(8u, 4u, 3u, 5u));
}

/// Three quadrilaterals round a node, each divided into n x n.
Mesh<2> three_blocks(int n) {
  Mesh<2> mesh;
  const auto corner = [](double turn, double radius) {
    return Vector<2>(radius * std::cos(turn), radius * std::sin(turn));
  };
  const auto number = [&mesh](const Vector<2>& x) {
    for (std::size_t k = 0; k < mesh.nodes.size(); ++k)
      if ((mesh.nodes[k] - x).norm() < 1e-9) return static_cast<int>(k);
    mesh.nodes.push_back(x);
    return static_cast<int>(mesh.nodes.size()) - 1;
  };
  for (int block = 0; block < 3; ++block) {
    const double third = 2 * M_PI / 3;
    const Vector<2> a = corner(block * third, 1), b = corner((block + 0.5) * third, 1.2),
                    c = corner((block + 1) * third, 1);
    const auto place = [&](int i, int j) -> Vector<2> {
      const double s = double(i) / n, t = double(j) / n;
      return s * (1 - t) * a + s * t * b + (1 - s) * t * c;
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        mesh.cells.push_back({number(place(i, j)), number(place(i + 1, j)),
                              number(place(i + 1, j + 1)), number(place(i, j + 1))});
  }
  return mesh;
}

TEST(CellLayers, EndAtIrregularNodes) {
  const Mesh<2> section = three_blocks(4);
  EXPECT_THAT(heights(cell_layers(section)), UnorderedElementsAre(4u, 4u, 4u));
  const CellLayers layers = cell_layers(extrude(section, {0, 1, 2, 3}).mesh);
  EXPECT_THAT(heights(layers), UnorderedElementsAre(4u, 4u, 4u, 3u));
  EXPECT_EQ(lines_at(layers, 0), 0u);  // at the centre, at the end
  EXPECT_EQ(lines_at(layers, 1), 1u);  // at the centre, inside
}

/// A strip of quadrilaterals whose end is joined to its beginning: node k is opposite to count + k.
Mesh<2> closed_strip(int count, bool twisted) {
  Mesh<2> mesh;
  for (double radius : {1.0, 2.0})
    for (int k = 0; k < count; ++k) {
      const double turn = 2 * M_PI * k / count;
      mesh.nodes.emplace_back(radius * std::cos(turn), radius * std::sin(turn));
    }
  for (int k = 0; k < count; ++k) {
    const int next = (k + 1) % count;
    const bool turned = twisted && next == 0;
    mesh.cells.push_back(
        {k, count + k, turned ? next : count + next, turned ? count + next : next});
  }
  return mesh;
}

TEST(CellLayers, OfARingAreCutOnce) {
  const CellLayers layers = cell_layers(closed_strip(9, false));
  EXPECT_THAT(heights(layers), UnorderedElementsAre(9u, 1u));
  int lines = 0;
  for (int node = 0; node < 18; ++node) lines += static_cast<int>(lines_at(layers, node));
  EXPECT_EQ(lines, 2 * 8);
}

// Round a Moebius strip there is no first and second side of the layer that all cells share.
TEST(CellLayers, WithoutTwoSidesHaveNoNeighbours) {
  const CellLayers layers = cell_layers(closed_strip(9, true));
  EXPECT_THAT(heights(layers), UnorderedElementsAre(9u, 1u));
}

// Quadrilaterals of one layer that meet at a node: a path that returns to where it has been.
TEST(CellLayers, ThatTouchThemselvesHaveNoNeighbours) {
  Mesh<2> mesh;
  mesh.nodes.resize(5);
  for (int k = 0; k < 5; ++k) mesh.nodes[k] = Vector<2>(k, k * k);
  mesh.cells = {{0, 1, 2, 3}, {2, 3, 4, 1}};
  for (const auto& stack : cell_layers(mesh).thickness) EXPECT_EQ(stack.size(), 1u);
}

}  // namespace
}  // namespace gnomon::cell_layers_test
