#include <cmath>
#include <gnomon/fields/block.hpp>
#include <gnomon/terms/mesh_motion.hpp>

namespace gnomon {

namespace {

/// Factors of the law with which small cells move almost rigidly, one per cell; 1 for the mean
/// volume.
template <int dim>
std::vector<double> stiffness_by_volume(const Mesh<dim>& mesh, double exponent) {
  if (exponent == 0) return {};
  std::vector<double> factors;
  double total = 0;
  for (const auto& cell : mesh.cells) {
    factors.push_back(cell_volume<dim>(mesh.positions(cell)));
    total += factors.back();
  }
  const double mean = total / static_cast<double>(factors.size());
  for (double& factor : factors) factor = std::pow(mean / factor, exponent);
  return factors;
}

/// Row of the auxiliary equilibrium of each shape value: its own number off the worn surface,
/// otherwise -1.
template <int dim>
NodalNumbers<dim> auxiliary_rows(const Numbering& numbering, FieldId d) {
  NodalNumbers<dim> rows = numbering.nodal<dim>(d);
  const FieldSet& set = numbering.set();
  for (Eigen::Index k = 0; k < rows.size(); ++k)
    if (const int block = set[d].block.data()[k]; block >= 0 && set.blocks[block].differential)
      rows.data()[k] = -1;
  return rows;
}

}  // namespace

template <int dim>
CellAssembly<dim> auxiliary_cells(const Mesh<dim>& mesh, const MeshMotionLaw& law,
                                  const NodalNumbers<dim>& rows, const NodalNumbers<dim>& columns,
                                  const NodalProjectors<dim>* along) {
  const Body body{.material = law.material,
                  .element = {ElementTechnology::plain, Kinematics::finite}};
  return {mesh, {body}, rows, columns, nullptr, stiffness_by_volume(mesh, law.stiffening), along};
}

template <int dim>
struct MeshMotion<dim>::Whole {
  NodalNumbers<dim> rows, columns;
  CellAssembly<dim> cells;

  Whole(const Mesh<dim>& mesh, const NodalProjectors<dim>& along, const MeshMotionLaw& law,
        const Numbering& numbering, FieldId d)
      : rows(auxiliary_rows<dim>(numbering, d)),
        columns(numbering.nodal<dim>(d)),
        cells(auxiliary_cells<dim>(mesh, law, rows, columns, &along)) {}
};

/// The cross-section with its unknowns, those of the carrying nodes of the body: components (y, z).
template <int dim>
struct MeshMotion<dim>::Section {
  const CrossSection& section;
  NodalNumbers<2> rows, columns;
  CellAssembly<2> cells;

  Section(const CrossSection& s, const MeshMotionLaw& law, const Numbering& numbering, FieldId d)
      : section(s),
        rows(taken(auxiliary_rows<dim>(numbering, d))),
        columns(taken(numbering.nodal<dim>(d))),
        cells(auxiliary_cells<2>(section.mesh, law, rows, columns)) {}

  template <class Nodal>
  auto taken(const Nodal& nodal) const {
    Eigen::Matrix<typename Nodal::Scalar, Eigen::Dynamic, 2, Eigen::RowMajor> result(
        section.node.size(), 2);
    for (std::size_t s = 0; s < section.node.size(); ++s)
      result.row(s) = nodal.row(section.node[s]).template tail<2>();
    return result;
  }
};

template <int dim>
MeshMotion<dim>::MeshMotion(const Mesh<dim>& mesh, const CrossSection* section,
                            const NodalProjectors<dim>& along, const MeshMotionLaw& law,
                            const Numbering& numbering, FieldId d)
    : d_(d) {
  if (section)
    section_ = std::make_unique<Section>(*section, law, numbering, d);
  else
    whole_ = std::make_unique<Whole>(mesh, along, law, numbering, d);
}

template <int dim>
MeshMotion<dim>::~MeshMotion() = default;

template <int dim>
void MeshMotion<dim>::declare(TermStructure& structure) const {
  section_ ? section_->cells.add_to_pattern(structure.pattern)
           : whole_->cells.add_to_pattern(structure.pattern);
  structure.slow = dim == 3;  // in the plane assembly is cheap beside factors
  structure.sweeps_cells = true;
}

template <int dim>
void MeshMotion<dim>::map_to(const SparsePattern& pattern) {
  section_ ? section_->cells.map_to(pattern) : whole_->cells.map_to(pattern);
}

template <int dim>
void MeshMotion<dim>::add_residual(const Evaluation<dim>& at, std::span<double> F) const {
  const NodalField<dim>& d = at.values.vector(d_);
  section_ ? section_->cells.add_residual(nullptr, section_->taken(d), F)
           : whole_->cells.add_residual(nullptr, d, F);
}

template <int dim>
void MeshMotion<dim>::add_jacobian(const Evaluation<dim>& at, double,
                                   std::span<double> values) const {
  const NodalField<dim>& d = at.values.vector(d_);
  section_ ? section_->cells.add_jacobian(nullptr, section_->taken(d), values)
           : whole_->cells.add_jacobian(nullptr, d, values);
}

template CellAssembly<2> auxiliary_cells(const Mesh<2>&, const MeshMotionLaw&,
                                         const NodalNumbers<2>&, const NodalNumbers<2>&,
                                         const NodalProjectors<2>*);
template CellAssembly<3> auxiliary_cells(const Mesh<3>&, const MeshMotionLaw&,
                                         const NodalNumbers<3>&, const NodalNumbers<3>&,
                                         const NodalProjectors<3>*);
template class MeshMotion<2>;
template class MeshMotion<3>;

}  // namespace gnomon
