#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/rates.hpp>
#include <gnomon/model/physics.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <numeric>

namespace gnomon {

namespace {

std::vector<BlockSize> sizes_of(const Structure& structure) {
  std::vector<BlockSize> sizes;
  for (const Block& block : structure.blocks)
    if (std::ranges::find(sizes, block.name, &BlockSize::name) == sizes.end())
      sizes.push_back({block.name, block.symbol, 0, block.where});
  for (const int block : structure.block)
    ++std::ranges::find(sizes, structure.blocks[block].name, &BlockSize::name)->size;
  return sizes;
}

template <int dim>
Grid grid_of(const Mesh<dim>& mesh) {
  Grid grid;
  grid.cell = dim == 2 ? Grid::Cell::quadrilateral : Grid::Cell::hexahedron;
  grid.points = points_in_space<dim>(mesh.nodes);
  for (const auto& cell : mesh.cells) grid.cells.insert(grid.cells.end(), cell.begin(), cell.end());
  return grid;
}

}  // namespace

template <int dim>
Physics<dim>::Physics(std::shared_ptr<const Composition<dim>> composition, const Mesh<dim>& mesh)
    : system_(std::move(composition)) {
  blocks = sizes_of(system_.structure());
  grid = grid_of(mesh);
}

template <int dim>
State Physics<dim>::start(Counters& counters) const {
  State state{0, std::vector<double>(system_.structure().size, 0.0), {}};
  const std::string reason = AlgebraicSolver(system_, counters).solve(0, state.y);
  if (!reason.empty()) throw SolutionError("no equilibrium at t = 0: " + reason);
  set_rates(system_, nullptr, state);
  return state;
}

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

namespace {

template <int dim>
GridField nodal_vector(const std::string& name, const NodalField<dim>& values) {
  GridField field{name, "mm", GridField::On::nodes, 3, {}};
  field.values.assign(3 * values.rows(), 0.0);
  for (Eigen::Index node = 0; node < values.rows(); ++node)
    for (int i = 0; i < dim; ++i) field.values[3 * node + i] = values(node, i);
  return field;
}

}  // namespace

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

template class Physics<2>;
template class Physics<3>;
template Field field_at_nodes(const std::string&, const NodalFlags<2>&, int, double, double);
template Field field_at_nodes(const std::string&, const NodalFlags<3>&, int, double, double);
template std::array<double, 3> point_in_space(const Vector<2>&);
template std::array<double, 3> point_in_space(const Vector<3>&);
template std::vector<std::array<double, 3>> points_in_space(const std::vector<Vector<2>>&);
template std::vector<std::array<double, 3>> points_in_space(const std::vector<Vector<3>>&);
template std::vector<GridField> solid_fields(const Mesh<2>&, const std::vector<Body>&,
                                             const std::vector<int>&, const NodalField<2>&,
                                             const NodalField<2>&);
template std::vector<GridField> solid_fields(const Mesh<3>&, const std::vector<Body>&,
                                             const std::vector<int>&, const NodalField<3>&,
                                             const NodalField<3>&);
template ContactSurface surface_of(const Mesh<2>&, std::span<const ContactPatch<2>>,
                                   const NodalField<2>&, const NodalField<2>&);
template ContactSurface surface_of(const Mesh<3>&, std::span<const ContactPatch<3>>,
                                   const NodalField<3>&, const NodalField<3>&);

}  // namespace gnomon
