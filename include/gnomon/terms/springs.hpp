// A part of the boundary on elastic springs: an elastic foundation.
#pragma once

#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/terms/term.hpp>

namespace gnomon {

/// k A^_i u_i in the rows of u of the nodes of a boundary part, A^_i their shares of its initial
/// area.
template <int dim>
class Springs : public Term<dim> {
public:
  /// `stiffness`: traction per unit of displacement, for each component; zero: no spring [stress /
  /// length]. The field is the displacement at all nodes of the mesh.
  Springs(const Mesh<dim>& mesh, const std::vector<typename Mesh<dim>::Facet>& facets,
          const Vector<dim>& stiffness, const Numbering& numbering, FieldId u,
          Section section = Section::plane)
      : u_(u) {
    for (const ContactPatch<dim>& patch : contact_patches<dim>(mesh, facets, {}, section))
      for (int i = 0; i < dim; ++i)
        if (const int row = numbering.number(u, patch.node, i); row >= 0 && stiffness[i] != 0)
          springs_.push_back({row, -1, patch.node, i, stiffness[i] * patch.initial_area});
  }

  void declare(TermStructure& structure) const override {
    for (const Spring& spring : springs_) structure.pattern.add({spring.row}, {spring.row});
  }
  void map_to(const SparsePattern& pattern) override {
    for (Spring& spring : springs_) spring.position = pattern.find(spring.row, spring.row);
  }
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override {
    for (const Spring& spring : springs_)
      F[spring.row] += spring.stiffness * at.values.vector(u_)(spring.node, spring.component);
  }
  void add_jacobian(const Evaluation<dim>&, double, std::span<double> values) const override {
    for (const Spring& spring : springs_) values[spring.position] += spring.stiffness;
  }

private:
  struct Spring {
    int row, position, node, component;
    double stiffness;  // [force / length]
  };
  FieldId u_;
  std::vector<Spring> springs_;
};

}  // namespace gnomon
