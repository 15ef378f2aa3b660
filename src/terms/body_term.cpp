#include <gnomon/terms/body_term.hpp>

namespace gnomon {

template <int dim>
BodyTerm<dim>::BodyTerm(const Mesh<dim>& mesh, const std::vector<Body>& bodies,
                        const Numbering& numbering, FieldId u, FieldId d)
    : u_(u),
      d_(d),
      u_numbers_(numbering.nodal<dim>(u)),
      d_numbers_(numbering.nodal<dim>(d)),
      cells_(mesh, bodies, u_numbers_, u_numbers_, &d_numbers_) {}

template <int dim>
void BodyTerm<dim>::declare(TermStructure& structure) const {
  cells_.add_to_pattern(structure.pattern);
  structure.slow = dim == 3;  // in the plane assembly is cheap beside factors
  structure.sweeps_cells = true;
}

template <int dim>
void BodyTerm<dim>::map_to(const SparsePattern& pattern) {
  cells_.map_to(pattern);
}

template <int dim>
void BodyTerm<dim>::add_residual(const Evaluation<dim>& at, std::span<double> F) const {
  cells_.add_residual(&at.values.vector(d_), at.values.vector(u_), F);
}

template <int dim>
void BodyTerm<dim>::add_jacobian(const Evaluation<dim>& at, double,
                                 std::span<double> values) const {
  cells_.add_jacobian(&at.values.vector(d_), at.values.vector(u_), values);
}

template class BodyTerm<2>;
template class BodyTerm<3>;

}  // namespace gnomon
