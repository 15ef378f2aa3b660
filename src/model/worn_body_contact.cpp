// Contact in the equations: the terms of pairs and of a rigid partner, sliding, on a path, rolling.
#include <algorithm>
#include <gnomon/model/worn_body_equations.hpp>
#include <gnomon/terms/contact_term.hpp>
#include <gnomon/terms/stick_term.hpp>
#include <limits>

#include "mesh/facet_table.hpp"
#include "model/rigid_balance.hpp"
#include "model/upstream.hpp"

namespace gnomon {

namespace {

template <int dim>
ContactState<dim> contact_state(const Assembly<dim>& body, const Phase<dim>& phase,
                                const WornBodyFields& fields, double nominal_speed) {
  const Interface<dim>& contact = body.interface;
  ContactState<dim> state{.u = fields.u,
                          .lambda = fields.lambda,
                          .q = fields.w,
                          .mesh = body.mesh,
                          .parameters = {.counter_body = phase.counter_body,
                                         .wear = {},
                                         .friction = contact.friction,
                                         .streaming = contact.streaming,
                                         .normal_rule = contact.normal_rule,
                                         .rho = contact.rho},
                          .patches = body.contact_nodes,
                          .wear_weight = body.wear_weight,
                          .surface_of = body.surface_of,
                          .part = phase.weight,
                          .nominal_speed = nominal_speed};
  for (const Surface<dim>& surface : contact.surfaces) state.laws.push_back(surface.wear);
  return state;
}

template <int dim>
MortarState<dim> mortar_state(const Assembly<dim>& body, const Phase<dim>& phase,
                              const WornBodyFields& fields, double nominal_speed,
                              const std::vector<MortarCandidates>& candidates) {
  MortarState<dim> state{.u = fields.u,
                         .lambda = fields.lambda,
                         .d = fields.d,
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

}  // namespace

/// Of pairs: facets that may meet in a phase, which need not be one of the assembly's.
template <int dim>
std::vector<MortarCandidates> WornBodyEquations<dim>::candidates_in(const Phase<dim>& phase) const {
  std::vector<MortarCandidates> result;
  const std::vector<MortarPair<dim>>& pairs = assembly_->pairs;
  if (pairs.empty()) return result;
  const std::vector<Phase<dim>> own = assembly_->instants();
  const auto known = std::ranges::find(own, phase.position, &Phase<dim>::position);
  const auto x =
      in_space(pairs, phase.places,
               known != own.end() ? assembly_->near[static_cast<std::size_t>(known - own.begin())]
                                  : RigidBalance<dim>(*assembly_, phase.places).x);
  for (const MortarPair<dim>& pair : pairs) result.push_back(mortar_candidates(pair, x));
  return result;
}

template <int dim>
SlipMemory WornBodyEquations<dim>::memory() const {
  return {fields().memory, memory_before_, memory_stuck_, assembly_->cycle->motion.cycle.period};
}

/// Of a phase of a path, after the one before it.
template <int dim>
StickState<dim> WornBodyEquations<dim>::stick_state(std::size_t p, double nominal_speed) const {
  const double period = assembly_->cycle->motion.cycle.period;
  StickState<dim> state{.contact = contact_state(*assembly_, phases_[p], fields_[p], nominal_speed),
                        .traction = fields_[p].traction,
                        .carried = carried(phases_[p]),
                        .before = {},
                        .origin = assembly_->interface.partner.position,
                        .lambda_before = fields_[p == 0 ? fields_.size() - 1 : p - 1].lambda,
                        .memory = memory(),
                        .is_last = p + 1 == phases_.size(),
                        .rho = assembly_->interface.rho,
                        .interval = {},
                        .share = phases_[p].interval / phases_[p].weight,
                        .factor = assembly_->interface.friction_factor};
  state.interval.assign(assembly_->contact_nodes.size(), phases_[p].interval * period);
  for (std::size_t c = 0; c < assembly_->contact_nodes.size(); ++c)
    state.before.push_back({p == 0
                                ? PartOfPlace{state.memory.s, static_cast<Eigen::Index>(c)}
                                : PartOfPlace{fields_[p - 1].u, assembly_->contact_nodes[c].node}});
  if (p == 0) return state;
  state.q_before = fields_[p - 1].w;
  state.carried_before = carried(phases_[p - 1]);
  return state;
}

template <int dim>
MortarPath<dim> WornBodyEquations<dim>::mortar_path(std::size_t p) const {
  const WornBodyFields& fields = fields_[p];
  const double period = assembly_->cycle->motion.cycle.period;
  const std::size_t count = assembly_->contact_nodes.size();
  MortarPath<dim> path{.traction = fields.traction,
                       .place = fields.place,
                       .lambda_before = fields_[p == 0 ? fields_.size() - 1 : p - 1].lambda,
                       .memory = memory(),
                       .is_last = p + 1 == phases_.size(),
                       .rho = assembly_->interface.rho,
                       .interval = std::vector<double>(count, phases_[p].interval * period),
                       .share = phases_[p].interval / phases_[p].weight,
                       .factor = assembly_->interface.friction_factor};
  for (std::size_t c = 0; c < count; ++c)
    path.before.push_back({{p == 0 ? fields.memory : fields_[p - 1].place, Eigen::Index(c)}});
  return path;
}

/// As rolling_state(), of pairs: the places on the partner's material in the place of
/// displacements.
template <int dim>
MortarPath<dim> WornBodyEquations<dim>::mortar_rolling() const {
  const Rolling<dim>& rolling = *assembly_->interface.rolling;
  const std::size_t count = assembly_->contact_nodes.size();
  const std::vector<Upstream> upstream = upstream_of(*assembly_);
  MortarPath<dim> path{.traction = fields().traction,
                       .place = fields().place,
                       .before = std::vector<std::vector<PartOfPlace>>(count),
                       .passed = NodalField<dim>::Zero(static_cast<Eigen::Index>(count), dim),
                       .lambda_before = fields().lambda,
                       .rho = rho_of_rolling(*assembly_, upstream),
                       .interval = std::vector<double>(count, 1),
                       .flat = rolling.linear,
                       .factor = assembly_->interface.friction_factor,
                       .creepage = fields().creepage};
  for (const MortarPair<dim>& pair : assembly_->pairs) {
    const std::set<int> slaves = nodes_of_facets(pair.slave);
    for (const Upstream& at : upstream) {
      if (!slaves.contains(at.node)) continue;
      const auto c = static_cast<std::size_t>(assembly_->contact_node(at.node));
      for (const auto& [node, factor] : at.from)
        path.before[c].push_back({fields().place, assembly_->contact_node(node), factor});
      Vector<dim> way = streamed(assembly_->mesh, at);
      if (path.flat) way -= pair.approach * pair.approach.dot(way);
      path.interval[c] = way.norm() / pair.velocities[0].norm();
      // dt V^1 along the surface, which may be curved.
      const Vector<dim> turned =
          rolling.spin *
          (assembly_->mesh.nodes[static_cast<std::size_t>(at.node)] - rolling.centre);
      path.passed.row(static_cast<Eigen::Index>(c)) =
          (way - path.interval[c] * pair.velocities[1] + way.norm() * turned).transpose();
      if (path.creepage != FieldId::none) path.before[c].push_back({path.creepage, 0, -way.norm()});
    }
  }
  return path;
}

/// The place before is where the material upstream is, by differences of second order.
template <int dim>
StickState<dim> WornBodyEquations<dim>::rolling_state(double nominal_speed) const {
  const Rolling<dim>& rolling = *assembly_->interface.rolling;
  const CounterBody<dim>& partner = assembly_->interface.partner;
  const std::size_t count = assembly_->contact_nodes.size();
  const std::vector<Upstream> upstream = upstream_of(*assembly_);
  StickState<dim> state{
      .contact = contact_state(*assembly_, phases_.front(), fields(), nominal_speed),
      .traction = fields().traction,
      .carried = NodalField<dim>::Zero(static_cast<Eigen::Index>(count), dim),
      .before = std::vector<std::vector<PartOfPlace>>(count),
      .lambda_before = fields().lambda,
      .rho = rho_of_rolling(*assembly_, upstream),
      .interval = std::vector<double>(count, 1),
      .factor = assembly_->interface.friction_factor,
      .rolling = rolling};
  for (const Upstream& at : upstream) {
    const auto c = static_cast<std::size_t>(assembly_->contact_node(at.node));
    const Vector<dim> X = assembly_->mesh.nodes[static_cast<std::size_t>(at.node)];
    for (const auto& [node, factor] : at.from)
      state.before[c].push_back({fields().u, node, factor});
    Vector<dim> way = streamed(assembly_->mesh, at);
    state.interval[c] = at.distance / rolling.velocity.norm();
    if (rolling.linear && partner.motion.moves())
      way -= state.interval[c] * partner.motion.at(Vector<dim>(X - partner.position));
    else if (rolling.linear)
      way.setZero();
    state.carried.row(static_cast<Eigen::Index>(c)) =
        -(way + at.distance * rolling.creepage_at(X)).transpose();
  }
  return state;
}

/// Of a phase.
template <int dim>
TermFactory<dim> WornBodyEquations<dim>::contact_of(std::size_t p, double speed) const {
  const Assembly<dim>& of = *assembly_;
  const FieldId d = fields().d;
  if (!of.pairs.empty()) {
    MortarState<dim> state =
        mortar_state(of, phases_[p], fields_[p], speed, candidates_in(phases_[p]));
    if (of.interface.sticks) state.path = mortar_path(p);
    if (of.interface.rolling) state.path = mortar_rolling();
    return [state](const Numbering& n) { return std::make_unique<MortarTerm<dim>>(state, n); };
  }
  if (of.interface.sticks || of.interface.rolling)
    return [state = of.interface.sticks ? stick_state(p, speed) : rolling_state(speed),
            d](const Numbering& n) { return std::make_unique<StickTerm<dim>>(state, d, n); };
  return [state = contact_state(of, phases_[p], fields_[p], speed), d](const Numbering& n) {
    return std::make_unique<ContactTerm<dim>>(state, d, n);
  };
}

template TermFactory<2> WornBodyEquations<2>::contact_of(std::size_t, double) const;
template TermFactory<3> WornBodyEquations<3>::contact_of(std::size_t, double) const;

}  // namespace gnomon
