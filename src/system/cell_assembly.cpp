#include <fmt/format.h>

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
void CellAssembly<dim>::throw_inverted(int cell, const CellNodal<dim>& X) const {
  const Vector<dim> centre = X.colwise().mean().transpose();
  std::string place = fmt::format("({:.4g}, {:.4g}", centre[0], centre[1]);
  if constexpr (dim == 3) place += fmt::format(", {:.4g}", centre[2]);
  throw RecoverableError(fmt::format("inverted element {} at {})", cell, place));
}

template <int dim>
void CellAssembly<dim>::add_residual(const NodalField<dim>* shape,
                                     const NodalField<dim>& displacement,
                                     std::span<double> F) const {
  CellNodal<dim> X, u, R;
  for (int cell : cells_) {
    gather(cell, shape, displacement, X, u);
    if (!kernel_.residual(law_, X, u, R)) throw_inverted(cell, X);
    for (int a = 0; a < Mesh<dim>::cell_nodes; ++a)
      for (int i = 0; i < dim; ++i)
        if (const int row = rows_(mesh_.cells[cell][a], i); row >= 0) F[row] += R(a, i);
  }
}

template <int dim>
void CellAssembly<dim>::add_jacobian(const NodalField<dim>* shape,
                                     const NodalField<dim>& displacement,
                                     std::span<double> values) const {
  CellNodal<dim> X, u, R;
  CellMatrix<dim> K_u, K_d;
  const auto tangent = shape_columns_ ? kernel_.tangent_ud : kernel_.tangent_u;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    gather(cells_[c], shape, displacement, X, u);
    if (!tangent(law_, X, u, R, K_u, K_d)) throw_inverted(cells_[c], X);
    const int* map = map_.data() + c * local * local;
    for (int k = 0; k < local * local; ++k)
      if (map[k] >= 0) values[map[k]] += K_u.data()[k];
    if (!shape_columns_) continue;
    const int* shape_map = shape_map_.data() + c * local * local;
    for (int k = 0; k < local * local; ++k)
      if (shape_map[k] >= 0) values[shape_map[k]] += K_d.data()[k];
  }
}

template class CellAssembly<2>;
template class CellAssembly<3>;

}  // namespace gnomon
