#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/processes.hpp>
#include <gnomon/integrators/stepper.hpp>
#include <gnomon/model/wear_model.hpp>
#include <gnomon/terms/meridian_point.hpp>

#include "model/connected_parts.hpp"
#include "model/observed_path.hpp"
#include "model/observed_rolling.hpp"
#include "model/resultants.hpp"
#include "model/thickness.hpp"
#include "model/tracks.hpp"

namespace gnomon {

namespace {

/// X = X^ + d, one row per node.
template <int dim>
CellNodal<dim> worn_positions(CellNodal<dim> initial, const typename Mesh<dim>::Cell& cell,
                              const NodalField<dim>& d) {
  for (int a = 0; a < Mesh<dim>::cell_nodes; ++a) initial.row(a) += d.row(cell[a]);
  return initial;
}

/// The norm of the displacement gradient at the centroid, in a body of revolution its largest norm
/// at a Gauss point.
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
void observe_contact(const std::vector<PhaseContact<dim>>& phases, const Assembly<dim>& body,
                     int units, Observation& observed) {
  double force = 0, pressure = 0;
  std::vector<char> active(phases.front().nodes.size(), 0);
  for (const auto& [weight, nodes] : phases)
    for (std::size_t c = 0; c < nodes.size(); ++c) {
      if (!body.carries[c]) continue;
      force -= weight * body.copies * nodes[c].area * nodes[c].traction;
      pressure = std::max(pressure, -nodes[c].traction);
      if (nodes[c].active) active[c] = 1;
    }
  const double touching = sum_over_processes(double(std::ranges::count(active, 1)));
  observed.push_back(common("contact_nodes", touching));
  observed.push_back(common("contact_force", sum_over_processes(force), units));
  observed.push_back(common("max_pressure", largest_over_processes(pressure)));
}

/// What the guides of the counter-body, and whatever else holds it, exert on it: the reaction to
/// contact and to the forces that press it [force].
template <int dim>
Vector<dim> reaction_of(const Assembly<dim>& body, const Phase<dim>& phase,
                        const std::vector<ContactNode<dim>>& nodes, double t) {
  Vector<dim> reaction = Vector<dim>::Zero();
  for (const ContactNode<dim>& node : nodes) reaction -= node.force;
  const std::vector<std::optional<double>> forces = phase.forces();
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const Guide<dim>& guide = phase.counter_body.guides[k];
    const LoadHistory& history = k == 0 ? body.interface.history : guide.factors;
    if (forces[k]) reaction -= *forces[k] * history.factor(t) * guide.along;
  }
  return reaction;
}

template <int dim>
void observe_reaction(Section section, const Vector<dim>& reaction, Observation& observed) {
  const bool revolved = dim == 2 && section == Section::meridian;
  for (int i = revolved ? 1 : 0; i < dim; ++i)
    observed.push_back({fmt::format("guide_{}", revolved ? 'z' : "xyz"[i]),
                        find_scalar(observed, "contact_force")->unit,
                        sum_over_processes(reaction[i])});
}

/// The free motion of a counter-body, a part of the mean over a cycle: along the direction of its
/// largest force, and along or about others by the number of their table.
template <int dim>
void add_motion(const Phase<dim>& phase, double weight, const Eigen::VectorXd& w,
                std::optional<double>& approach, Observation& others) {
  const std::vector<std::optional<double>> forces = phase.forces();
  for (std::size_t k = 0; k < forces.size(); ++k) {
    if (!forces[k]) continue;
    const double part = weight * w[static_cast<Eigen::Index>(k)];
    const Guide<dim>& guide = phase.counter_body.guides[k];
    if (guide.creeps()) continue;
    if (k == 0) {
      approach = approach.value_or(0) + part;
      continue;
    }
    const std::string name =
        (guide.turns() ? "turn_" : "approach_") + guide.key.substr(guide.key.rfind('.') + 1);
    const auto there = std::ranges::find(others, name, &Scalar::name);
    if (there == others.end())
      others.push_back({name, guide.turns() ? "rad" : "mm", part});
    else
      there->value += part;
  }
}

/// Volume per time, mean over the cycle [length^dim / time].
template <int dim>
double wear_flux_of(const std::vector<PhaseContact<dim>>& phases, double copies) {
  double flux = 0;
  for (const auto& [weight, nodes] : phases)
    for (const ContactNode<dim>& node : nodes) flux += weight * copies * node.area * node.wear_rate;
  return sum_over_processes(flux);
}

/// The part of an observation that needs a sweep over the cells, but no displacements. Returns what
/// each body has lost of the mesh [length^dim].
template <int dim>
std::vector<double> observe_cells(const Assembly<dim>& body, const NodalField<dim>& d,
                                  double wear_flux, int units, Observation& observed) {
  double quality = 1, least = 1, whole = 0;
  std::vector<double> worn = worn_beyond_mesh(body, d);
  for (std::size_t c = 0; c < body.mesh.cells.size(); ++c) {
    const auto& cell = body.mesh.cells[c];
    const CellNodal<dim> initial = body.mesh.positions(cell),
                         X = worn_positions<dim>(initial, cell, d);
    const double before = cell_volume<dim>(initial, body.section()),
                 after = cell_volume<dim>(X, body.section());
    worn[static_cast<std::size_t>(body.body_of[c])] += before - after;
    if (!body.shape.gap) least = std::min(least, after / before);
    quality = std::min(quality, scaled_jacobian<dim>(body.shape.gap ? initial : X));
  }
  for (double& volume : worn) {
    volume = sum_over_processes(volume) * body.copies;
    whole += volume;
  }
  const auto& groove = body.cross_section;
  const double volume = groove ? whole * groove->path / groove->length : whole;
  observed.push_back(common("worn_volume", volume, units));
  observed.push_back(common("wear_flux", wear_flux, units));
  observed.push_back(common("element_quality", -largest_over_processes(-quality)));
  observed.push_back(common("element_volume", -largest_over_processes(-least)));
  if (groove) observed.push_back(common("groove_section", whole / groove->length));
  return worn;
}

/// What each body of pairs has lost, and loses, with the whole of its tracks: "worn_volume_pin",
/// "wear_flux_pin".
template <int dim>
void observe_bodies(const Assembly<dim>& body, const std::vector<double>& worn,
                    const std::vector<PhaseContact<dim>>& phases, int units,
                    Observation& observed) {
  std::vector<double> flux(worn.size(), 0);
  const std::vector<int> owner = body_of_nodes(body.mesh, body.body_of);
  for (const auto& [weight, nodes] : phases)
    for (std::size_t c = 0; c < nodes.size(); ++c)
      flux[owner[body.contact_nodes[c].node]] +=
          weight * body.copies * nodes[c].area * nodes[c].wear_rate;
  const std::string volume = common("worn_volume", 0, units).unit,
                    rate = common("wear_flux", 0, units).unit;
  for (std::size_t b = 0; b < worn.size(); ++b) {
    observed.push_back({"worn_volume_" + body.bodies[b].name, volume, worn[b]});
    observed.push_back({"wear_flux_" + body.bodies[b].name, rate, sum_over_processes(flux[b])});
  }
}

/// The largest displacement gradient of this and the phases before, of bodies with small strains.
template <int dim>
void widen(std::optional<double>& largest, const Assembly<dim>& body, const NodalField<dim>& d,
           const NodalField<dim>& u) {
  std::vector<char> small;
  for (const Body& each : body.bodies)
    small.push_back(each.element.kinematics == Kinematics::small);
  if (std::ranges::count(small, 1) == 0) return;
  double gradient = largest.value_or(0);
  for (std::size_t c = 0; c < body.mesh.cells.size(); ++c)
    if (small[body.body_of[c]])
      gradient = std::max(
          gradient, displacement_gradient<dim>(CellState<dim>(body.mesh, body.mesh.cells[c], d, u),
                                               body.section()));
  largest = largest_over_processes(gradient);
}

/// The box in which the counter-body is shown; that of a body of revolution ends at the axis.
template <int dim>
Box<dim> surroundings(const Assembly<dim>& body) {
  Box<dim> box = Box<dim>::around(body.mesh.nodes).widened(0.25);
  if (body.section() == Section::meridian) box.low[0] = std::max(box.low[0], 0.0);
  return box;
}

}  // namespace

