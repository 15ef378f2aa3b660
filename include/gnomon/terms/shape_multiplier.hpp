// The multiplier form of the constraint on the worn surface, eq. (22): its reaction in the
// auxiliary problem as unknowns mu, with rows of their own,
//
//   R_aux(d) - A^ mu = 0
//
// The augmented multiplier of eq. (29), mu + eps (ddot + Wdot N), has the same value: the rows of d
// are those of wear, and adding a multiple of one row to another changes no iterate.
#pragma once

#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/terms/mesh_motion.hpp>

namespace gnomon {

/// mu at the nodes of the worn surface, where their shape may move. `stress`: its magnitude there
/// is `force` divided by the node's area.
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
class ShapeMultiplier : public Term<dim> {
public:
  /// Mesh, projectors and nodes must outlive the term.
  ShapeMultiplier(const Mesh<dim>& mesh, const NodalProjectors<dim>& along,
                  const MeshMotionLaw& law, const std::vector<ContactPatch<dim>>& nodes,
                  const Numbering& numbering, FieldId d, FieldId mu)
      : d_(d),
        mu_(mu),
        cells_(auxiliary_cells<dim>(mesh, law, multiplier_rows(nodes, numbering, d, mu),
                                    numbering.nodal<dim>(d), &along)) {
    for (std::size_t c = 0; c < nodes.size(); ++c)
      for (int i = 0; i < dim; ++i)
        if (const int row = numbering.number(mu, static_cast<Eigen::Index>(c), i); row >= 0)
          own_.push_back({row, static_cast<int>(c), i, nodes[c].initial_area});
  }

  void declare(TermStructure& structure) const override {
    cells_.add_to_pattern(structure.pattern);
    for (const Row& row : own_) structure.pattern.add({row.row}, {row.row});
  }
  void map_to(const SparsePattern& pattern) override {
    cells_.map_to(pattern);
    for (Row& row : own_) row.position = pattern.find(row.row, row.row);
  }
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override {
    cells_.add_residual(nullptr, at.values.vector(d_), F);
    for (const Row& row : own_)
      F[row.row] -= row.area * at.values.vector(mu_)(row.entity, row.component);
  }
  void add_jacobian(const Evaluation<dim>& at, double, std::span<double> values) const override {
    cells_.add_jacobian(nullptr, at.values.vector(d_), values);
    for (const Row& row : own_) values[row.position] -= row.area;
  }

private:
  /// The rows of mu at the nodes of the surface, elsewhere -1.
  static NodalNumbers<dim> multiplier_rows(const std::vector<ContactPatch<dim>>& nodes,
                                           const Numbering& numbering, FieldId d, FieldId mu) {
    NodalNumbers<dim> rows = NodalNumbers<dim>::Constant(numbering.numbers(d).rows(), dim, -1);
    for (std::size_t c = 0; c < nodes.size(); ++c)
      rows.row(nodes[c].node) = numbering.numbers(mu).row(static_cast<Eigen::Index>(c));
    return rows;
  }

  struct Row {
    int row, entity, component;  // number in y; of mu
    double area;                 // A^
    int position = -1;           // of the diagonal in J
  };
  FieldId d_, mu_;
  CellAssembly<dim> cells_;
  std::vector<Row> own_;
};

}  // namespace gnomon
