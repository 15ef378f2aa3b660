// A pressure on a part of the boundary that follows the deformed surface, like that of a fluid.
#pragma once

#include <gnomon/laws/load_history.hpp>
#include <gnomon/mesh/contact_patch.hpp>
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
               FieldId d, Section section = Section::plane);

  void declare(TermStructure& structure) const override;
  void map_to(const SparsePattern& pattern) override;
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override;
  void add_jacobian(const Evaluation<dim>& at, double rate_weight,
                    std::span<double> values) const override;
  void switching(const Evaluation<dim>&, std::span<double>) const override {}

private:
  double pressure(const Evaluation<dim>& at) const;
  PatchNodal<dim> current(const Evaluation<dim>& at, const ContactPatch<dim>& patch) const;
  std::vector<int> rows(const ContactPatch<dim>& patch) const;
  std::vector<int> columns(const ContactPatch<dim>& patch) const;  // u of the patch, then d

  const Mesh<dim>& mesh_;
  double pressure_;
  LoadHistory history_;
  FieldId u_, d_;
  NodalNumbers<dim> u_numbers_, d_numbers_;
  std::vector<ContactPatch<dim>> patches_;
  std::vector<std::vector<int>> map_;  // of each patch, column by column; -1: none
};

}  // namespace gnomon