template <int dim>
WearModel<dim>::WearModel(std::shared_ptr<const Assembly<dim>> assembly)
    : WearModel(WornBodyEquations<dim>(std::move(assembly))) {}

template <int dim>
WearModel<dim>::WearModel(WornBodyEquations<dim> equations)
    : Physics<dim>(equations.composition(), equations.assembly().mesh),
      surroundings_(surroundings(equations.assembly())),
      equations_(std::move(equations)),
      resultants_(std::make_shared<const Resultants<dim>>(WornBodyEquations<dim>(
          equations_.shared_assembly(), equations_.phases(), Elasticity::whole))) {
  if (assembly().shape.gap) thickness_ = thickness_behind(assembly());
  ModelFacts& facts = *this;
  facts.differential_scale = assembly().scales.wear_depth;
  facts.grid->parts = assembly().named_parts;
  facts.remarks = assembly().remarks;
  facts.proposals = assembly().proposals;
  facts.memory = assembly().memory;
  facts.phases = static_cast<long>(equations_.phases().size());
  Abilities& can = *this;
  // One pass over the contact nodes and none over the cells.
  can.wear_flux = [this](const Point& at) {
    return wear_flux_of(contacts(system().values(at.t, at.y), at), assembly().copies);
  };
  if (assembly().cycle) can.phase_error = [this](const State& state) { return phase_error(state); };
  if (assembly().interface.reach > 0) {
    others_.emplace(assembly());
    can.succeed = [this](const State& state) { return succeed(state); };
    can.overdue = [this](const State& state) { return overdue(state); };
  }
  if (!assembly().pairs.empty()) {
    can.succeed = [this](const State& state) { return succeed_pairs(state); };
    can.overdue = [this](const State& state) { return have_moved(positions(state), 1); };
  }
  can.examine = [this](const State& state) { return examine(state); };
  if (assembly().pairs.empty())
    can.counter_surface = [this](const State& state) { return counter_surface(state); };
}

