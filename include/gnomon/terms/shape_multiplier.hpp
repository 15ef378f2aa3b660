// The multiplier form of the constraint on the worn surface, eq. (22): its reaction in the
// auxiliary problem as unknowns mu, with rows of their own,
//
//   R_aux(d) - A^ mu = 0
//
// The augmented multiplier of eq. (29), mu + eps (ddot + Wdot N), has the same value: the rows of d
// are those of wear, and adding a multiple of one row to another changes no iterate.
#pragma once

#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/terms/mesh_motion.hpp>

namespace gnomon {

/// mu at the nodes of the worn surface, where their shape may move. `stress`: its magnitude there
/// is `force` divided by the node's area.
template <int dim>
Field shape_multiplier_field(const std::vector<ContactPatch<dim>>& nodes,
                             const NodalFlags<dim>& shape_fixed, double force, int block);

template <int dim>
class ShapeMultiplier : public Term<dim> {
public:
  /// Mesh, projectors and nodes must outlive the term.
  ShapeMultiplier(const Mesh<dim>& mesh, const NodalProjectors<dim>& along,
                  const MeshMotionLaw& law, const std::vector<ContactPatch<dim>>& nodes,
                  const Numbering& numbering, FieldId d, FieldId mu);

  void declare(TermStructure& structure) const override;
  void map_to(const SparsePattern& pattern) override;
  void add_residual(const Evaluation<dim>& at, std::span<double> F) const override;
  void add_jacobian(const Evaluation<dim>& at, double rate_weight,
                    std::span<double> values) const override;
  void switching(const Evaluation<dim>&, std::span<double>) const override {}

private:
  struct Row {
    int row, entity, component;  // number in y; of mu
    double area;                 // A^
    int position = -1;           // of the diagonal in J
  };
  FieldId d_, mu_;
  NodalNumbers<dim> rows_, columns_;
  CellAssembly<dim> cells_;
  std::vector<Row> own_;
};

}  // namespace gnomon
