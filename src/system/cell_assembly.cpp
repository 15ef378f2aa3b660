#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <gnomon/error.hpp>
#include <gnomon/system/cell_assembly.hpp>

namespace gnomon {

template <int dim>
CellAssembly<dim>::CellAssembly(const Mesh<dim>& mesh, const NeoHookean& law, ElementKind kind,
                                const Numbers& rows, const Numbers& columns,
                                const Numbers* shape_columns)
    : mesh_(mesh),
      law_(law),
      kernel_(SolidKernel<dim>::of(kind)),
      rows_(rows),
      columns_(columns),
      shape_columns_(shape_columns) {
  for (int cell = 0; cell < static_cast<int>(mesh.cells.size()); ++cell)
    for (int node : mesh.cells[cell])
      if (rows.row(node).maxCoeff() >= 0) {
        cells_.push_back(cell);
        break;
      }
  // A frozen shape has no columns at all: then its derivative is not computed either.
  if (shape_columns_ && (shape_columns_->size() == 0 || shape_columns_->maxCoeff() < 0))
    shape_columns_ = nullptr;
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
    if (!shape_columns_) continue;
    cell_numbers(cell, *shape_columns_, columns);
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
    for (int column : cols)
      for (int row : rows) map.push_back(row >= 0 && column >= 0 ? pattern.find(row, column) : -1);
  }
}

template <int dim>
void CellAssembly<dim>::map_to(const SparsePattern& pattern) {
  fill_map(pattern, columns_, map_);
  if (shape_columns_) fill_map(pattern, *shape_columns_, shape_map_);
}

template <int dim>
void CellAssembly<dim>::gather(int cell, const NodalField<dim>* shape,
                               const NodalField<dim>& displacement, CellNodal<dim>& X,
                               CellNodal<dim>& u) const {
  for (int a = 0; a < Mesh<dim>::cell_nodes; ++a) {
    const int node = mesh_.cells[cell][a];
    X.row(a) = mesh_.nodes[node].transpose();
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
  throw RecoverableError(fmt::format("inverted element {} at {})", cell, place));
}

namespace {

/// Cells whose tangents a thread computes before they are added, so that they stay in its cache.
constexpr int cells_at_once = 64;
/// Entries of tangents (or residuals) below which threads cost more than they gain.
constexpr long worth_threads = 1'000'000;

/// compute(cell, value) for all cells, by all threads; then add(cell, value, thread, threads) in
/// ascending order of the cells, by every thread, which adds what is its own. So no two threads
/// write to one place, and sums do not depend on the number of threads. Returns the first cell
/// whose compute() is false, else their number.
template <class Value, class Compute, class Add>
int for_cells(int cells, int entries, const Compute& compute, const Add& add) {
  const int threads = long(cells) * entries < worth_threads ? 1 : omp_get_max_threads();
  const int block = threads == 1 ? 1 : cells_at_once * threads;
  std::vector<Value> values(std::min(block, cells));
  int failed = cells;
#pragma omp parallel num_threads(threads) reduction(min : failed)
  for (int first = 0; first < cells; first += block) {
    const int end = std::min(first + block, cells);
#pragma omp for schedule(static)
    for (int c = first; c < end; ++c)
      if (!compute(c, values[c - first])) failed = std::min(failed, c);
    for (int c = first; c < end; ++c)
      add(c, values[c - first], omp_get_thread_num(), omp_get_num_threads());
#pragma omp barrier
  }
  return failed;
}

/// Whether a row or column of the system is a thread's own: groups of eight in turn, so that
/// neighbouring ones are spread over the threads.
bool owns(int number, int thread, int threads) {
  return number >= 0 && number / 8 % threads == thread;
}

template <int dim>
struct CellTangents {
  CellMatrix<dim> K_u, K_d;
};

}  // namespace

template <int dim>
void CellAssembly<dim>::add_residual(const NodalField<dim>* shape,
                                     const NodalField<dim>& displacement,
                                     std::span<double> F) const {
  const int count = static_cast<int>(cells_.size());
  const int failed = for_cells<CellNodal<dim>>(
      count, local,
      [&](int c, CellNodal<dim>& R) {
        CellNodal<dim> X, u;
        gather(cells_[c], shape, displacement, X, u);
        return kernel_.residual(law_, X, u, R);
      },
      [&](int c, const CellNodal<dim>& R, int thread, int threads) {
        for (int a = 0; a < Mesh<dim>::cell_nodes; ++a)
          for (int i = 0; i < dim; ++i)
            if (const int row = rows_(mesh_.cells[cells_[c]][a], i); owns(row, thread, threads))
              F[row] += R(a, i);
      });
  if (failed < count) throw_inverted(cells_[failed], shape);
}

template <int dim>
void CellAssembly<dim>::add_columns(int c, const Numbers& columns, const std::vector<int>& map,
                                    const CellMatrix<dim>& K, int thread, int threads,
                                    std::span<double> values) const {
  const int* position = map.data() + std::size_t(c) * local * local;
  for (int b = 0; b < Mesh<dim>::cell_nodes; ++b)
    for (int j = 0; j < dim; ++j, position += local) {
      if (!owns(columns(mesh_.cells[cells_[c]][b], j), thread, threads)) continue;
      const double* column = K.col(dim * b + j).data();
      for (int k = 0; k < local; ++k)
        if (position[k] >= 0) values[position[k]] += column[k];
    }
}

template <int dim>
void CellAssembly<dim>::add_jacobian(const NodalField<dim>* shape,
                                     const NodalField<dim>& displacement,
                                     std::span<double> values) const {
  const int count = static_cast<int>(cells_.size());
  const auto tangent = shape_columns_ ? kernel_.tangent_ud : kernel_.tangent_u;
  const int failed = for_cells<CellTangents<dim>>(
      count, local * local,
      [&](int c, CellTangents<dim>& K) {
        CellNodal<dim> X, u, R;
        gather(cells_[c], shape, displacement, X, u);
        return tangent(law_, X, u, R, K.K_u, K.K_d);
      },
      [&](int c, const CellTangents<dim>& K, int thread, int threads) {
        add_columns(c, columns_, map_, K.K_u, thread, threads, values);
        if (shape_columns_)
          add_columns(c, *shape_columns_, shape_map_, K.K_d, thread, threads, values);
      });
  if (failed < count) throw_inverted(cells_[failed], shape);
}

template class CellAssembly<2>;
template class CellAssembly<3>;

}  // namespace gnomon
