// The elastic bodies: rows of a displacement field, over the configuration that a shape field
// gives.
#pragma once

#include <gnomon/terms/cell_assembly.hpp>
#include <gnomon/terms/term.hpp>

namespace gnomon {

/// R(d, u) of eq. (24) in the rows of u, integrated over X = X^ + d; without a shape field over X^.
template <int dim>
class BodyTerm : public Term<dim> {
public:
  /// `mesh` must outlive the term.
  BodyTerm(const Mesh<dim>& mesh, const std::vector<Body>& bodies, const Numbering& numbering,
           FieldId u, FieldId d)
      : u_(u),
        d_(d),
        cells_(mesh, bodies, numbering.nodal<dim>(u), numbering.nodal<dim>(u),
               numbering.nodal<dim>(d)) {}

  void declare(TermStructure& structure) const override {
    cells_.add_to_pattern(structure.pattern);
    structure.slow = dim == 3;  // in the plane assembly is cheap beside factors
    structure.sweeps_cells = true;
  }
  void map_to(const SparsePattern& pattern) override { cells_.map_to(pattern); }
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override {
    cells_.add_residual(shape(at), at.values.vector(u_), F);
  }
  void add_jacobian(const Evaluation<dim>& at, double, std::span<double> values) const override {
    cells_.add_jacobian(shape(at), at.values.vector(u_), values);
  }

private:
  const NodalField<dim>* shape(const Evaluation<dim>& at) const {
    return d_ == FieldId::none ? nullptr : &at.values.vector(d_);
  }

  FieldId u_, d_;
  CellAssembly<dim> cells_;
};

}  // namespace gnomon
