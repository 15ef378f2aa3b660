#include <cmath>
#include <gnomon/terms/mesh_motion.hpp>

namespace gnomon {

namespace {

/// Factors of the law that let small cells move as if rigid, one a cell; 1 on the mean volume.
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

/// What does not depend on the dimension of the body.
template <int dim, class Body, class Numbers>
CellAssembly<dim> auxiliary_cells(const Mesh<dim>& mesh, const Body& body, const Numbers& rows,
                                  const Numbers& columns) {
  return {mesh,
          body.auxiliary_material,
          {ElementTechnology::plain, Kinematics::finite},
          rows,
          columns,
          nullptr,
          stiffness_by_volume(mesh, body.auxiliary_stiffening)};
}

}  // namespace

/// The cross-section with its unknowns, those of the carrying nodes of the body: components (y, z).
template <int dim>
struct MeshMotion<dim>::Section {
  using Numbers = Unknowns<2>::Numbers;

  const CrossSection& section;
  Numbers rows, columns;
  CellAssembly<2> cells;
  mutable NodalField<2> shape;

  Section(const WornBody<dim>& body, const Unknowns<dim>& unknowns)
      : section(*body.section),
        rows(taken(unknowns.auxiliary_row())),
        columns(taken(unknowns.d())),
        cells(auxiliary_cells(section.mesh, body, rows, columns)) {}

  template <class Nodal>
  auto taken(const Nodal& nodal) const {
    Eigen::Matrix<typename Nodal::Scalar, Eigen::Dynamic, 2, Eigen::RowMajor> result(
        section.node.size(), 2);
    for (std::size_t s = 0; s < section.node.size(); ++s)
      result.row(s) = nodal.row(section.node[s]).template tail<2>();
    return result;
  }
  const NodalField<2>& at(const NodalField<dim>& d) const { return shape = taken(d); }
};

template <int dim>
MeshMotion<dim>::MeshMotion(const WornBody<dim>& body, const Unknowns<dim>& unknowns) {
  if (body.section)
    section_ = std::make_unique<Section>(body, unknowns);
  else
    cells_ = std::make_unique<CellAssembly<dim>>(
        auxiliary_cells(body.mesh, body, unknowns.auxiliary_row(), unknowns.d()));
}

template <int dim>
MeshMotion<dim>::~MeshMotion() = default;

template <int dim>
void MeshMotion<dim>::add_to_pattern(PatternBuilder& builder) const {
  section_ ? section_->cells.add_to_pattern(builder) : cells_->add_to_pattern(builder);
}

template <int dim>
void MeshMotion<dim>::map_to(const SparsePattern& pattern) {
  section_ ? section_->cells.map_to(pattern) : cells_->map_to(pattern);
}

template <int dim>
void MeshMotion<dim>::add_residual(const NodalField<dim>& d, std::span<double> F) const {
  section_ ? section_->cells.add_residual(nullptr, section_->at(d), F)
           : cells_->add_residual(nullptr, d, F);
}

template <int dim>
void MeshMotion<dim>::add_jacobian(const NodalField<dim>& d, std::span<double> values) const {
  section_ ? section_->cells.add_jacobian(nullptr, section_->at(d), values)
           : cells_->add_jacobian(nullptr, d, values);
}

template class MeshMotion<2>;
template class MeshMotion<3>;

}  // namespace gnomon
