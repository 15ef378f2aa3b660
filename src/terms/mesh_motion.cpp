#include <cmath>
#include <gnomon/fields/block.hpp>
#include <gnomon/terms/mesh_motion.hpp>
#include <utility>

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

/// Of nodal values of the body those of a cross-section, at its carrying nodes: components (y, z).
template <class Nodal>
auto taken(const CrossSection& section, const Nodal& nodal) {
  Eigen::Matrix<typename Nodal::Scalar, Eigen::Dynamic, 2, Eigen::RowMajor> result(
      section.node.size(), 2);
  for (std::size_t s = 0; s < section.node.size(); ++s)
    result.row(s) = nodal.row(section.node[s]).template tail<2>();
  return result;
}

}  // namespace

template <int dim>
CellAssembly<dim> auxiliary_cells(const Mesh<dim>& mesh, const MeshMotionLaw& law,
                                  NodalNumbers<dim> rows, NodalNumbers<dim> columns,
                                  const NodalProjectors<dim>* along) {
  const Body body{.material = law.material,
                  .element = {ElementTechnology::plain, Kinematics::finite}};
  return {mesh,
          {body},
          std::move(rows),
          std::move(columns),
          {},
          stiffness_by_volume(mesh, law.stiffening),
          along};
}

template <int dim>
MeshMotion<dim>::MeshMotion(const Mesh<dim>& mesh, const CrossSection* section,
                            const NodalProjectors<dim>& along, const MeshMotionLaw& law,
                            const Numbering& numbering, FieldId d)
    : d_(d), section_(section) {
  const NodalNumbers<dim> rows = auxiliary_rows<dim>(numbering, d),
                          columns = numbering.nodal<dim>(d);
  if (section)
    across_.emplace(
        auxiliary_cells<2>(section->mesh, law, taken(*section, rows), taken(*section, columns)));
  else
    whole_.emplace(auxiliary_cells<dim>(mesh, law, rows, columns, &along));
}

template <int dim>
void MeshMotion<dim>::declare(TermStructure& structure) const {
  section_ ? across_->add_to_pattern(structure.pattern) : whole_->add_to_pattern(structure.pattern);
  structure.slow = dim == 3;  // in the plane assembly is cheap beside factors
  structure.sweeps_cells = true;
}

template <int dim>
void MeshMotion<dim>::map_to(const SparsePattern& pattern) {
  section_ ? across_->map_to(pattern) : whole_->map_to(pattern);
}

template <int dim>
void MeshMotion<dim>::add_residual(const Evaluation<dim>& at, std::span<double> F) const {
  const NodalField<dim>& d = at.values.vector(d_);
  section_ ? across_->add_residual(nullptr, taken(*section_, d), F)
           : whole_->add_residual(nullptr, d, F);
}

template <int dim>
void MeshMotion<dim>::add_jacobian(const Evaluation<dim>& at, double,
                                   std::span<double> values) const {
  const NodalField<dim>& d = at.values.vector(d_);
  section_ ? across_->add_jacobian(nullptr, taken(*section_, d), values)
           : whole_->add_jacobian(nullptr, d, values);
}

template CellAssembly<2> auxiliary_cells(const Mesh<2>&, const MeshMotionLaw&, NodalNumbers<2>,
                                         NodalNumbers<2>, const NodalProjectors<2>*);
template CellAssembly<3> auxiliary_cells(const Mesh<3>&, const MeshMotionLaw&, NodalNumbers<3>,
                                         NodalNumbers<3>, const NodalProjectors<3>*);
template class MeshMotion<2>;
template class MeshMotion<3>;

}  // namespace gnomon
