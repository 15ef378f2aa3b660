// The rows that move the worn surface, eq. (14): ddot + sum over the sources of Wdot N = 0.
#pragma once

#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/terms/term.hpp>

namespace gnomon {

/// ddot in the rows of d on the worn surface.
template <int dim>
class ShapeEvolution : public Term<dim> {
public:
  /// `nodes`: of the worn surface; `d`: the shape, at all nodes of the mesh.
  ShapeEvolution(const Numbering& numbering, const std::vector<ContactPatch<dim>>& nodes,
                 FieldId d) {
    const FieldSet& set = numbering.set();
    const Field& shape = set[d];
    for (const ContactPatch<dim>& patch : nodes)
      for (int i = 0; i < dim; ++i) {
        const int number = numbering.number(d, patch.node, i), block = shape.block(patch.node, i);
        if (number < 0 || !set.blocks[block].differential ||
            shape.carrier_of(patch.node) != patch.node)
          continue;
        const int row = numbering.meaning(number).unknown;
        if (rows_.empty() || rows_.back() != row) rows_.push_back(row);
      }
  }

  void declare(TermStructure& structure) const override {
    for (int row : rows_) structure.pattern.add({row}, {row});
  }
  void map_to(const SparsePattern& pattern) override {
    for (int row : rows_) by_rate_.push_back(pattern.find(row, row));
  }
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override {
    for (int row : rows_) F[row] += at.ydot[row];
  }
  void add_jacobian(const Evaluation<dim>&, double rate_weight,
                    std::span<double> values) const override {
    for (int position : by_rate_) values[position] += rate_weight;
  }

private:
  std::vector<int> rows_, by_rate_;  // numbers; their positions in J
};

}  // namespace gnomon
