// The elastic bodies: rows of a displacement field, over the configuration that a shape field
// gives.
#pragma once

#include <gnomon/terms/cell_assembly.hpp>
#include <gnomon/terms/term.hpp>

namespace gnomon {

/// R(d, u) of eq. (24) in the rows of u, integrated over X = X^ + d.
template <int dim>
class BodyTerm : public Term<dim> {
public:
  /// `mesh` must outlive the term.
  BodyTerm(const Mesh<dim>& mesh, const std::vector<Body>& bodies, const Numbering& numbering,
           FieldId u, FieldId d);

  void declare(TermStructure& structure) const override;
  void map_to(const SparsePattern& pattern) override;
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override;
  void add_jacobian(const Evaluation<dim>& at, double rate_weight,
                    std::span<double> values) const override;
  void switching(const Evaluation<dim>&, std::span<double>) const override {}

private:
  FieldId u_, d_;
  NodalNumbers<dim> u_numbers_, d_numbers_;
  CellAssembly<dim> cells_;
};

}  // namespace gnomon
