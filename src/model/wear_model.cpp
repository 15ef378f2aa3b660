#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/base/processes.hpp>
#include <gnomon/integrators/stepper.hpp>
#include <gnomon/model/wear_model.hpp>
#include <gnomon/terms/meridian_point.hpp>

namespace gnomon {

namespace {

/// Residuals are relative to the load, displacements to the body: if the smallest load of the
/// history hardly strains the body, even a state without load would be accepted as an equilibrium.
template <int dim>
void require_strain(const WornBody<dim>& body) {
  constexpr double least = 1e-14;
  const double strain = body.load_history.least(body.scales.duration) * body.scales.stress /
                        body.material.moduli.young_modulus();
  if (!(strain >= least))
    throw InputError(fmt::format(
        "load.force, load.factors, body.young_modulus: expected a load that strains the "
        "body by {:g} or more, got about {:.2g}, which is less than rounding errors",
        least, strain));
}

/// Stiffnesses along and across an element differ by the square of its aspect ratio: rounding
/// errors of the larger must not exceed the smaller.
template <int dim>
void require_compact_elements(const Mesh<dim>& mesh) {
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

/// Its element and its contact nodes are sections of the same kind of body.
template <int dim>
void require_one_section(const WornBody<dim>& body) {
  for (const ContactPatch<dim>& patch : body.contact_nodes)
    for (const auto& corner : patch.corners)
      if (dim == 2 && corner.section != body.element.section)
        throw Error("a worn body: its contact nodes and its element are of different sections");
}

/// X = X^ + d, one row per node.
template <int dim>
CellNodal<dim> worn_positions(CellNodal<dim> initial, const typename Mesh<dim>::Cell& cell,
                              const NodalField<dim>& d) {
  for (int a = 0; a < Mesh<dim>::cell_nodes; ++a) initial.row(a) += d.row(cell[a]);
  return initial;
}

/// A cell with its nodal values, one row per node.
template <int dim>
struct CellState {
  CellNodal<dim> initial, X, u;  // X^, X = X^ + d, u

  CellState(const Mesh<dim>& mesh, const typename Mesh<dim>::Cell& cell,
            const NodalField<dim>& nodal_d, const NodalField<dim>& nodal_u)
      : initial(mesh.positions(cell)), X(worn_positions<dim>(initial, cell, nodal_d)) {
    for (int a = 0; a < Mesh<dim>::cell_nodes; ++a) u.row(a) = nodal_u.row(cell[a]);
  }
};

/// Its norm at the centroid, in a body of revolution its largest norm at a Gauss point.
template <int dim>
double displacement_gradient(const CellState<dim>& at, [[maybe_unused]] Section section) {
  if constexpr (dim == 2)
    if (section == Section::meridian) {
      const MeridianCell<> cell(at.X, at.u);
      double largest = 0;
      for (const MeridianPoint<>& point : cell.points())
        largest = std::max(largest, point.H.norm());
      return largest;
    }
  return CellPoint<dim>(CellBasis<dim>::instance().centroid, at.X, at.u).H.norm();
}

/// The part of an observation that is a sum over contact nodes: nodes in contact in any phase, the
/// mean force, the largest pressure.
template <int dim>
void observe_contact(const std::vector<PhaseContact<dim>>& phases, double copies,
                     Observation& observed) {
  double force = 0, pressure = 0;
  std::vector<char> active(phases.front().nodes.size(), 0);
  for (const auto& [weight, nodes] : phases)
    for (std::size_t c = 0; c < nodes.size(); ++c) {
      force -= weight * copies * nodes[c].area * nodes[c].traction;
      pressure = std::max(pressure, -nodes[c].traction);
      if (nodes[c].active) active[c] = 1;
    }
  observed.contact_nodes = sum_over_processes(double(std::ranges::count(active, 1)));
  observed.contact_force = sum_over_processes(force);
  observed.max_pressure = largest_over_processes(pressure);
}

/// Volume per time, mean over the cycle [length^dim / time].
template <int dim>
double wear_flux_of(const std::vector<PhaseContact<dim>>& phases, double copies) {
  double flux = 0;
  for (const auto& [weight, nodes] : phases)
    for (const ContactNode<dim>& node : nodes) flux += weight * copies * node.area * node.wear_rate;
  return sum_over_processes(flux);
}

/// The part of an observation that needs a sweep over the cells, but no displacements.
template <int dim>
void observe_cells(const WornBody<dim>& body, const NodalField<dim>& d, Observation& observed) {
  double worn = 0, quality = 1, least = 1;
  for (const auto& cell : body.mesh.cells) {
    const CellNodal<dim> initial = body.mesh.positions(cell),
                         X = worn_positions<dim>(initial, cell, d);
    const double before = cell_volume<dim>(initial, body.element.section),
                 after = cell_volume<dim>(X, body.element.section);
    worn += before - after;
    least = std::min(least, after / before);
    quality = std::min(quality, scaled_jacobian<dim>(X));
  }
  worn = sum_over_processes(worn) * body.copies;
  observed.worn_volume = worn;
  observed.element_quality = -largest_over_processes(-quality);
  observed.element_volume = -largest_over_processes(-least);
  if (!body.section) return;
  observed.worn_volume = worn * body.section->path / body.section->length;
  observed.groove_section = worn / body.section->length;
}

/// The largest displacement gradient of this and the phases observed before, with small strains.
template <int dim>
void observe_strains(const WornBody<dim>& body, const NodalField<dim>& d, const NodalField<dim>& u,
                     Observation& observed) {
  if (body.element.kinematics != Kinematics::small) return;
  double gradient = observed.displacement_gradient.value_or(0);
  for (const auto& cell : body.mesh.cells)
    gradient = std::max(gradient, displacement_gradient<dim>(CellState<dim>(body.mesh, cell, d, u),
                                                             body.element.section));
  observed.displacement_gradient = largest_over_processes(gradient);
}

/// The box in which the counter-body is shown; that of a body of revolution ends at the axis.
template <int dim>
Box<dim> surroundings(const WornBody<dim>& body) {
  Box<dim> box = Box<dim>::around(body.mesh.nodes).widened(0.25);
  if (body.element.section == Section::meridian) box.low[0] = std::max(box.low[0], 0.0);
  return box;
}

/// In 2D, z is zero.
template <int dim>
std::array<double, 3> in_space(const Vector<dim>& v) {
  std::array<double, 3> point{};
  std::copy(v.begin(), v.end(), point.begin());
  return point;
}

}  // namespace

template <int dim>
WearModel<dim>::WearModel(std::shared_ptr<const WornBody<dim>> body)
    : surroundings_(surroundings(*body)),
      equations_(std::move(body)),
      system_(equations_.composition()) {
  require_one_section(this->body());
  require_strain(this->body());
  require_compact_elements(this->body().mesh);
}

template <int dim>
std::vector<BlockSize> WearModel<dim>::blocks() const {
  const Structure& structure = system_.structure();
  std::vector<BlockSize> blocks;
  std::vector<std::size_t> listed;  // of each block: where it is counted
  for (const Block& block : structure.blocks) {
    const auto same = std::ranges::find(blocks, block.name, &BlockSize::name);
    listed.push_back(static_cast<std::size_t>(same - blocks.begin()));
    if (same == blocks.end()) blocks.push_back({block.name, block.symbol, 0, block.where});
  }
  for (int block : structure.block) ++blocks[listed[static_cast<std::size_t>(block)]].size;
  return blocks;
}

template <int dim>
std::vector<PhaseContact<dim>> WearModel<dim>::contacts(const FieldValues<dim>& values,
                                                        const Point& at) const {
  std::vector<PhaseContact<dim>> result;
  for (std::size_t p = 0; p < equations_.phases().size(); ++p)
    result.push_back(
        {equations_.phases()[p].weight, equations_.contact_nodes(system_, values, at, p)});
  return result;
}

template <int dim>
std::vector<PhaseContact<dim>> WearModel<dim>::contacts(const FieldValues<dim>& values,
                                                        const State& state) const {
  return contacts(values, {.t = state.t, .y = state.y, .branch = state.own_branch()});
}

template <int dim>
Observation WearModel<dim>::observe(const State& state) const {
  const FieldValues<dim> values = system_.values(state.t, state.y);
  const std::vector<PhaseContact<dim>> phases = contacts(values, state);
  Observation observed{.dim = body().element.section == Section::meridian ? 3 : dim};
  observe_contact(phases, body().copies, observed);
  observed.wear_flux = wear_flux_of(phases, body().copies);
  observe_cells(body(), values.vector(equations_.fields().d), observed);
  for (std::size_t p = 0; p < phases.size(); ++p) {
    const WornBodyFields& fields = equations_.fields(p);
    observe_strains(body(), values.vector(fields.d), values.vector(fields.u), observed);
    if (equations_.phases()[p].force)
      observed.approach =
          observed.approach.value_or(0) + phases[p].weight * values.scalar(fields.w)[0];
    if constexpr (dim == 2)
      observed.contact_half_width =
          std::max(observed.contact_half_width.value_or(0),
                   contact_half_width(body(), fields, values, phases[p].nodes));
  }
  return observed;
}

template <int dim>
std::function<double(const Point&)> WearModel<dim>::wear_flux() const {
  return [this](const Point& at) {
    return wear_flux_of(contacts(system_.values(at.t, at.y), at), body().copies);
  };
}

template <int dim>
std::optional<Grid> WearModel<dim>::grid() const {
  const Mesh<dim>& mesh = body().mesh;
  Grid grid;
  grid.cell = dim == 2 ? Grid::Cell::quadrilateral : Grid::Cell::hexahedron;
  for (const Vector<dim>& X : mesh.nodes) grid.points.push_back(in_space<dim>(X));
  for (const auto& cell : mesh.cells) grid.cells.insert(grid.cells.end(), cell.begin(), cell.end());
  grid.parts = body().parts;
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
  const FieldValues<dim> values = system_.values(state.t, state.y);
  const NodalField<dim>&nodal_u = values.vector(equations_.fields().u),
        &nodal_d = values.vector(equations_.fields().d);
  const WornBody<dim>& body = this->body();
  GridField pressure{"pressure", "MPa", GridField::On::nodes, 1, {}};
  pressure.values.assign(body.mesh.nodes.size(), 0.0);
  for (const auto& [weight, nodes] : contacts(values, state))
    for (std::size_t c = 0; c < nodes.size(); ++c)
      pressure.values[body.contact_nodes[c].node] += weight * std::max(0.0, -nodes[c].traction);
  GridField stress{"equivalent_stress", "MPa", GridField::On::cells, 1, {}};
  GridField quality{"element_quality", "", GridField::On::cells, 1, {}};
  for (const auto& cell : body.mesh.cells) {
    const CellState<dim> at(body.mesh, cell, nodal_d, nodal_u);
    stress.values.push_back(equivalent_stress<dim>(body.element, body.material, at.X, at.u));
    quality.values.push_back(scaled_jacobian<dim>(at.X));
  }
  return {nodal_vector<dim>("displacement", nodal_u), nodal_vector<dim>("shape", nodal_d), pressure,
          stress, quality};
}

template <int dim>
std::optional<ContactSurface> WearModel<dim>::contact(const State& state) const {
  const FieldValues<dim> values = system_.values(state.t, state.y);
  const NodalField<dim>&nodal_u = values.vector(equations_.fields().u),
        &nodal_d = values.vector(equations_.fields().d);
  const WornBody<dim>& body = this->body();
  const std::vector<PhaseContact<dim>> phases = contacts(values, state);
  ContactSurface surface;
  surface.dim = dim;
  for (std::size_t c = 0; c < body.contact_nodes.size(); ++c) {
    const int node = body.contact_nodes[c].node;
    double pressure = 0;
    int active = 0;
    for (const auto& [weight, nodes] : phases) {
      pressure += weight * std::max(0.0, -nodes[c].traction);
      active = std::max<int>(active, nodes[c].active);
    }
    const Vector<dim> d = nodal_d.row(node).transpose();
    const Vector<dim> u = nodal_u.row(node).transpose();
    surface.node.push_back(node);
    surface.initial.push_back(in_space<dim>(body.mesh.nodes[node]));
    surface.worn.push_back(in_space<dim>(body.mesh.nodes[node] + d));
    surface.current.push_back(in_space<dim>(body.mesh.nodes[node] + d + u));
    surface.pressure.push_back(pressure);
    surface.wear_depth.push_back(d.norm());
    surface.active.push_back(active);
  }
  if (phases.size() > 1)
    for (std::size_t p = 0; p < phases.size(); ++p) {
      surface.phase_position.push_back(equations_.phases()[p].position);
      surface.phase_weight.push_back(phases[p].weight);
      for (const ContactNode<dim>& contact : phases[p].nodes)
        surface.phase_pressure.push_back(std::max(0.0, -contact.traction));
    }
  return surface;
}

template <int dim>
std::optional<CounterSurface> WearModel<dim>::counter_surface(const State& state) const {
  constexpr int cells_along = dim == 2 ? 128 : 32;
  const CounterBody<dim>& other = equations_.phases().front().counter_body;
  double w = other.travel ? other.travel->factor(state.t) : 0;
  if (equations_.phases().front().force)
    w += system_.values(state.t, state.y).scalar(equations_.fields().w)[0];
  const FacetedSurface<dim> within = zero_level<dim>(
      [&](const Vector<dim>& x) { return other.unchecked_distance(other.seen(x, w), state.t); },
      surroundings_, cells_along);
  CounterSurface surface;
  surface.dim = dim;
  for (const Vector<dim>& x : within.points) surface.points.push_back(in_space<dim>(x));
  for (const auto& facet : within.facets)
    surface.facets.insert(surface.facets.end(), facet.begin(), facet.end());
  return surface;
}

template class WearModel<2>;
template class WearModel<3>;

}  // namespace gnomon