template <int dim>
FieldValues<dim> WearModel<dim>::values(const State& state) const {
  FieldValues<dim> values = system().values(state.t, state.y);
  equations_.complete(values, state.t);
  return values;
}

template <int dim>
std::vector<PhaseContact<dim>> WearModel<dim>::contacts(const FieldValues<dim>& values,
                                                        const Point& at) const {
  std::vector<PhaseContact<dim>> result;
  for (std::size_t p = 0; p < equations_.phases().size(); ++p)
    result.push_back(
        {equations_.phases()[p].weight, equations_.contact_nodes(system(), values, at, p)});
  return result;
}

template <int dim>
std::vector<PhaseContact<dim>> WearModel<dim>::contacts(const FieldValues<dim>& values,
                                                        const State& state) const {
  return contacts(values, {.t = state.t, .y = state.y, .branch = state.own_branch()});
}

template <int dim>
double WearModel<dim>::wear_depth(std::size_t contact_node, const NodalField<dim>& d) const {
  const ContactPatch<dim>& patch = assembly().contact_nodes[contact_node];
  const Vector<dim> moved = d.row(patch.node).transpose();
  return assembly().shape.gap ? std::abs(moved.dot(patch.initial_normal)) : moved.norm();
}

template <int dim>
Observation WearModel<dim>::observe(const State& state) const {
  const FieldValues<dim> values = this->values(state);
  const std::vector<PhaseContact<dim>> phases = contacts(values, state);
  const bool whole = dim == 3 || assembly().section() == Section::meridian;  // all around
  const int units = whole ? 3 : 2;
  const NodalField<dim>& d = values.vector(equations_.fields().d);
  Vector<dim> reaction = Vector<dim>::Zero();
  std::optional<double> approach, gradient;
  double half_width = 0;
  ContactArea area;
  Observation motion;
  for (std::size_t p = 0; p < phases.size(); ++p) {
    const WornBodyFields& fields = equations_.fields(p);
    widen(gradient, assembly(), equations_.shape_of_cells(values), values.vector(fields.u));
    const Phase<dim>& phase = equations_.phases()[p];
    reaction += phases[p].weight * reaction_of(assembly(), phase, phases[p].nodes, state.t);
    if (fields.w != FieldId::none)
      add_motion(phase, phases[p].weight, values.scalar(fields.w), approach, motion);
    const ContactArea now = contact_area(assembly(), d, phases[p].nodes);
    if (now.area >= area.area) area = now;
    if constexpr (dim == 2)
      half_width =
          std::max(half_width, contact_half_width(assembly(), fields, values, phases[p].nodes));
  }
  double depth = 0, worn = 0;  // `worn`: of the thickness
  for (std::size_t c = 0; c < assembly().contact_nodes.size(); ++c) {
    if (!assembly().wears(static_cast<int>(c))) continue;
    const double own = wear_depth(c, d);
    depth = std::max(depth, own);
    if (assembly().shape.gap) worn = std::max(worn, own / thickness_[c]);
  }
  Observation observed;
  observe_contact(phases, assembly(), units, observed);
  const std::vector<double> lost =
      observe_cells(assembly(), d, wear_flux_of(phases, assembly().copies), units, observed);
  if (!assembly().pairs.empty()) observe_bodies(assembly(), lost, phases, units, observed);
  if (approach) observed.push_back(common("approach", *approach));
  if (gradient) observed.push_back(common("displacement_gradient", *gradient));
  // Several pairs have ends of their own.
  if (dim == 2 && assembly().pairs.size() < 2)
    observed.push_back(common("contact_half_width", half_width));
  observed.push_back(common("wear_depth", largest_over_processes(depth)));
  if (assembly().shape.gap)
    observed.push_back(common("thickness_left", 1 - largest_over_processes(worn)));
  observed.push_back(common("contact_area", area.area, units));
  observed.push_back(common("contact_area_error", area.unknown, units));
  observed.insert(observed.end(), motion.begin(), motion.end());
  if (assembly().interface.sticks)
    observe_path(assembly(), phases, loop(values, state.t, phases), units, observed);
  if (assembly().interface.rolling)
    observe_rolling(assembly(), equations_.moved_on_partner(values), phases.front().nodes,
                    equations_.creepage(values), units, observed);
  // Of a part of a symmetric body, what is across the symmetry is not known.
  if (!equations_.phases().front().counter_body.guides.empty() && assembly().copies == 1)
    observe_reaction(assembly().section(), reaction, observed);
  for (Scalar& column : force_columns(assembly(), resultants_->balance(values, state.t, phases)))
    observed.push_back(std::move(column));
  return observed;
}

