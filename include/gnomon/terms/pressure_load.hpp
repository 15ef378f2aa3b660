// A pressure on a part of the boundary that follows the deformed surface, like that of a fluid.
#pragma once

#include <gnomon/laws/load_history.hpp>
#include <gnomon/mesh/corner_derivatives.hpp>
#include <gnomon/terms/term.hpp>

namespace gnomon {

/// factor(t) p dV/dx in the rows of u, where dV/dx, the derivative of the body's volume with
/// respect to the current position of a node,
/// is the integral of its shape function times the outward area vector (of a body of revolution:
/// over the whole circumference).
template <int dim>
class PressureLoad : public Term<dim> {
public:
  /// The fields are displacement and shape at all nodes of the mesh. `pressure`: at factor one
  /// [stress], positive if it pushes on the body. The mesh must outlive the term.
  PressureLoad(const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets,
               double pressure, LoadHistory history, const Numbering& numbering, FieldId u,
               FieldId d, Section section = Section::plane)
      : mesh_(mesh),
        pressure_(pressure),
        history_(std::move(history)),
        u_(u),
        d_(d),
        u_numbers_(numbering.nodal<dim>(u)),
        d_numbers_(numbering.nodal<dim>(d)),
        patches_(contact_patches<dim>(mesh, facets, {}, section)) {}

  void declare(TermStructure& structure) const override {
    for (const ContactPatch<dim>& patch : patches_)
      structure.pattern.add(rows(patch), columns(patch));
    structure.breakpoints.insert(structure.breakpoints.end(), history_.times().begin(),
                                 history_.times().end());
  }
  void map_to(const SparsePattern& pattern) override {
    map_.clear();
    for (const ContactPatch<dim>& patch : patches_)
      map_.push_back(pattern.positions(rows(patch), columns(patch)));
  }

  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override {
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
  void add_jacobian(const Evaluation<dim>& at, double, std::span<double> values) const override {
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

private:
  double pressure(const Evaluation<dim>& at) const {
    return pressure_ * at.load_fraction * history_.factor(at.t, at.within);
  }
  PatchNodal<dim> current(const Evaluation<dim>& at, const ContactPatch<dim>& patch) const {
    PatchNodal<dim> x(static_cast<Eigen::Index>(patch.nodes.size()), dim);
    for (Eigen::Index p = 0; p < x.rows(); ++p) {
      const int node = patch.nodes[p];
      x.row(p) = mesh_.nodes[node].transpose() + at.values.vector(d_).row(node) +
                 at.values.vector(u_).row(node);
    }
    return x;
  }
  std::vector<int> rows(const ContactPatch<dim>& patch) const {
    std::vector<int> result(dim);
    for (int i = 0; i < dim; ++i) result[i] = u_numbers_(patch.node, i);
    return result;
  }
  /// u of the patch, then d.
  std::vector<int> columns(const ContactPatch<dim>& patch) const {
    std::vector<int> result;
    for (const NodalNumbers<dim>* numbers : {&u_numbers_, &d_numbers_})
      for (int node : patch.nodes)
        for (int i = 0; i < dim; ++i) result.push_back((*numbers)(node, i));
    return result;
  }

  const Mesh<dim>& mesh_;
  double pressure_;
  LoadHistory history_;
  FieldId u_, d_;
  NodalNumbers<dim> u_numbers_, d_numbers_;
  std::vector<ContactPatch<dim>> patches_;
  std::vector<std::vector<int>> map_;  // of each patch, column by column; -1: none
};

}  // namespace gnomon
