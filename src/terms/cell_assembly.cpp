#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/terms/cell_assembly.hpp>
#include <optional>

namespace gnomon {

template <int dim>
CellAssembly<dim>::CellAssembly(const Mesh<dim>& mesh, const std::vector<Body>& bodies,
                                Numbers rows, Numbers columns, Numbers shape_columns,
                                std::vector<double> stiffness, const NodalProjectors<dim>* along)
    : mesh_(mesh),
      stiffness_(std::move(stiffness)),
      rows_(std::move(rows)),
      columns_(std::move(columns)),
      along_(along) {
  if (bodies.size() > 1) body_of_ = body_of_cells(bodies, mesh.cells.size());
  for (const Body& body : bodies)
    bodies_.push_back({body.material.moduli, body.material.kernel<dim>(body.element), body.name});
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell)
    for (int node : mesh.cells[cell])
      if (rows_.row(node).maxCoeff() >= 0) {
        cells_.push_back(cell);
        break;
      }
  keeps_.assign(cells_.size(), 0);
  for (std::size_t c = 0; along_ && c < cells_.size(); ++c)
    keeps_[c] = std::ranges::any_of(mesh.cells[cells_[c]],
                                    [&](int node) { return along_->contains(node); });
  // A frozen shape has no columns; then its derivative is not computed.
  if (shape_columns.size() > 0 && shape_columns.maxCoeff() >= 0)
    shape_columns_ = std::move(shape_columns);
}

template <int dim>
ElasticModuli CellAssembly<dim>::moduli_of(int cell) const {
  const ElasticModuli& moduli = elastic(cell).moduli;
  return stiffness_.empty() ? moduli : moduli.scaled(stiffness_[cell]);
}

template <int dim>
void CellAssembly<dim>::cell_numbers(int cell, const Numbers& numbers,
                                     std::vector<int>& result) const {
  result.clear();
  for (int node : mesh_.cells[cell])
    for (int i = 0; i < dim; ++i) result.push_back(numbers(node, i));
}

template <int dim>
void CellAssembly<dim>::add_to_pattern(PatternBuilder& builder) const {
  std::vector<int> rows, columns;
  for (int cell : cells_) {
    cell_numbers(cell, rows_, rows);
    cell_numbers(cell, columns_, columns);
    builder.add(rows, columns);
    if (!moves()) continue;
    cell_numbers(cell, shape_columns_, columns);
    builder.add(rows, columns);
  }
}

template <int dim>
void CellAssembly<dim>::fill_map(const SparsePattern& pattern, const Numbers& columns,
                                 std::vector<int>& map) const {
  std::vector<int> rows, cols;
  map.clear();
  map.reserve(cells_.size() * local * local);
  for (int cell : cells_) {
    cell_numbers(cell, rows_, rows);
    cell_numbers(cell, columns, cols);
    const std::vector<int> positions = pattern.positions(rows, cols);
    map.insert(map.end(), positions.begin(), positions.end());
  }
}

template <int dim>
void CellAssembly<dim>::map_to(const SparsePattern& pattern) {
  size_ = pattern.size();
  fill_map(pattern, columns_, map_);
  if (moves()) fill_map(pattern, shape_columns_, shape_map_);
}

template <int dim>
void CellAssembly<dim>::gather(int cell, const NodalField<dim>* shape,
                               const NodalField<dim>& displacement, CellNodal<dim>& X,
                               CellNodal<dim>& u) const {
  X = mesh_.positions(mesh_.cells[cell]);
  for (int a = 0; a < Mesh<dim>::cell_nodes; ++a) {
    const int node = mesh_.cells[cell][a];
    if (shape) X.row(a) += shape->row(node);
    u.row(a) = displacement.row(node);
  }
}

template <int dim>
void CellAssembly<dim>::throw_inverted(int cell, const NodalField<dim>* shape) const {
  Vector<dim> centre = Vector<dim>::Zero();
  for (int node : mesh_.cells[cell]) {
    centre += mesh_.nodes[node] / Mesh<dim>::cell_nodes;
    if (shape) centre += shape->row(node).transpose() / Mesh<dim>::cell_nodes;
  }
  std::string place = fmt::format("({:.4g}, {:.4g}", centre[0], centre[1]);
  if constexpr (dim == 3) place += fmt::format(", {:.4g}", centre[2]);
  const std::string& name = elastic(cell).name;
  throw RecoverableError(fmt::format("inverted element {}{} at {})", cell,
                                     name.empty() ? "" : " of \"" + name + "\"", place));
}

namespace {

/// Equations of a cell some nodes of which keep to a plane or line: P R(P u) + k (1 - P) u = 0,
/// with the derivative P K P + k (1 - P), symmetric where K is. R and K have no part across, so
/// that k, a stiffness of the cell, does not change the solution.
template <int dim>
class CellProjection {
public:
  /// `X`: reference positions of the nodes of `cell`. `along` must outlive the object.
  CellProjection(const typename Mesh<dim>::Cell& cell, const NodalProjectors<dim>& along,
                 const ElasticModuli& moduli, const CellNodal<dim>& X)
      : stiffness_((moduli.lambda + 2 * moduli.mu) * std::pow(cell_volume<dim>(X), 1 - 2.0 / dim)) {
    for (int a = 0; a < Mesh<dim>::cell_nodes; ++a)
      if (const auto found = along.find(cell[a]); found != along.end())
        corners_.push_back({a, found->second});
  }

  void of_displacement(CellNodal<dim>& u) const {
    for (const auto& [a, P] : corners_) u.row(a) = (u.row(a) * P).eval();
  }

  /// `u`: the displacement before its projection.
  void of_residual(const CellNodal<dim>& u, CellNodal<dim>& R) const {
    for (const auto& [a, P] : corners_)
      R.row(a) = (R.row(a) * P + stiffness_ * (u.row(a) - u.row(a) * P)).eval();
  }

