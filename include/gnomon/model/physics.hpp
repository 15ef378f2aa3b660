// A physics on a mesh declares its unknowns and equations, a Composition of fields and terms, and
// says what is observed of a state. The rest of a model follows from the composition and the mesh.
#pragma once

#include <algorithm>
#include <array>
#include <gnomon/mesh/contact_patch.hpp>
#include <gnomon/mesh/mesh.hpp>
#include <gnomon/model/model.hpp>
#include <gnomon/system/composed_system.hpp>
#include <gnomon/terms/material.hpp>
#include <memory>
#include <numeric>
#include <span>
#include <vector>

namespace gnomon {

/// What remains to a physics: observe(), fields(), contact(), differential_scale, and its
/// abilities.
template <int dim>
class Physics : public Model {
public:
  const ComposedSystem<dim>& system() const final { return system_; }
  /// From zero, by the algebraic stages.
  State start(Counters& counters) const override;

protected:
  /// With blocks and grid; blocks of one name are listed as one.
  Physics(std::shared_ptr<const Composition<dim>> composition, const Mesh<dim>& mesh);

private:
  ComposedSystem<dim> system_;
};

/// A vector at each node of a mesh, of one block where it is not held.
template <int dim>
Field field_at_nodes(const std::string& name, const NodalFlags<dim>& held, int block,
                     double row_scale, double unknown_scale) {
  std::vector<int> nodes(static_cast<std::size_t>(held.rows()));
  std::iota(nodes.begin(), nodes.end(), 0);
  Field field(name, std::move(nodes), dim);
  for (Eigen::Index k = 0; k < field.block.size(); ++k)
    field.block.data()[k] = held.data()[k] ? -1 : block;
  field.row_scale.setConstant(row_scale);
  field.unknown_scale.setConstant(unknown_scale);
  return field;
}

/// In 2D, z is zero.
template <int dim>
std::array<double, 3> point_in_space(const Vector<dim>& v) {
  std::array<double, 3> point{};
  std::copy(v.begin(), v.end(), point.begin());
  return point;
}
template <int dim>
std::vector<std::array<double, 3>> points_in_space(const std::vector<Vector<dim>>& points) {
  std::vector<std::array<double, 3>> result;
  for (const Vector<dim>& X : points) result.push_back(point_in_space<dim>(X));
  return result;
}

/// Its nodes and cells.
template <int dim>
Grid grid_of(const Mesh<dim>& mesh) {
  Grid grid;
  grid.cell = dim == 2 ? Grid::Cell::quadrilateral : Grid::Cell::hexahedron;
  grid.points = points_in_space<dim>(mesh.nodes);
  for (const auto& cell : mesh.cells) grid.cells.insert(grid.cells.end(), cell.begin(), cell.end());
  return grid;
}

/// A cell with its nodal values, one row per node.
template <int dim>
struct CellState {
  CellNodal<dim> initial, X, u;  ///< X^, X = X^ + d, u

  CellState(const Mesh<dim>& mesh, const typename Mesh<dim>::Cell& cell, const NodalField<dim>& d,
            const NodalField<dim>& displacement)
      : initial(mesh.positions(cell)), X(initial) {
    for (int a = 0; a < Mesh<dim>::cell_nodes; ++a) {
      X.row(a) += d.row(cell[a]);
      u.row(a) = displacement.row(cell[a]);
    }
  }
};

/// In 2D, z is zero.
template <int dim>
GridField nodal_vector(const std::string& name, const NodalField<dim>& values) {
  GridField field{name, "mm", GridField::On::nodes, 3, {}};
  field.values.assign(3 * values.rows(), 0.0);
  for (Eigen::Index node = 0; node < values.rows(); ++node)
    for (int i = 0; i < dim; ++i) field.values[3 * node + i] = values(node, i);
  return field;
}

/// The fields displacement, shape, equivalent_stress and element_quality of elastic bodies.
/// `body_of`: by cell, the position of its body; empty where there is one.
template <int dim>
std::vector<GridField> solid_fields(const Mesh<dim>& mesh, const std::vector<Body>& bodies,
                                    const std::vector<int>& body_of, const NodalField<dim>& d,
                                    const NodalField<dim>& u) {
  GridField stress{"equivalent_stress", "MPa", GridField::On::cells, 1, {}};
  GridField quality{"element_quality", "", GridField::On::cells, 1, {}};
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const CellState<dim> at(mesh, mesh.cells[c], d, u);
    const Body& of = bodies[body_of.empty() ? 0 : body_of[c]];
    stress.values.push_back(equivalent_stress<dim>(of.element, of.material, at.X, at.u));
    quality.values.push_back(scaled_jacobian<dim>(at.X));
  }
  return {nodal_vector<dim>("displacement", u), nodal_vector<dim>("shape", d), stress, quality};
}

/// The nodes of these patches, moved by d and u, and how far d moved them; without contact.
template <int dim>
ContactSurface surface_of(const Mesh<dim>& mesh, std::span<const ContactPatch<dim>> patches,
                          const NodalField<dim>& d, const NodalField<dim>& u) {
  ContactSurface surface;
  surface.dim = dim;
  surface.pressure.assign(patches.size(), 0);
  surface.active.assign(patches.size(), 0);
  for (const ContactPatch<dim>& patch : patches) {
    const Vector<dim> X = mesh.nodes[patch.node], moved = d.row(patch.node).transpose(),
                      displacement = u.row(patch.node).transpose();
    surface.node.push_back(patch.node);
    surface.initial.push_back(point_in_space<dim>(X));
    surface.worn.push_back(point_in_space<dim>(X + moved));
    surface.current.push_back(point_in_space<dim>(X + moved + displacement));
    surface.wear_depth.push_back(moved.norm());
  }
  return surface;
}

}  // namespace gnomon
