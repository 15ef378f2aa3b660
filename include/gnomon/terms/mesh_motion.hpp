// The auxiliary elasticity problem that moves the mesh behind the worn surface, eq. (20): over the
// cells of the body, or over those of its cross-section where the shape is uniform along x.
#pragma once

#include <gnomon/terms/cell_assembly.hpp>
#include <memory>

namespace gnomon {

template <int dim>
class MeshMotion {
public:
  /// References must outlive the object.
  MeshMotion(const WornBody<dim>& body, const Unknowns<dim>& unknowns);
  ~MeshMotion();

  void add_to_pattern(PatternBuilder& builder) const;
  /// Computes the scatter map; call once, after the pattern is built.
  void map_to(const SparsePattern& pattern);
  /// F += R of eq. (28) at the shape d (nodes x dim). Throws RecoverableError on an inverted cell.
  void add_residual(const NodalField<dim>& d, std::span<double> F) const;
  void add_jacobian(const NodalField<dim>& d, std::span<double> values) const;

private:
  struct Section;
  std::unique_ptr<CellAssembly<dim>> cells_;
  std::unique_ptr<Section> section_;  // one of the two
};

}  // namespace gnomon
