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
          Section section = Section::plane);

  void declare(TermStructure& structure) const override;
  void map_to(const SparsePattern& pattern) override;
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override;
  void add_jacobian(const Evaluation<dim>& at, double rate_weight,
                    std::span<double> values) const override;
  void switching(const Evaluation<dim>&, std::span<double>) const override {}

private:
  struct Spring {
    int row, position, node, component;
    double stiffness;  // [force / length]
  };
  FieldId u_;
  std::vector<Spring> springs_;
};

}  // namespace gnomon
