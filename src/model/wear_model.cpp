#include <algorithm>
#include <gnomon/model/wear_model.hpp>

#include "model/limit_of_friction.hpp"
#include "model/observed_path.hpp"
#include "model/resultants.hpp"
#include "model/thickness.hpp"

namespace gnomon {

namespace {

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
  if (const auto& turning = assembly().interface.partner.turning; turning && !assembly().cycle)
    facts.longest_step = turning->longest_step();
  Abilities& can = *this;
  // One pass over the contact nodes and none over the cells.
  can.wear_flux = [this](const Point& at) {
    return wear_flux_of(contacts(system().values(at.t, at.y), at), assembly().copies);
  };
  if (assembly().cycle) can.phase_error = [this](const State& state) { return phase_error(state); };
  // Creepages are found at the start alone.
  if (assembly().interface.sticks || equations_.without_creepage() == equations_.deformation())
    can.behind_jump = [this](const State& state) { return behind_jump(state); };
  if (assembly().interface.reach > 0) {
    others_.emplace(assembly());
    can.succeed = [this](const State& state) { return succeed(state); };
    can.overdue = [this](const State& state) { return overdue(state); };
  }
  if (!assembly().pairs.empty()) {
    can.succeed = [this](const State& state) { return succeed_pairs(state); };
    can.overdue = [this](const State& state) { return have_moved(positions(state), 1); };
  }
  if (assembly().interface.rolling)
    can.limit = [this](const State& state) {
      return limit_of_friction(assembly(), contacts(values(state), state).front().nodes);
    };
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
