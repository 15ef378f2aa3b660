#include <algorithm>
#include <array>
#include <cmath>
#include <gnomon/model/examination.hpp>
#include <gnomon/model/magnitudes.hpp>
#include <gnomon/model/wear_model.hpp>
#include <limits>

#include "model/body_turn.hpp"
#include "model/connected_parts.hpp"
#include "model/elastic_drag.hpp"
#include "model/intrusion.hpp"
#include "model/observed_path.hpp"
#include "model/observed_rolling.hpp"
#include "model/resultants.hpp"
#include "model/sliding_error.hpp"
#include "model/tracks.hpp"
#include "model/unlike_bodies.hpp"

namespace gnomon {

namespace {

template <int dim>
bool touches(const PhaseContact<dim>& phase) {
  return std::ranges::any_of(phase.nodes, &ContactNode<dim>::active);
}

/// Examination::few_nodes.
template <int dim>
int few_nodes(const std::vector<char>& carries, const std::vector<PhaseContact<dim>>& contacts) {
  constexpr int most = dim == 2 ? 2 : 4;
  int touching = 0, all = 0;
  for (std::size_t c = 0; c < carries.size(); ++c) {
    if (carries[c] == 0) continue;
    ++all;
    touching += std::ranges::any_of(
        contacts, [c](const PhaseContact<dim>& phase) { return phase.nodes[c].active; });
  }
  return touching <= most && touching < all ? touching : 0;
}

/// Of a counter-body that no force moves, and of bodies that no load does.
template <int dim>
double find_overlap(const WornBodyEquations<dim>& equations, double part) {
  const Assembly<dim>& assembly = equations.assembly();
  double deepest = 0;
  for (const Phase<dim>& phase : equations.phases()) {
    if (phase.moves_freely() || !assembly.loads.empty()) return 0;
    deepest = std::max(deepest, overlap_at_rest(assembly.contact_nodes, phase.counter_body, part));
  }
  return deepest;
}

/// In the phase where it is largest; the forces of a moment may have no sum, and an approach or an
/// overlap presses by any force.
template <int dim>
double find_wedging(const std::vector<Phase<dim>>& phases,
                    const std::vector<PhaseContact<dim>>& contacts) {
  double most = 0;
  for (std::size_t p = 0; p < phases.size(); ++p) {
    if (!phases[p].force) continue;
    Vector<dim> sum = Vector<dim>::Zero();
    double all = 0, pressing = 0;
    for (const ContactNode<dim>& node : contacts[p].nodes) {
      sum += node.force;
      all += node.force.norm();
    }
    const std::vector<std::optional<double>> forces = phases[p].forces();
    for (std::size_t k = 0; k < forces.size(); ++k) {
      const Guide<dim>& guide = phases[p].counter_body.guides[k];
      if (guide.turns() || guide.travel) return 0;
      if (forces[k]) pressing += std::abs(sum.dot(guide.along));
    }
    if (pressing > 0) most = std::max(most, all / pressing);
  }
  return most;
}

template <int dim>
double find_lost_wear(const Assembly<dim>& assembly,
                      const std::vector<PhaseContact<dim>>& contacts) {
  const std::vector<int> body_of = body_of_nodes(assembly.mesh, assembly.body_of);
  std::vector<double> all(assembly.bodies.size(), 0), lost = all;
  for (const auto& [weight, nodes] : contacts)
    for (std::size_t c = 0; c < nodes.size(); ++c) {
      const ContactPatch<dim>& patch = assembly.contact_nodes[c];
      const double flux = weight * nodes[c].area * nodes[c].wear_rate;
      all[body_of[patch.node]] += flux;
      if (assembly.wears(static_cast<int>(c)) && !patch.may_move())
        lost[body_of[patch.node]] += flux;
    }
  double most = 0;
  for (std::size_t b = 0; b < all.size(); ++b)
    if (all[b] > 0) most = std::max(most, lost[b] / all[b]);
  return most;
}

/// 0 where nothing wears at all.
template <int dim>
double find_unworn_force(const Assembly<dim>& assembly,
                         const std::vector<PhaseContact<dim>>& contacts) {
  double worn = 0, unworn = 0;
  for (const auto& [weight, nodes] : contacts)
    for (std::size_t c = 0; c < nodes.size(); ++c)
      (assembly.wears(static_cast<int>(c)) ? worn : unworn) +=
          weight * nodes[c].area * std::max(0.0, -nodes[c].traction);
  const auto wears = [](const Surface<dim>& surface) { return surface.wears; };
  return worn + unworn > 0 && std::ranges::any_of(assembly.interface.surfaces, wears)
             ? unworn / (worn + unworn)
             : 0;
}

/// `depth`: by contact node.
template <int dim>
double find_worn_radius(const Assembly<dim>& assembly, const std::vector<double>& depth) {
  double most = 0;
  for (const Surface<dim>& surface : assembly.interface.surfaces)
    if (surface.track)
      for (const auto& facet : surface.facets)
        for (const int node : facet)
          most = std::max(most, depth[static_cast<std::size_t>(assembly.contact_node(node))] * 2 *
                                    M_PI / surface.track->path);
  return most;
}

template <int dim>
double find_stale_weight(const std::vector<Load<dim>>& loads, double t,
                         const Observation& observed) {
  double weight = 0;
  for (const Load<dim>& load : loads) weight += std::abs(load.weight * load.history.factor(t));
  const double volume = value_of(observed, "worn_volume").value_or(0),
               force = value_of(observed, "contact_force").value_or(0);
  return force > 0 ? weight * volume / force : 0;
}

/// Where bodies roll.
template <int dim>
void examine_rolling(const WornBodyEquations<dim>& equations, const FieldValues<dim>& values,
                     const std::vector<PhaseContact<dim>>& contacts, Examination& facts) {
  const Assembly<dim>& assembly = equations.assembly();
  const std::vector<ContactNode<dim>>& nodes = contacts.front().nodes;
  const PowerOfRolling power =
      power_of_rolling(assembly, equations.moved_on_partner(values), nodes);
  facts.without_friction = power.without_friction;
  const double sliding =
      assembly.copies * assembly.scales.force * assembly.interface.rolling->velocity.norm();
  constexpr double rounding = 1e-9, similar = 0.01;
  if (power.dissipated > rounding * sliding) facts.upwind_power = power.upwind / power.dissipated;
  if (std::abs(dundurs_of(assembly.bodies, assembly.pairs)) >= similar ||
      are_layered(assembly.mesh, assembly.bodies))
    return;
  // Of bodies that roll nearly freely both are small, and mean nothing.
  constexpr double little = 3e-6;
  const double driving = driving_power(assembly, nodes, equations.rolling(values));
  if (std::abs(driving) > little * assembly.interface.friction * sliding)
    facts.power_by_driving = power.dissipated / std::abs(driving);
}

}  // namespace

template <int dim>
Examination WearModel<dim>::examine(const State& state) const {
  const FieldValues<dim> values = this->values(state);
  const std::vector<PhaseContact<dim>> contacts = this->contacts(values, state);
  ForceBalance balance = resultants_->balance(values, state.t, contacts);
  Examination facts{.forces = std::move(balance.forces),
                    .reactions = std::move(balance.reactions),
                    .pairs = std::move(balance.pairs),
                    .idle_load = balance.idle_load};
  facts.intrusion = assembly().pairs.empty() ? find_intrusion(equations_, values, state.t, contacts)
                                             : find_intrusion_of_pairs(equations_, values);
  facts.drag = find_drag(equations_, values, contacts);
  if (state.t > 0) facts.edge = edge_pressure(assembly(), contacts);
  if (state.t > 0) facts.gap_error = gap_error(state, values, contacts);
  if (assembly().pairs.empty()) {
    facts.overlap = find_overlap(equations_, 0);
    facts.pressed = find_overlap(equations_, 1);
    facts.unworn_force = find_unworn_force(assembly(), contacts);
  }
  if (assembly().loads.empty()) facts.wedging = find_wedging(equations_.phases(), contacts);
  facts.body_turn = find_body_turn(equations_, values);
  facts.moved_axis = find_moved_axis(equations_, values, contacts);
  facts.unseen_sliding = find_unseen_sliding(equations_, values, contacts);
  facts.touched_end = find_touched_end(assembly(), contacts);
  facts.lost_wear = find_lost_wear(assembly(), contacts);
  if (std::ranges::any_of(assembly().loads, [](const Load<dim>& load) { return load.weight > 0; }))
    facts.stale_weight = find_stale_weight(assembly().loads, state.t, observe(state));
  if (assembly().interface.sticks) {
    const CycleOfSlip slip = cycle_of_slip(assembly(), contacts);
    facts.stick_area = slip.stick_area;
    facts.slip_area = slip.slip_area;
    const std::vector<PlaceAndForce<dim>> loop = this->loop(values, state.t, contacts);
    facts.rubs = is_rubbed(assembly(), loop);
    if (facts.rubs) facts.slip_zone = width_of_slip_zone(assembly(), slip.holds);
    if (!assembly().cycle->motion.cycle.rotation)
      for (const PlaceAndForce<dim>& at : loop)
        facts.turn = std::max(facts.turn, std::abs(at.angle));
  }
  if (assembly().interface.rolling) {
    examine_rolling(equations_, values, contacts, facts);
    std::vector<double> depth;
    for (std::size_t c = 0; c < assembly().contact_nodes.size(); ++c)
      depth.push_back(wear_depth(c, values.vector(equations_.fields().d)));
    facts.worn_radius = find_worn_radius(assembly(), depth);
  }
  facts.deformation = assembly().scales.displacement;
  facts.force = assembly().copies * assembly().scales.force;
  facts.size = Box<dim>::around(assembly().mesh.nodes).diagonal();
  facts.touches = std::ranges::any_of(contacts, touches<dim>);
  facts.few_nodes = few_nodes<dim>(assembly().carries, contacts);
  facts.gap = std::numeric_limits<double>::infinity();
  for (const PhaseContact<dim>& phase : contacts)
    for (std::size_t c = 0; c < phase.nodes.size(); ++c)
      if (assembly().carries[c]) facts.gap = std::min(facts.gap, phase.nodes[c].gap);
  return facts;
}

template Examination WearModel<2>::examine(const State&) const;
template Examination WearModel<3>::examine(const State&) const;

}  // namespace gnomon