template <int dim>
std::vector<GridField> WearModel<dim>::fields(const State& state) const {
  const FieldValues<dim> values = this->values(state);
  const Assembly<dim>& body = assembly();
  GridField pressure{"pressure", "MPa", GridField::On::nodes, 1, {}};
  pressure.values.assign(body.mesh.nodes.size(), 0.0);
  for (const auto& [weight, nodes] : contacts(values, state))
    for (std::size_t c = 0; c < nodes.size(); ++c)
      pressure.values[body.contact_nodes[c].node] += weight * std::max(0.0, -nodes[c].traction);
  std::vector<GridField> fields =
      solid_fields<dim>(body.mesh, body.bodies, body.body_of, equations_.shape_of_cells(values),
                        values.vector(equations_.fields().u));
  fields[1] = nodal_vector<dim>("shape", values.vector(equations_.fields().d));
  fields.insert(fields.begin() + 2, pressure);
  return fields;
}

template <int dim>
std::optional<ContactSurface> WearModel<dim>::contact(const State& state) const {
  const FieldValues<dim> values = this->values(state);
  const std::vector<PhaseContact<dim>> phases = contacts(values, state);
  ContactSurface surface =
      surface_of<dim>(assembly().mesh, assembly().contact_nodes,
                      values.vector(equations_.fields().d), values.vector(equations_.fields().u));
  if (!assembly().pairs.empty()) find_bodies(*this->grid, surface);
  for (std::size_t c = 0; c < surface.node.size(); ++c) {
    for (const auto& [weight, nodes] : phases) {
      surface.pressure[c] += weight * std::max(0.0, -nodes[c].traction);
      surface.active[c] = std::max<int>(surface.active[c], nodes[c].active);
    }
    surface.wear_depth[c] = assembly().wears(static_cast<int>(c))
                                ? wear_depth(c, values.vector(equations_.fields().d))
                                : 0;
  }
  const bool rolls = assembly().interface.rolling.has_value(), sticks = assembly().interface.sticks;
  if (phases.size() > 1 || rolls)
    for (std::size_t p = 0; p < phases.size(); ++p) {
      surface.phase_position.push_back(equations_.phases()[p].position);
      surface.phase_weight.push_back(phases[p].weight);
      for (const ContactNode<dim>& contact : phases[p].nodes)
        surface.phase_pressure.push_back(std::max(0.0, -contact.traction));
      if (sticks || rolls) add_friction(phases[p].nodes, surface);
    }
  if (!sticks) return surface;
  const bool turns = axis_of_path(assembly()).has_value();
  for (const PlaceAndForce<dim>& at : loop(values, state.t, phases)) {
    for (const Vector<dim>& of : {at.place, at.force})
      surface.phase_loop.insert(surface.phase_loop.end(), of.begin(), of.end());
    if (turns) surface.phase_turn.insert(surface.phase_turn.end(), {at.angle, at.moment});
  }
  return surface;
}

template <int dim>
CounterSurface WearModel<dim>::counter_surface(const State& state) const {
  constexpr int cells_along = dim == 2 ? 128 : 32;
  const CounterBody<dim>& other = equations_.phases().front().counter_body;
  const PartnerMotion<> q = equations_.partner_motion(system().values(state.t, state.y), state.t);
  const FacetedSurface<dim> within =
      zero_level<dim>([&](const Vector<dim>& x) { return other.unchecked_distance(x, q, state.t); },
                      surroundings_, cells_along);
  CounterSurface surface;
  surface.dim = dim;
  surface.points = points_in_space<dim>(within.points);
  for (const auto& facet : within.facets)
    surface.facets.insert(surface.facets.end(), facet.begin(), facet.end());
  return surface;
}

template class WearModel<2>;
template class WearModel<3>;

}  // namespace gnomon
