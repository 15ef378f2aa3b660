#include <gmock/gmock.h>
#include <omp.h>

#include <gnomon/base/error.hpp>
#include <gnomon/terms/cell_assembly.hpp>

#include "support/derivatives.hpp"
#include "support/structured_hexahedra.hpp"

namespace gnomon::cell_assembly_test {
namespace {

using namespace testing;

const ElasticModuli moduli = ElasticModuli::from_young_poisson(7, 0.3);

/// A block of n^3 hexahedra, held at the bottom; u and, in the lower half, d at every node. The top
/// moves rigidly along z: one number for all its nodes.
struct Block {
  using Numbers = NodalNumbers<3>;

  explicit Block(int n)
      : mesh(structured_hexahedra(
            n, n, n,
            [](double r, double s, double t) { return Vector<3>(r, s, t + 0.1 * r * s); })),
        u(Numbers::Constant(nodes(), 3, -1)),
        d(u),
        displacement(nodes(), 3),
        shape(nodes(), 3) {
    const int rigid = size++;
    for (int node = 0; node < nodes(); ++node) {
      const Vector<3> X = mesh.nodes[node];
      const bool bottom = node < (n + 1) * (n + 1), top = node >= nodes() - (n + 1) * (n + 1);
      for (int i = 0; i < 3 && !bottom; ++i) u(node, i) = top && i == 2 ? rigid : size++;
      for (int i = 0; i < 3 && X[2] < 0.5; ++i) d(node, i) = size++;
      displacement.row(node) << 0.02 * std::sin(5 * X[1]), 0.01 * X[0] * X[2], 0.03 * X[2];
      shape.row(node) << 0, 0.01 * std::cos(4 * X[2]), 0.02 * X[0];
    }
  }
  int nodes() const { return static_cast<int>(mesh.nodes.size()); }

  CellAssembly<3> assembly() const {
    return {mesh, {{.material = make_material("neo-hookean", moduli)}}, u, u, d};
  }

  Mesh<3> mesh;
  Numbers u, d;
  int size = 0;
  NodalField<3> displacement, shape;
};

struct Assembled {
  SparsePattern pattern;
  std::vector<double> F, values;
};

Assembled assemble(const Block& block, int threads) {
  omp_set_num_threads(threads);
  CellAssembly<3> cells = block.assembly();
  PatternBuilder builder(block.size);
  cells.add_to_pattern(builder);
  Assembled result{builder.build(), std::vector<double>(block.size), {}};
  result.values.assign(result.pattern.nonzeros(), 0.0);
  cells.map_to(result.pattern);
  cells.add_residual(&block.shape, block.displacement, result.F);
  cells.add_jacobian(&block.shape, block.displacement, result.values);
  return result;
}

TEST(CellAssembly, IsTheSumOverTheCells) {
  const Block block(3);
  const Assembled actual = assemble(block, 1);
  Eigen::VectorXd F = Eigen::VectorXd::Zero(block.size);
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(block.size, block.size);
  for (const auto& cell : block.mesh.cells) {
    CellNodal<3> X, u, R;
    CellMatrix<3> K_u, K_d;
    for (int a = 0; a < 8; ++a) {
      X.row(a) = block.mesh.nodes[cell[a]].transpose() + block.shape.row(cell[a]);
      u.row(a) = block.displacement.row(cell[a]);
    }
    const Material material = make_material("neo-hookean", moduli);
    ASSERT_TRUE(material.kernel<3>({}).tangent_ud(moduli, X, u, R, K_u, K_d));
    for (int row = 0; row < 24; ++row) {
      const int number = block.u(cell[row / 3], row % 3);
      if (number < 0) continue;
      F[number] += R(row / 3, row % 3);
      for (int k = 0; k < 24; ++k) {
        const int u_column = block.u(cell[k / 3], k % 3), d_column = block.d(cell[k / 3], k % 3);
        if (u_column >= 0) J(number, u_column) += K_u(row, k);
        if (d_column >= 0) J(number, d_column) += K_d(row, k);
      }
    }
  }
  Eigen::MatrixXd assembled = Eigen::MatrixXd::Zero(block.size, block.size);
  for (int j = 0; j < block.size; ++j)
    for (int k = actual.pattern.column_start[j]; k < actual.pattern.column_start[j + 1]; ++k)
      assembled(actual.pattern.row_index[k], j) = actual.values[k];
  expect_same_matrix(assembled, J, 1e-14);
  expect_same_matrix(Eigen::Map<const Eigen::VectorXd>(actual.F.data(), block.size), F, 1e-13);
}

TEST(CellAssembly, DoesNotDependOnTheNumberOfThreads) {
  const Block block(13);  // enough cells for threads
  const Assembled one = assemble(block, 1);
  for (int threads : {2, 3}) {
    const Assembled more = assemble(block, threads);
    EXPECT_EQ(more.F, one.F);
    EXPECT_EQ(more.values, one.values);
  }
}

TEST(CellAssembly, NamesTheFirstInvertedCellWithEveryNumberOfThreads) {
  Block block(13);
  block.displacement.row(block.mesh.cells[700][6]).setConstant(-50);
  block.displacement.row(block.mesh.cells[1900][6]).setConstant(-50);
  for (int threads : {1, 3}) {
    try {
      assemble(block, threads);
      FAIL() << "no exception";
    } catch (const RecoverableError& error) {
      EXPECT_THAT(error.what(), ::testing::HasSubstr("inverted element 700 at"));
    }
  }
}

}  // namespace
}  // namespace gnomon::cell_assembly_test
