// Sums over the Gauss points from which the tangent of a cell is made. All terms are first
// collected and then multiplied: products of small matrices, with the nodes contiguous in memory.
#pragma once

#include <array>
#include <gnomon/base/tensor.hpp>
#include <type_traits>

namespace gnomon {

/// result = sum over t of factors[t * factor_stride] times the t-th run of `length` values; runs
/// lie `run_stride` apart, aligned as Eigen's matrices. The sum is a local variable, so that it
/// stays in registers up to a length of 24.
template <int length>
void combine(int terms, const double* runs, int run_stride, const double* factors,
             int factor_stride, double* result) {
  using Run = Eigen::Matrix<double, length, 1>;
  using Given = Eigen::Map<const Run, Eigen::AlignedMax>;
  Run sum = Given(runs) * factors[0];
  for (int t = 1; t < terms; ++t) sum += Given(runs + t * run_stride) * factors[t * factor_stride];
  Eigen::Map<Run, Eigen::AlignedMax>{result} = sum;
}

/// Sum of dyads x_a[i] y_b[j] of nodal fields x and y, `per_point` of them per Gauss point.
template <int dim, int per_point>
class DyadSum {
public:
  static constexpr int local = dim * (1 << dim);

  void add(const CellNodal<dim>& x, const CellNodal<dim>& y) {
    x_[count_] = x;
    y_[count_++] = y;
  }
  /// Sum of x y_b[j], one value per node and component.
  CellNodal<dim> column(int b, int j) const {
    CellNodal<dim> sum;
    combine<local>(count_, x_[0].data(), local, &y_[0](b, j), local, sum.data());
    return sum;
  }

private:
  std::array<CellNodal<dim>, per_point*(1 << dim)> x_, y_;
  int count_ = 0;
};

/// One value per pair of nodes.
template <int dim>
using NodePairs = Eigen::Matrix<double, (1 << dim), (1 << dim)>;

/// Sum of (n_a . n_b) D over the Gauss points for any tensors D.
template <int dim>
class PairSum {
public:
  void add(const CellNodal<dim>& n, const Tensor<dim>& D) {
    pairs_[count_].noalias() = n.lazyProduct(n.transpose());
    factors_[count_++] = D;
  }
  /// Sum of (n_a . n_b) D_ij.
  NodePairs<dim> component(int i, int j) const {
    constexpr int part = 16, size = NodePairs<dim>::SizeAtCompileTime;
    NodePairs<dim> sum;
    for (int first = 0; first < size; first += part)
      combine<part>(count_, pairs_[0].data() + first, size, &factors_[0](i, j), dim * dim,
                    sum.data() + first);
    return sum;
  }

private:
  std::array<NodePairs<dim>, (1 << dim)> pairs_;
  std::array<Tensor<dim>, (1 << dim)> factors_;
  int count_ = 0;
};

/// Sum of [A : (v (x) n_b)] n_a over the Gauss points for any linear A, one per point.
template <int dim>
class StressChangeSum {
public:
  static constexpr int local = dim * (1 << dim);
  /// Entry [j][J], one row per node: (A : (e_j (x) e_J)) n_a.
  using Changes = std::array<std::array<CellNodal<dim>, dim>, dim>;

  void add(const CellNodal<dim>& n, const Changes& changes) {
    for (int j = 0; j < dim; ++j)
      for (int J = 0; J < dim; ++J) changes_[j][dim * count_ + J] = changes[j][J];
    n_[count_++] = n;
  }
  /// For v = e_j, one value per node and component.
  CellNodal<dim> column(int b, int j) const {
    CellNodal<dim> sum;
    // Entry (b, J) of the n of a point is J * (1 << dim) after (b, 0), and the next point follows.
    combine<local>(dim * count_, changes_[j][0].data(), local, n_[0].data() + b, 1 << dim,
                   sum.data());
    return sum;
  }

private:
  std::array<std::array<CellNodal<dim>, local>, dim> changes_;
  std::array<CellNodal<dim>, (1 << dim)> n_;
  int count_ = 0;
};

/// The sum for the tangent of a law: (n_a . n_b) D if its other parts are dyads, otherwise the
/// general sum.
template <int dim, bool dyadic>
using LawSum = std::conditional_t<dyadic, PairSum<dim>, StressChangeSum<dim>>;

/// K(ab) = sum of direct dyads x_a (x) y_b, crossed dyads y_b (x) x_a, and the part of the law.
template <int dim, int direct_dyads, int crossed_dyads, bool dyadic>
struct TangentSum {
  static constexpr int nodes = 1 << dim;
  DyadSum<dim, direct_dyads> direct;
  DyadSum<dim, crossed_dyads> crossed;
  LawSum<dim, dyadic> law;

  void write(CellMatrix<dim>& K) const {
    std::array<CellNodal<dim>, crossed_dyads ? dim * nodes : 0> turned;
    if constexpr (crossed_dyads > 0)
      for (int i = 0; i < dim; ++i)
        for (int b = 0; b < nodes; ++b) turned[i * nodes + b] = crossed.column(b, i);
    for (int j = 0; j < dim; ++j) {
      std::array<NodePairs<dim>, dyadic ? dim : 0> pair;
      if constexpr (dyadic)
        for (int i = 0; i < dim; ++i) pair[i] = law.component(i, j);
      for (int b = 0; b < nodes; ++b) {
        CellNodal<dim> column;
        if constexpr (direct_dyads > 0)
          column = direct.column(b, j);
        else
          column.setZero();
        if constexpr (!dyadic) column += law.column(b, j);
        for (int i = 0; i < dim; ++i) {
          if constexpr (dyadic)  // crossed as well
            column.col(i) += pair[i].col(b) + turned[i * nodes + b].col(j);
          else if constexpr (crossed_dyads > 0)
            column.col(i) += turned[i * nodes + b].col(j);
        }
        Eigen::Map<Eigen::Matrix<double, dim, nodes>>(K.col(dim * b + j).data()) =
            column.transpose();
      }
    }
  }
};

}  // namespace gnomon
