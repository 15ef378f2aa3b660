#include <gnomon/terms/shape_multiplier.hpp>

namespace gnomon {

namespace {

/// The rows of mu at the nodes of the surface, elsewhere -1.
template <int dim>
NodalNumbers<dim> multiplier_rows(const std::vector<ContactPatch<dim>>& nodes,
                                  const Numbering& numbering, FieldId d, FieldId mu) {
  NodalNumbers<dim> rows = NodalNumbers<dim>::Constant(numbering.numbers(d).rows(), dim, -1);
  for (std::size_t c = 0; c < nodes.size(); ++c)
    rows.row(nodes[c].node) = numbering.numbers(mu).row(static_cast<Eigen::Index>(c));
  return rows;
}

}  // namespace

template <int dim>
Field shape_multiplier_field(const std::vector<ContactPatch<dim>>& nodes,
                             const NodalFlags<dim>& shape_fixed, double force, int block) {
  std::vector<int> at;
  for (const ContactPatch<dim>& patch : nodes) at.push_back(patch.node);
  Field mu("shape_multiplier", std::move(at), dim);
  mu.row_scale.setConstant(force);
  for (Eigen::Index c = 0; c < mu.entities(); ++c) {
    mu.unknown_scale.row(c).setConstant(force / nodes[c].initial_area);
    for (int i = 0; i < dim; ++i)
      if (nodes[c].may_move() && !shape_fixed(nodes[c].node, i)) mu.block(c, i) = block;
  }
  return mu;
}

template <int dim>
ShapeMultiplier<dim>::ShapeMultiplier(const Mesh<dim>& mesh, const NodalProjectors<dim>& along,
                                      const MeshMotionLaw& law,
                                      const std::vector<ContactPatch<dim>>& nodes,
                                      const Numbering& numbering, FieldId d, FieldId mu)
    : d_(d),
      mu_(mu),
      rows_(multiplier_rows(nodes, numbering, d, mu)),
      columns_(numbering.nodal<dim>(d)),
      cells_(auxiliary_cells<dim>(mesh, law, rows_, columns_, &along)) {
  for (std::size_t c = 0; c < nodes.size(); ++c)
    for (int i = 0; i < dim; ++i)
      if (const int row = rows_(nodes[c].node, i); row >= 0)
        own_.push_back({row, static_cast<int>(c), i, nodes[c].initial_area});
}

template <int dim>
void ShapeMultiplier<dim>::declare(TermStructure& structure) const {
  cells_.add_to_pattern(structure.pattern);
  for (const Row& row : own_) structure.pattern.add({row.row}, {row.row});
}

template <int dim>
void ShapeMultiplier<dim>::map_to(const SparsePattern& pattern) {
  cells_.map_to(pattern);
  for (Row& row : own_) row.position = pattern.find(row.row, row.row);
}

template <int dim>
void ShapeMultiplier<dim>::add_residual(const Evaluation<dim>& at, std::span<double> F) const {
  cells_.add_residual(nullptr, at.values.vector(d_), F);
  for (const Row& row : own_)
    F[row.row] -= row.area * at.values.vector(mu_)(row.entity, row.component);
}

template <int dim>
void ShapeMultiplier<dim>::add_jacobian(const Evaluation<dim>& at, double,
                                        std::span<double> values) const {
  cells_.add_jacobian(nullptr, at.values.vector(d_), values);
  for (const Row& row : own_) values[row.position] -= row.area;
}

template Field shape_multiplier_field(const std::vector<ContactPatch<2>>&, const NodalFlags<2>&,
                                      double, int);
template Field shape_multiplier_field(const std::vector<ContactPatch<3>>&, const NodalFlags<3>&,
                                      double, int);
template class ShapeMultiplier<2>;
template class ShapeMultiplier<3>;

}  // namespace gnomon
