#include <gnomon/terms/shape_evolution.hpp>

namespace gnomon {

template <int dim>
ShapeEvolution<dim>::ShapeEvolution(const Numbering& numbering,
                                    const std::vector<ContactPatch<dim>>& nodes, FieldId d) {
  const FieldSet& set = numbering.set();
  const Field& shape = set[d];
  for (const ContactPatch<dim>& patch : nodes)
    for (int i = 0; i < dim; ++i) {
      const int row = numbering.number(d, patch.node, i), block = shape.block(patch.node, i);
      if (row >= 0 && set.blocks[block].differential && shape.carrier_of(patch.node) == patch.node)
        rows_.push_back(row);
    }
}

template <int dim>
void ShapeEvolution<dim>::declare(TermStructure& structure) const {
  for (int row : rows_) structure.pattern.add({row}, {row});
}

template <int dim>
void ShapeEvolution<dim>::map_to(const SparsePattern& pattern) {
  for (int row : rows_) by_rate_.push_back(pattern.find(row, row));
}

template <int dim>
void ShapeEvolution<dim>::add_residual(const Evaluation<dim>& at, std::span<double> F) const {
  for (int row : rows_) F[row] += at.ydot[row];
}

template <int dim>
void ShapeEvolution<dim>::add_jacobian(const Evaluation<dim>&, double rate_weight,
                                       std::span<double> values) const {
  for (int position : by_rate_) values[position] += rate_weight;
}

template class ShapeEvolution<2>;
template class ShapeEvolution<3>;

}  // namespace gnomon
