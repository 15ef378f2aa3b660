#include <gnomon/terms/springs.hpp>

namespace gnomon {

template <int dim>
Springs<dim>::Springs(const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets,
                      const Vector<dim>& stiffness, const Numbering& numbering, FieldId u,
                      Section section)
    : u_(u) {
  for (const ContactPatch<dim>& patch : contact_patches<dim>(mesh, facets, {}, section))
    for (int i = 0; i < dim; ++i)
      if (const int row = numbering.number(u, patch.node, i); row >= 0 && stiffness[i] != 0)
        springs_.push_back({row, -1, patch.node, i, stiffness[i] * patch.initial_area});
}

template <int dim>
void Springs<dim>::declare(TermStructure& structure) const {
  for (const Spring& spring : springs_) structure.pattern.add({spring.row}, {spring.row});
}

template <int dim>
void Springs<dim>::map_to(const SparsePattern& pattern) {
  for (Spring& spring : springs_) spring.position = pattern.find(spring.row, spring.row);
}

template <int dim>
void Springs<dim>::add_residual(const Evaluation<dim>& at, std::span<double> F) const {
  for (const Spring& spring : springs_)
    F[spring.row] += spring.stiffness * at.values.vector(u_)(spring.node, spring.component);
}

template <int dim>
void Springs<dim>::add_jacobian(const Evaluation<dim>&, double, std::span<double> values) const {
  for (const Spring& spring : springs_) values[spring.position] += spring.stiffness;
}

template class Springs<2>;
template class Springs<3>;

}  // namespace gnomon
