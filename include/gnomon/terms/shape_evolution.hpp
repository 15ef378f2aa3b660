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
                 FieldId d);

  void declare(TermStructure& structure) const override;
  void map_to(const SparsePattern& pattern) override;
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override;
  void add_jacobian(const Evaluation<dim>& at, double rate_weight,
                    std::span<double> values) const override;
  void switching(const Evaluation<dim>&, std::span<double>) const override {}

private:
  std::vector<int> rows_, by_rate_;  // numbers; their positions in J
};

}  // namespace gnomon
