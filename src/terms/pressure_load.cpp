#include <gnomon/mesh/corner_derivatives.hpp>
#include <gnomon/terms/pressure_load.hpp>

namespace gnomon {

template <int dim>
PressureLoad<dim>::PressureLoad(const Mesh<dim>& mesh,
                                const std::vector<typename Mesh<dim>::Facet>& facets,
                                double pressure, LoadHistory history, const Numbering& numbering,
                                FieldId u, FieldId d, Section section)
    : mesh_(mesh),
      pressure_(pressure),
      history_(std::move(history)),
      u_(u),
      d_(d),
      u_numbers_(numbering.nodal<dim>(u)),
      d_numbers_(numbering.nodal<dim>(d)),
      patches_(contact_patches<dim>(mesh, facets, {}, section)) {}

template <int dim>
std::vector<int> PressureLoad<dim>::rows(const ContactPatch<dim>& patch) const {
  std::vector<int> result(dim);
  for (int i = 0; i < dim; ++i) result[i] = u_numbers_(patch.node, i);
  return result;
}

template <int dim>
std::vector<int> PressureLoad<dim>::columns(const ContactPatch<dim>& patch) const {
  std::vector<int> result;
  for (const NodalNumbers<dim>* numbers : {&u_numbers_, &d_numbers_})
    for (int node : patch.nodes)
      for (int i = 0; i < dim; ++i) result.push_back((*numbers)(node, i));
  return result;
}

template <int dim>
void PressureLoad<dim>::declare(TermStructure& structure) const {
  for (const ContactPatch<dim>& patch : patches_)
    structure.pattern.add(rows(patch), columns(patch));
  structure.breakpoints.insert(structure.breakpoints.end(), history_.times().begin(),
                               history_.times().end());
}

template <int dim>
void PressureLoad<dim>::map_to(const SparsePattern& pattern) {
  map_.clear();
  for (const ContactPatch<dim>& patch : patches_) {
    std::vector<int>& map = map_.emplace_back();
    const std::vector<int> row = rows(patch);
    for (int column : columns(patch))
      for (int r : row) map.push_back(r >= 0 && column >= 0 ? pattern.find(r, column) : -1);
  }
}

template <int dim>
double PressureLoad<dim>::pressure(const Evaluation<dim>& at) const {
  return pressure_ * at.load_fraction * history_.factor(at.t, at.within);
}

template <int dim>
PatchNodal<dim> PressureLoad<dim>::current(const Evaluation<dim>& at,
                                           const ContactPatch<dim>& patch) const {
  PatchNodal<dim> x(static_cast<Eigen::Index>(patch.nodes.size()), dim);
  for (Eigen::Index p = 0; p < x.rows(); ++p) {
    const int node = patch.nodes[p];
    x.row(p) = mesh_.nodes[node].transpose() + at.values.vector(d_).row(node) +
               at.values.vector(u_).row(node);
  }
  return x;
}

template <int dim>
void PressureLoad<dim>::add_residual(const Evaluation<dim>& at, std::span<double> F) const {
  const double p = pressure(at);
  for (const ContactPatch<dim>& patch : patches_) {
    const PatchNodal<dim> x = current(at, patch);
    Vector<dim> force = Vector<dim>::Zero();
    for (const auto& corner : patch.corners)
      force += p * corner_volume_gradient<dim, double>(corner, x);
    for (int i = 0; i < dim; ++i)
      if (const int row = u_numbers_(patch.node, i); row >= 0) F[row] += force[i];
  }
}

/// The current positions depend on u and d alike.
template <int dim>
void PressureLoad<dim>::add_jacobian(const Evaluation<dim>& at, double,
                                     std::span<double> values) const {
  const double p = pressure(at);
  for (std::size_t k = 0; k < patches_.size(); ++k) {
    const ContactPatch<dim>& patch = patches_[k];
    const PatchNodal<dim> x = current(at, patch);
    std::array<Tensor<dim>, max_patch_nodes> by_x;
    by_x.fill(Tensor<dim>::Zero());
    for (const auto& corner : patch.corners) {
      const auto derivative = volume_gradient_derivative<dim>(corner, x);
      for (std::size_t n = 0; n < derivative.size(); ++n)
        by_x[corner.nodes[n]] += p * derivative[n];
    }
    const std::size_t size = patch.nodes.size();
    for (std::size_t column = 0; column < 2 * size * dim; ++column)
      for (int i = 0; i < dim; ++i)
        if (const int position = map_[k][column * dim + i]; position >= 0)
          values[position] += by_x[column / dim % size](i, column % dim);
  }
}

template class PressureLoad<2>;
template class PressureLoad<3>;

}  // namespace gnomon