  void of_tangent(CellMatrix<dim>& K) const {
    for (const auto& [a, P] : corners_) {
      auto rows = K.template middleRows<dim>(dim * a);
      rows = (P * rows).eval();
      auto columns = K.template middleCols<dim>(dim * a);
      columns = (columns * P).eval();
      K.template block<dim, dim>(dim * a, dim * a) += stiffness_ * (Tensor<dim>::Identity() - P);
    }
  }

private:
  struct Corner {
    int corner;
    Tensor<dim> P;
  };
  double stiffness_;
  std::vector<Corner> corners_;
};

/// Entries of tangents (or residuals) below which threads cost more than they gain.
constexpr long worth_threads = 1'000'000;

/// The rows or columns that a thread adds to.
struct RowRange {
  int begin, end;

  bool holds(int number) const { return number >= begin && number < end; }
};

/// work(cell, range) for ascending cells by every thread, each with its own range of the numbers
/// below `size`: cells between ranges are computed more than once, but no thread has to wait, and
/// sums do not depend on the number of threads. Returns the first cell whose work() is false,
/// otherwise the number of cells.
template <class Work>
int for_cells(int cells, int entries, std::size_t size, const Work& work) {
  [[maybe_unused]] const int most =  // not read without OpenMP
      long(cells) * entries < worth_threads ? 1 : omp_get_max_threads();
  int failed = cells;
#pragma omp parallel num_threads(most) reduction(min : failed)
  {
    const std::size_t thread = omp_get_thread_num(), threads = omp_get_num_threads();
    const RowRange own{static_cast<int>(thread * size / threads),
                       static_cast<int>((thread + 1) * size / threads)};
    bool good = true;
    for (int c = 0; c < cells && good; ++c) {
      good = work(c, own);
      if (!good) failed = c;  // separate in each thread; the reduction keeps the least
    }
  }
  return failed;
}

/// Whether one of a cell's values has its number in the range.
template <class Cell, class Numbers>
bool meets(const Cell& cell, const Numbers& numbers, const RowRange& range) {
  for (int node : cell)
    for (int i = 0; i < numbers.cols(); ++i)
      if (range.holds(numbers(node, i))) return true;
  return false;
}

/// Adds the columns of K that lie in the range; `position` is the cell's part of the map.
template <int dim, class Cell, class Numbers>
void add_columns(const Cell& cell, const Numbers& columns, const RowRange& range,
                 const int* position, const CellMatrix<dim>& K, std::span<double> values) {
  const double* entry = K.data();
  for (int node : cell)
    for (int j = 0; j < dim; ++j, position += K.rows(), entry += K.rows()) {
      if (!range.holds(columns(node, j))) continue;
      for (int k = 0; k < K.rows(); ++k)
        if (position[k] >= 0) values[position[k]] += entry[k];
    }
}

}  // namespace

template <int dim>
void CellAssembly<dim>::add_residual(const NodalField<dim>* shape,
                                     const NodalField<dim>& displacement,
                                     std::span<double> F) const {
  const int count = static_cast<int>(cells_.size());
  const int failed = for_cells(count, local, F.size(), [&](int c, const RowRange& own) {
    const auto& cell = mesh_.cells[cells_[c]];
    if (!meets(cell, rows_, own)) return true;
    CellNodal<dim> X, u, R;
    gather(cells_[c], shape, displacement, X, u);
    const ElasticModuli moduli = moduli_of(cells_[c]);
    const CellNodal<dim> given = u;
    std::optional<CellProjection<dim>> projection;
    if (keeps_[c]) projection.emplace(cell, *along_, moduli, X).of_displacement(u);
    if (!elastic(cells_[c]).kernel.residual(moduli, X, u, R)) return false;
    if (projection) projection->of_residual(given, R);
    for (int a = 0; a < Mesh<dim>::cell_nodes; ++a)
      for (int i = 0; i < dim; ++i)
        if (const int row = rows_(cell[a], i); own.holds(row)) F[row] += R(a, i);
    return true;
  });
  if (failed < count) throw_inverted(cells_[failed], shape);
}

template <int dim>
void CellAssembly<dim>::add_jacobian(const NodalField<dim>* shape,
                                     const NodalField<dim>& displacement,
                                     std::span<double> values) const {
  const int count = static_cast<int>(cells_.size());
  const int failed = for_cells(count, local * local, size_, [&](int c, const RowRange& own) {
    const auto& cell = mesh_.cells[cells_[c]];
    if (!meets(cell, columns_, own) && !(moves() && meets(cell, shape_columns_, own))) return true;
    CellNodal<dim> X, u, R;
    CellMatrix<dim> K_u, K_d;
    gather(cells_[c], shape, displacement, X, u);
    const ElasticModuli moduli = moduli_of(cells_[c]);
    std::optional<CellProjection<dim>> projection;
    if (keeps_[c]) projection.emplace(cell, *along_, moduli, X).of_displacement(u);
    const CellKernel<dim>& kernel = elastic(cells_[c]).kernel;
    if (!(moves() ? kernel.tangent_ud : kernel.tangent_u)(moduli, X, u, R, K_u, K_d)) return false;
    if (projection) projection->of_tangent(K_u);
    const std::size_t first = std::size_t(c) * local * local;
    add_columns<dim>(cell, columns_, own, map_.data() + first, K_u, values);
    if (moves())
      add_columns<dim>(cell, shape_columns_, own, shape_map_.data() + first, K_d, values);
    return true;
  });
  if (failed < count) throw_inverted(cells_[failed], shape);
}

template class CellAssembly<2>;
template class CellAssembly<3>;

}  // namespace gnomon
