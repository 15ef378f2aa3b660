// Contact in the equations: the terms of pairs and of a rigid partner, sliding, on a path, rolling.
#include <algorithm>
#include <cmath>
#include <gnomon/model/magnitudes.hpp>
#include <gnomon/model/worn_body_equations.hpp>
#include <gnomon/terms/contact_term.hpp>
#include <gnomon/terms/stick_term.hpp>
#include <limits>
#include <map>

#include "mesh/facet_table.hpp"
#include "model/upstream.hpp"

namespace gnomon {

namespace {

/// From which a node counts as in contact as a whole, in the mean of q.
template <int dim>
double full_pressure(const Assembly<dim>& body) {
  constexpr double part = 0.1;  // of the typical mean pressure
  return part * body.scales.stress;
}

template <int dim>
ContactState<dim> contact_state(const Assembly<dim>& body, const Phase<dim>& phase,
                                const WornBodyFields& fields, double nominal_speed) {
  const Interface<dim>& contact = body.interface;
  ContactState<dim> state{.u = fields.u,
                          .lambda = fields.lambda,
                          .q = fields.w,
                          .mean_power = fields.mean_power,
                          .mesh = body.mesh,
                          .parameters = {.counter_body = phase.counter_body,
                                         .wear = {},
                                         .friction = contact.friction,
                                         .streaming = contact.streaming,
                                         .normal_rule = contact.normal_rule,
                                         .rho = contact.rho,
                                         .full_pressure = full_pressure(body)},
                          .patches = body.contact_nodes,
                          .wear_weight = body.wear_weight,
                          .surface_of = body.surface_of,
                          .part = phase.weight,
                          .nominal_speed = nominal_speed};
  for (const Surface<dim>& surface : contact.surfaces) state.laws.push_back(surface.wear);
  if (body.loads.empty() && !phase.moves_freely() && !phase.counter_body.is_given())
    state.interference = overlap_at_rest(body.contact_nodes, phase.counter_body);
  return state;
}

template <int dim>
MortarState<dim> mortar_state(const Assembly<dim>& body, const Phase<dim>& phase,
                              const WornBodyFields& fields, double nominal_speed,
                              const std::vector<MortarCandidates>& candidates) {
  MortarState<dim> state{.u = fields.u,
                         .lambda = fields.lambda,
                         .d = fields.d,
                         .mean_power = fields.mean_power,
                         .mesh = body.mesh,
                         .patches = body.contact_nodes,
                         .pairs = body.pairs,
                         .candidates = candidates,
                         .surface_of = body.surface_of,
                         .wear_weight = body.wear_weight,
                         .normal_rule = body.interface.normal_rule,
                         .section = body.section(),
                         .rho = body.interface.rho,
                         .places = phase.places,
                         .part = phase.weight,
                         .full_pressure = full_pressure(body),
                         .nominal_speed = nominal_speed};
  for (const Surface<dim>& surface : body.interface.surfaces) state.laws.push_back(surface.wear);
  return state;
}

/// rho of lambda_T in rolling, a small part of a stiffness of contact: at 1, and at 0.1 where
/// friction is 2, Newton's method may cycle from a cold start.
template <int dim>
double rho_of_rolling(const Assembly<dim>& assembly, const std::vector<Upstream>& upstream) {
  constexpr double softness = 0.01;
  double young = std::numeric_limits<double>::infinity(), rho = 0;
  for (const Body& body : assembly.bodies) young = std::min(young, body.material.young_modulus);
  for (const Upstream& at : upstream) rho = std::max(rho, softness * young / at.distance);
  return rho;
}

/// Of the material that comes to a node from upstream.
template <int dim>
struct Passage {
  double length, interval;
  Vector<dim> passed;  ///< of the partner, whatever is deformed [length]
};

/// A rigid partner goes on by itself, but with small strains (stick_node.hpp).
template <int dim>
Passage<dim> passage_of(const Assembly<dim>& body, const Upstream& at) {
  const Rolling<dim>& rolling = *body.interface.rolling;
  const Vector<dim> X = body.mesh.nodes[static_cast<std::size_t>(at.node)],
                    way = rolling.linear ? Vector<dim>::Zero() : streamed(body.mesh, at);
  return {at.distance, at.distance / rolling.velocity.norm(),
          way + at.distance * rolling.creepage_at(X)};
}

/// dt (V^1 - V^2), with V^1 along the surface, which may be curved.
template <int dim>
Passage<dim> passage_of(const Assembly<dim>& body, const MortarPair<dim>& pair,
                        const Upstream& at) {
  const Rolling<dim>& rolling = *body.interface.rolling;
  const Vector<dim> X = body.mesh.nodes[static_cast<std::size_t>(at.node)];
  Vector<dim> way = streamed(body.mesh, at);
  if (rolling.linear) way -= pair.approach * pair.approach.dot(way);
  const double length = way.norm(), interval = length / pair.velocities[0].norm();
  const Vector<dim> turned = rolling.spin * (X - rolling.centre);
  return {length, interval, way - interval * pair.velocities[1] + length * turned};
}

/// Of each contact node, how far it slides by an unknown spin of one; none where it is given
/// [length].
template <int dim>
std::vector<double> arms_of_spin(const Assembly<dim>& body) {
  std::vector<double> arms;
  if (!body.interface.rolling || !body.interface.rolling->moment) return arms;
  for (const ContactPatch<dim>& patch : body.contact_nodes)
    arms.push_back(body.interface.rolling->turned(patch.initial_position).second);
  return arms;
}

}  // namespace

/// The phase of the assembly at this position in the cycle, or the nearest one.
template <int dim>
std::size_t nearest_instant(const Assembly<dim>& assembly, double position) {
  const std::vector<Phase<dim>> own = assembly.instants();
  const auto away = [position](const Phase<dim>& phase) {
    return std::abs(std::remainder(phase.position - position, 1.0));
  };
  return static_cast<std::size_t>(std::ranges::min_element(own, {}, away) - own.begin());
}

/// Of pairs: facets that may meet in a phase, which need not be one of the assembly's.
template <int dim>
std::vector<MortarCandidates> WornBodyEquations<dim>::candidates_in(const Phase<dim>& phase) const {
  std::vector<MortarCandidates> result;
  const std::vector<MortarPair<dim>>& pairs = assembly_->pairs;
  if (pairs.empty()) return result;
  const auto x =
      in_space(pairs, phase.places, assembly_->near[nearest_instant(*assembly_, phase.position)]);
  for (const MortarPair<dim>& pair : pairs) result.push_back(mortar_candidates(pair, x));
  return result;
}

template <int dim>
SlipMemory WornBodyEquations<dim>::memory() const {
  return {fields().memory, memory_before_, memory_stuck_, assembly_->cycle->motion.cycle.period};
}

/// Of pairs r, else u.
template <int dim>
PartOfPlace WornBodyEquations<dim>::part_of_place(std::size_t p, int node, double factor) const {
  if (assembly_->pairs.empty()) return {fields_[p].u, node, factor};
  return {fields_[p].place, assembly_->contact_node(node), factor};
}

/// Of a phase of a path, after the one before it.
template <int dim>
StickingFriction<dim> WornBodyEquations<dim>::friction_on_path(std::size_t p) const {
  const Phase<dim>& phase = phases_[p];
  const std::size_t count = assembly_->contact_nodes.size();
  StickingFriction<dim> friction{
      .traction = fields_[p].traction,
      .lambda_before = fields_[p == 0 ? fields_.size() - 1 : p - 1].lambda,
      .memory = memory(),
      .is_last = p + 1 == phases_.size(),
      .rho = assembly_->interface.rho,
      .interval = std::vector<double>(count, phase.interval * memory().period),
      .share = phase.interval / phase.weight,
      .factor = assembly_->interface.friction_factor};
  for (std::size_t c = 0; c < count; ++c)
    friction.before.push_back({p == 0 ? PartOfPlace{fields_[p].memory, static_cast<Eigen::Index>(c)}
                                      : part_of_place(p - 1, assembly_->contact_nodes[c].node)});
  return friction;
}

/// Of a rigid partner, in a phase of a path.
template <int dim>
PathOfPartner<dim> WornBodyEquations<dim>::path_of_partner(std::size_t p) const {
  const CounterBody<dim>& rest = assembly_->interface.partner;
  const CycleAxis<dim>& axis = assembly_->cycle->motion.axis;
  const Phase<dim>& phase = phases_[p];
  PathOfPartner<dim> path;
  if (assembly_->cycle->motion.cycle.rotation) {
    path.spin = axis.spin;
    path.centre = rest.position + axis.centre;
  }
  for (const Guide<dim>& guide : rest.guides)
    if (guide.turns()) {
      path.spin = guide.turn;
      path.centre = rest.position + guide.centre;
    }
  path.now = {phase.counter_body.position - rest.position, phase.angle};
  path.before.angle = phase.angle_before;
  if (p > 0) path.before.moved = phases_[p - 1].counter_body.position - rest.position;
  return path;
}

/// In steady rolling, after the material was upstream, by differences of second order.
template <int dim>
StickingFriction<dim> WornBodyEquations<dim>::friction_in_rolling() const {
  const std::size_t count = assembly_->contact_nodes.size();
  const std::vector<Upstream> upstream = upstream_of(*assembly_);
  const std::vector<double> arms = arms_of_spin(*assembly_);
  StickingFriction<dim> friction{
      .traction = fields().traction,
      .before = std::vector<std::vector<PartOfPlace>>(count),
      .passed = NodalField<dim>::Zero(static_cast<Eigen::Index>(count), dim),
      .lambda_before = fields().lambda,
      .rho = rho_of_rolling(*assembly_, upstream),
      .interval = std::vector<double>(count, 1),
      .factor = assembly_->interface.friction_factor};
  std::map<int, const MortarPair<dim>*> pair_of;  // by node of the slave
  for (const MortarPair<dim>& pair : assembly_->pairs)
    for (const int node : nodes_of_facets(pair.slave)) pair_of[node] = &pair;
  for (const Upstream& at : upstream) {
    const auto c = static_cast<std::size_t>(assembly_->contact_node(at.node));
    const Passage<dim> passage = pair_of.empty() ? passage_of(*assembly_, at)
                                                 : passage_of(*assembly_, *pair_of[at.node], at);
    for (const auto& [node, factor] : at.from)
      friction.before[c].push_back(part_of_place(0, node, factor));
    if (fields().creepage != FieldId::none)
      friction.before[c].push_back({fields().creepage, 0, -passage.length});
    if (fields().spin != FieldId::none)
      friction.before[c].push_back(
          {fields().spin, static_cast<Eigen::Index>(c), -passage.length * arms[c]});
    friction.interval[c] = passage.interval;
    friction.passed.row(static_cast<Eigen::Index>(c)) = passage.passed.transpose();
  }
  return friction;
}

/// Of a phase.
template <int dim>
TermFactory<dim> WornBodyEquations<dim>::contact_of(std::size_t p, double speed) const {
  const Assembly<dim>& of = *assembly_;
  const WornBodyFields& fields = fields_[p];
  const auto& rolling = of.interface.rolling;
  std::optional<StickingFriction<dim>> friction;
  if (of.interface.sticks) friction = friction_on_path(p);
  if (rolling) friction = friction_in_rolling();
  if (!of.pairs.empty()) {
    MortarState<dim> state = mortar_state(of, phases_[p], fields, speed, candidates_in(phases_[p]));
    if (friction)
      state.path = {*friction,   fields.place,     fields.creepage,
                    fields.spin, arms_of_spin(of), rolling && rolling->linear};
    return [state](const Numbering& n) { return std::make_unique<MortarTerm<dim>>(state, n); };
  }
  const ContactState<dim> contact = contact_state(of, phases_[p], fields, speed);
  if (!friction)
    return [contact, d = fields.d](const Numbering& n) {
      return std::make_unique<ContactTerm<dim>>(contact, d, n);
    };
  StickState<dim> state{*friction, contact};
  state.rolling = rolling;
  if (of.interface.sticks) state.path = path_of_partner(p);
  if (of.interface.sticks && p > 0) state.q_before = fields_[p - 1].w;
  return [state, d = fields.d](const Numbering& n) {
    return std::make_unique<StickTerm<dim>>(state, d, n);
  };
}

template std::size_t nearest_instant(const Assembly<2>&, double);
template std::size_t nearest_instant(const Assembly<3>&, double);
template SlipMemory WornBodyEquations<2>::memory() const;
template SlipMemory WornBodyEquations<3>::memory() const;
template TermFactory<2> WornBodyEquations<2>::contact_of(std::size_t, double) const;
template TermFactory<3> WornBodyEquations<3>::contact_of(std::size_t, double) const;

}  // namespace gnomon
