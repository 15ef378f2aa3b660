#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/stepper.hpp>
#include <gnomon/model/wear_model.hpp>

namespace gnomon {

namespace {

/// Residuals are relative to the load, displacements to the body: where the one hardly strains the
/// other, at the least of its history, no load at all would pass for equilibrium.
template <int dim>
void require_strain(const WornBody<dim>& body) {
  constexpr double least = 1e-14;
  const double strain = body.load_history.least(body.scales.duration) * body.scales.stress /
                        body.material.moduli.young_modulus();
  if (!(strain >= least))
    throw InputError(fmt::format(
        "load.force, load.factors, body.young_modulus: expected a load that strains the "
        "body by {:g} or more, got about {:.2g}, which drowns in rounding",
        least, strain));
}

/// Stiffness along and across an element differ by the square of its lengths' ratio: rounding of
/// the one must not drown the other.
template <int dim>
void require_stout_elements(const Mesh<dim>& mesh) {
  constexpr double most = 1e4;
  for (std::size_t e = 0; e < mesh.cells.size(); ++e) {
    const auto x = mesh.positions(mesh.cells[e]);
    const auto size = (x.colwise().maxCoeff() - x.colwise().minCoeff()).eval();
    if (!(size.maxCoeff() <= most * size.minCoeff()))
      throw InputError(fmt::format(
          "the mesh: expected elements at most {:g} times as long as wide, got {:.2g} in element "
          "{}",
          most, size.maxCoeff() / size.minCoeff(), e));
  }
}

/// The largest norm of the displacement gradient at the centre of a cell.
template <int dim>
double displacement_gradient(const WornBody<dim>& body, const NodalField<dim>& nodal_u,
                             const NodalField<dim>& nodal_d) {
  double largest = 0;
  for (const auto& cell : body.mesh.cells) {
    CellNodal<dim> X = body.mesh.positions(cell), u;
    for (int a = 0; a < Mesh<dim>::cell_nodes; ++a) {
      X.row(a) += nodal_d.row(cell[a]);
      u.row(a) = nodal_u.row(cell[a]);
    }
    largest = std::max(largest, CellPoint<dim>(CellBasis<dim>::instance().centroid, X, u).H.norm());
  }
  return largest;
}

}  // namespace

template <int dim>
WearModel<dim>::WearModel(std::shared_ptr<const WornBody<dim>> body)
    : equations_(std::move(body)), system_(equations_.composition()) {
  require_strain(this->body());
  require_stout_elements(this->body().mesh);
}

template <int dim>
std::vector<BlockSize> WearModel<dim>::blocks() const {
  const Structure& structure = system_.structure();
  std::vector<BlockSize> blocks;
  for (const Block& block : structure.blocks)
    blocks.push_back({block.name, block.symbol, 0, block.where});
  for (int block : structure.block) ++blocks[block].size;
  return blocks;
}

template <int dim>
std::vector<Scalar> WearModel<dim>::observe(const State& state) const {
  const FieldValues<dim> values = system_.values(state.y);
  const NodalField<dim>&nodal_u = values.vector(equations_.fields().u),
        &nodal_d = values.vector(equations_.fields().d);
  const WornBody<dim>& body = this->body();
  const std::vector<ContactNode<dim>> nodes = equations_.contact_nodes(system_, values, state);
  double force = 0, flux = 0, pressure = 0;
  long active = 0;
  for (const ContactNode<dim>& node : nodes) {
    force -= body.copies * node.area * node.traction;
    flux += body.copies * node.area * node.wear_rate;
    pressure = std::max(pressure, -node.traction);
    active += node.active;
  }
  double worn = 0, quality = 1, least = 1;
  for (const auto& cell : body.mesh.cells) {
    const CellNodal<dim> initial = body.mesh.positions(cell);
    CellNodal<dim> X = initial;
    for (int a = 0; a < Mesh<dim>::cell_nodes; ++a) X.row(a) += nodal_d.row(cell[a]);
    const double before = cell_volume<dim>(initial), after = cell_volume<dim>(X);
    worn += before - after;
    least = std::min(least, after / before);
    quality = std::min(quality, scaled_jacobian<dim>(X));
  }
  worn *= body.copies;
  // Per unit thickness in 2D.
  const std::string force_unit = dim == 2 ? "N/mm" : "N";
  const std::string volume_unit = dim == 2 ? "mm^2" : "mm^3";
  std::vector<Scalar> scalars = {
      {"contact_nodes", "", double(active)},
      {"contact_force", force_unit, force},
      {"max_pressure", "MPa", pressure},
      {"worn_volume", volume_unit,
       body.section ? worn * body.section->path / body.section->length : worn},
      {"wear_flux", volume_unit + "/s", flux},
      {"element_quality", "", quality},
      {"element_volume", "", least}};
  if (body.section) scalars.push_back({"groove_section", "mm^2", worn / body.section->length});
  if (body.counter_force)
    scalars.push_back({"approach", "mm", values.scalar(equations_.fields().w)[0]});
  if (body.element.kinematics == Kinematics::small)
    scalars.push_back({"displacement_gradient", "", displacement_gradient(body, nodal_u, nodal_d)});
  if constexpr (dim == 2)
    scalars.push_back(
        {"contact_half_width", "mm", contact_half_width(body, equations_.fields(), values, nodes)});
  return scalars;
}

template <int dim>
std::optional<Grid> WearModel<dim>::grid() const {
  const Mesh<dim>& mesh = body().mesh;
  Grid grid;
  grid.cell = dim == 2 ? Grid::Cell::quadrilateral : Grid::Cell::hexahedron;
  for (const Vector<dim>& X : mesh.nodes) {
    std::array<double, 3> point{};
    std::copy(X.begin(), X.end(), point.begin());
    grid.points.push_back(point);
  }
  for (const auto& cell : mesh.cells) grid.cells.insert(grid.cells.end(), cell.begin(), cell.end());
  return grid;
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
std::vector<GridField> WearModel<dim>::fields(const State& state) const {
  const FieldValues<dim> values = system_.values(state.y);
  const NodalField<dim>&nodal_u = values.vector(equations_.fields().u),
        &nodal_d = values.vector(equations_.fields().d);
  const WornBody<dim>& body = this->body();
  const std::vector<ContactNode<dim>> nodes = equations_.contact_nodes(system_, values, state);
  GridField pressure{"pressure", "MPa", GridField::On::nodes, 1, {}};
  pressure.values.assign(body.mesh.nodes.size(), 0.0);
  for (int c = 0; c < static_cast<int>(body.contact_nodes.size()); ++c)
    pressure.values[body.contact_nodes[c].node] = std::max(0.0, -nodes[c].traction);
  GridField stress{"equivalent_stress", "MPa", GridField::On::cells, 1, {}};
  GridField quality{"element_quality", "", GridField::On::cells, 1, {}};
  CellNodal<dim> u;
  for (const auto& cell : body.mesh.cells) {
    CellNodal<dim> X = body.mesh.positions(cell);
    for (int a = 0; a < Mesh<dim>::cell_nodes; ++a) {
      X.row(a) += nodal_d.row(cell[a]);
      u.row(a) = nodal_u.row(cell[a]);
    }
    stress.values.push_back(equivalent_stress<dim>(body.element, body.material, X, u));
    quality.values.push_back(scaled_jacobian<dim>(X));
  }
  return {nodal_vector<dim>("displacement", nodal_u),
          nodal_vector<dim>("shape", nodal_d),
          nodal_vector<dim>("total_displacement", nodal_u + nodal_d),
          pressure,
          stress,
          quality};
}

template <int dim>
std::optional<ContactSurface> WearModel<dim>::contact(const State& state) const {
  const FieldValues<dim> values = system_.values(state.y);
  const NodalField<dim>&nodal_u = values.vector(equations_.fields().u),
        &nodal_d = values.vector(equations_.fields().d);
  const WornBody<dim>& body = this->body();
  const std::vector<ContactNode<dim>> nodes = equations_.contact_nodes(system_, values, state);
  ContactSurface surface;
  surface.dim = dim;
  const auto point = [](const Vector<dim>& v) {
    std::array<double, 3> p{};
    std::copy(v.begin(), v.end(), p.begin());
    return p;
  };
  for (int c = 0; c < static_cast<int>(body.contact_nodes.size()); ++c) {
    const int node = body.contact_nodes[c].node;
    const ContactNode<dim>& contact = nodes[c];
    const Vector<dim> d = nodal_d.row(node).transpose();
    const Vector<dim> u = nodal_u.row(node).transpose();
    surface.node.push_back(node);
    surface.initial.push_back(point(body.mesh.nodes[node]));
    surface.worn.push_back(point(body.mesh.nodes[node] + d));
    surface.current.push_back(point(body.mesh.nodes[node] + d + u));
    surface.pressure.push_back(std::max(0.0, -contact.traction));
    surface.wear_depth.push_back(d.norm());
    surface.active.push_back(contact.active);
  }
  return surface;
}

template class WearModel<2>;
template class WearModel<3>;

}  // namespace gnomon
