// The auxiliary elasticity problem that moves the mesh behind the worn surface, eq. (20): over the
// cells of the body, or over those of its cross-section if the shape is uniform along x.
#pragma once

#include <gnomon/mesh/extrusion.hpp>
#include <gnomon/terms/cell_assembly.hpp>
#include <gnomon/terms/term.hpp>
#include <optional>

namespace gnomon {

/// The cells of the auxiliary problem with these rows. Mesh and projectors must outlive the
/// assembly.
template <int dim>
CellAssembly<dim> auxiliary_cells(const Mesh<dim>& mesh, const MeshMotionLaw& law,
                                  NodalNumbers<dim> rows, NodalNumbers<dim> columns,
                                  const NodalProjectors<dim>* along = nullptr);

/// Adds to the rows of d off the worn surface.
template <int dim>
class MeshMotion : public Term<dim> {
public:
  /// `section`: null if the shape is that of the whole mesh. `along`: ShapeMotion::along, not
  /// read with a section. All three must outlive the term.
  MeshMotion(const Mesh<dim>& mesh, const CrossSection* section, const NodalProjectors<dim>& along,
             const MeshMotionLaw& law, const Numbering& numbering, FieldId d);

  void declare(TermStructure& structure) const override;
  void map_to(const SparsePattern& pattern) override;
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override;
  void add_jacobian(const Evaluation<dim>& at, double rate_weight,
                    std::span<double> values) const override;

private:
  FieldId d_;
  const CrossSection* section_;
  std::optional<CellAssembly<dim>> whole_;
  std::optional<CellAssembly<2>> across_;  // of the cross-section: one of the two
};

}  // namespace gnomon
