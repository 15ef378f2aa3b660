#include <gnomon/terms/shape_evolution.hpp>

namespace gnomon {

template <int dim>
EvolutionRows<dim>::EvolutionRows(const Numbering& numbering, const WornSurface<dim>& surface) {
  const auto& nodes = *surface.nodes;
  const auto count = static_cast<Eigen::Index>(nodes.size());
  rows_ = reactions_ = NodalNumbers<dim>::Constant(count, dim, -1);
  for (Eigen::Index c = 0; c < count; ++c) {
    if (!nodes[c].may_move()) {  // its shape is held, or does not wear
      factor_.push_back(0);
      continue;
    }
    rows_.row(c) = numbering.numbers(surface.d).row(nodes[c].node);
    if (surface.mu != FieldId::none) reactions_.row(c) = numbering.numbers(surface.mu).row(c);
    const bool both = rows_.row(c).maxCoeff() >= 0 && reactions_.row(c).maxCoeff() >= 0;
    factor_.push_back(both ? -nodes[c].initial_area * surface.augmentation : 0);
  }
}

template <int dim>
void EvolutionRows<dim>::add(int c, const Vector<dim>& share, std::span<double> F) const {
  for (int i = 0; i < dim; ++i) {
    if (rows_(c, i) < 0) continue;
    F[rows_(c, i)] += share[i];
    if (reactions_(c, i) >= 0) F[reactions_(c, i)] += factor(c) * share[i];
  }
}

template <int dim>
ShapeEvolution<dim>::ShapeEvolution(const Numbering& numbering, const WornSurface<dim>& surface)
    : mu_(surface.mu) {
  const EvolutionRows<dim> rows(numbering, surface);
  const Field& shape = numbering.set()[surface.d];
  for (std::size_t c = 0; c < surface.nodes->size(); ++c) {
    const ContactPatch<dim>& node = (*surface.nodes)[c];
    const int k = static_cast<int>(c);
    const bool carries = shape.carrier_of(node.node) == node.node;
    for (int i = 0; i < dim; ++i) {
      const Row row{carries ? rows.row(k, i) : -1,
                    rows.reaction(k, i),
                    rows.factor(k),
                    node.initial_area,
                    k,
                    i};
      if (row.row >= 0 || row.reaction >= 0) rows_.push_back(row);
    }
  }
}

template <int dim>
void ShapeEvolution<dim>::declare(TermStructure& structure) const {
  for (const Row& row : rows_) {
    structure.pattern.add({row.row, row.reaction}, {row.row});
    structure.pattern.add({row.reaction}, {row.reaction});
  }
}

template <int dim>
void ShapeEvolution<dim>::map_to(const SparsePattern& pattern) {
  const auto find = [&pattern](int row, int column) {
    return row >= 0 && column >= 0 ? pattern.find(row, column) : -1;
  };
  for (Row& row : rows_) {
    row.by_rate = find(row.row, row.row);
    row.reaction_by_rate = find(row.reaction, row.row);
    row.reaction_by_mu = find(row.reaction, row.reaction);
  }
}

template <int dim>
void ShapeEvolution<dim>::add_residual(const Evaluation<dim>& at, std::span<double> F) const {
  for (const Row& row : rows_) {
    const double rate = row.row >= 0 ? at.ydot[row.row] : 0;
    if (row.row >= 0) F[row.row] += rate;
    if (row.reaction >= 0)
      F[row.reaction] +=
          row.factor * rate - row.area * at.values.vector(mu_)(row.entity, row.component);
  }
}

template <int dim>
void ShapeEvolution<dim>::add_jacobian(const Evaluation<dim>&, double rate_weight,
                                       std::span<double> values) const {
  for (const Row& row : rows_) {
    if (row.by_rate >= 0) values[row.by_rate] += rate_weight;
    if (row.reaction_by_rate >= 0) values[row.reaction_by_rate] += row.factor * rate_weight;
    if (row.reaction_by_mu >= 0) values[row.reaction_by_mu] -= row.area;
  }
}

template class EvolutionRows<2>;
template class EvolutionRows<3>;
template class ShapeEvolution<2>;
template class ShapeEvolution<3>;

}  // namespace gnomon
