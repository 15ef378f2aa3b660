#include <algorithm>
#include <cmath>
#include <gnomon/mesh/semi_coarsening.hpp>
#include <gnomon/model/physics.hpp>
#include <gnomon/model/worn_body_equations.hpp>
#include <gnomon/shapes/counter_surface.hpp>
#include <gnomon/terms/body_term.hpp>
#include <gnomon/terms/condensed_body.hpp>
#include <gnomon/terms/contact_term.hpp>
#include <gnomon/terms/pressure_load.hpp>
#include <gnomon/terms/shape_evolution.hpp>
#include <gnomon/terms/shape_multiplier.hpp>
#include <gnomon/terms/springs.hpp>
#include <gnomon/terms/stick_term.hpp>
#include <limits>

#include "model/rigid_balance.hpp"
#include "model/upstream.hpp"

namespace gnomon {

namespace {

template <int dim>
std::shared_ptr<const std::vector<NodeInterpolation>> coarsening(const Assembly<dim>& body) {
  if (!body.solver.coarsens) return nullptr;
  return std::make_shared<const std::vector<NodeInterpolation>>(semi_coarsening(body.mesh));
}

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

/// Of lambda_T in rolling, of a stiffness of contact: Newton's method may cycle from a cold start
/// at 1, and turn the slip of nodes in space too slowly far below.
constexpr double softness_of_rolling = 0.1;

/// The smallest modulus of the bodies.
template <int dim>
double softest(const Assembly<dim>& assembly) {
  double young = std::numeric_limits<double>::infinity();
  for (const Body& body : assembly.bodies) young = std::min(young, body.material.young_modulus);
  return young;
}

/// Ascending, each once.
template <class Facets>
std::vector<int> nodes_of(const Facets& facets) {
  std::vector<int> nodes;
  for (const auto& facet : facets) nodes.insert(nodes.end(), facet.begin(), facet.end());
  std::ranges::sort(nodes);
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

template <int dim>
WornBodyEquations<dim>::WornBodyEquations(std::shared_ptr<const Assembly<dim>> assembly,
                                          Elasticity elasticity)
    : WornBodyEquations(assembly, assembly->instants(), elasticity) {}

template <int dim>
WornBodyEquations<dim>::WornBodyEquations(std::shared_ptr<const Assembly<dim>> assembly,
                                          std::vector<Phase<dim>> phases, Elasticity elasticity)
    : assembly_(std::move(assembly)),
      phases_(std::move(phases)),
      condensation_(elasticity == Elasticity::whole ? nullptr : assembly_->condensation) {
  auto composition = std::make_shared<Composition<dim>>();
  composition->fields = std::make_shared<const FieldSet>(make_fields());
  add_terms(composition->terms);
  for (const WornBodyFields& fields : fields_)  // also of a condensed one, to be read from values
    for (PrescribedValues held : assembly_->supports.moved) {
      held.field = fields.u;
      composition->prescribed.push_back(std::move(held));
    }
  composition->position = points_in_space<dim>(assembly_->mesh.nodes);
  composition->solver = assembly_->solver;
  composition->coarsening = coarsening(*assembly_);
  composition_ = composition;
  composition->stages = {selection(false, true), deformation()};
}

template <int dim>
void WornBodyEquations<dim>::add(std::vector<TermFactory<dim>>& terms, TermKind kind,
                                 std::size_t phase, TermFactory<dim> make) {
  kinds_.push_back({kind, phase});
  terms.push_back(std::move(make));
}

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
NodalField<dim> WornBodyEquations<dim>::moved_on_partner(const FieldValues<dim>& values) const {
  const NodalField<dim>& u = values.vector(fields().u);
  if (assembly_->pairs.empty()) return u;
  NodalField<dim> moved = NodalField<dim>::Zero(u.rows(), dim);
  for (std::size_t c = 0; c < assembly_->contact_nodes.size(); ++c)
    moved.row(assembly_->contact_nodes[c].node) =
        values.vector(fields().place).row(static_cast<Eigen::Index>(c));
  return moved;
}

template <int dim>
NodalField<dim> WornBodyEquations<dim>::carried(const Phase<dim>& phase) const {
  NodalField<dim> result(static_cast<Eigen::Index>(assembly_->contact_nodes.size()), dim);
  for (std::size_t c = 0; c < assembly_->contact_nodes.size(); ++c)
    result.row(static_cast<Eigen::Index>(c)) =
        carried_by(assembly_->cycle->motion, assembly_->interface.partner, phase,
                   assembly_->contact_nodes[c].initial_position)
            .transpose();
  return result;
}

/// Of a phase of a path, after the one before it.
template <int dim>
StickState<dim> WornBodyEquations<dim>::stick_state(std::size_t p, double nominal_speed) const {
  const double period = assembly_->cycle->motion.cycle.period;
  StickState<dim> state{.contact = contact_state(*assembly_, phases_[p], fields_[p], nominal_speed),
                        .traction = fields_[p].traction,
                        .carried = carried(phases_[p]),
                        .before = {},
                        .lambda_before = fields_[p == 0 ? fields_.size() - 1 : p - 1].lambda,
                        .memory = fields_[p].memory,
                        .is_last = p + 1 == phases_.size(),
                        .rho = assembly_->interface.rho,
                        .interval = {},
                        .share = phases_[p].interval / phases_[p].weight,
                        .period = period};
  state.interval.assign(assembly_->contact_nodes.size(), phases_[p].interval * period);
  for (std::size_t c = 0; c < assembly_->contact_nodes.size(); ++c)
    state.before.push_back({p == 0
                                ? PartOfPlace{state.memory, static_cast<Eigen::Index>(c)}
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
                       .memory = fields.memory,
                       .is_last = p + 1 == phases_.size(),
                       .rho = assembly_->interface.rho,
                       .interval = std::vector<double>(count, phases_[p].interval * period),
                       .share = phases_[p].interval / phases_[p].weight,
                       .period = period};
  for (std::size_t c = 0; c < count; ++c)
    path.before.push_back({{p == 0 ? fields.memory : fields_[p - 1].place, Eigen::Index(c)}});
  return path;
}

/// As rolling_state(), of pairs: the places on the partner's material in the place of
/// displacements.
template <int dim>
MortarPath<dim> WornBodyEquations<dim>::mortar_rolling() const {
  const std::size_t count = assembly_->contact_nodes.size();
  MortarPath<dim> path{.traction = fields().traction,
                       .place = fields().place,
                       .before = std::vector<std::vector<PartOfPlace>>(count),
                       .passed = NodalField<dim>::Zero(static_cast<Eigen::Index>(count), dim),
                       .lambda_before = fields().lambda,
                       .rho = 0,
                       .interval = std::vector<double>(count, 1)};
  for (const MortarPair<dim>& pair : assembly_->pairs) {
    const std::vector<int> slaves = nodes_of(pair.slave);
    for (const Upstream& at : upstream_of(*assembly_)) {
      if (!std::ranges::binary_search(slaves, at.node)) continue;
      const auto c = static_cast<std::size_t>(assembly_->contact_node(at.node));
      for (const auto& [node, factor] : at.from)
        path.before[c].push_back({fields().place, assembly_->contact_node(node), factor});
      path.interval[c] = at.distance / pair.velocities[0].norm();
      path.passed.row(static_cast<Eigen::Index>(c)) =
          path.interval[c] * (pair.velocities[0] - pair.velocities[1]).transpose();
      path.rho = std::max(path.rho, softness_of_rolling * softest(*assembly_) / at.distance);
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
  StickState<dim> state{
      .contact = contact_state(*assembly_, phases_.front(), fields(), nominal_speed),
      .traction = fields().traction,
      .carried = NodalField<dim>::Zero(static_cast<Eigen::Index>(count), dim),
      .before = std::vector<std::vector<PartOfPlace>>(count),
      .lambda_before = fields().lambda,
      .rho = 0,
      .interval = std::vector<double>(count, 1),
      .rolling = rolling};
  for (const Upstream& at : upstream_of(*assembly_)) {
    const auto c = static_cast<std::size_t>(assembly_->contact_node(at.node));
    const Vector<dim> X = assembly_->mesh.nodes[static_cast<std::size_t>(at.node)];
    Vector<dim> streamed = X;
    for (const auto& [node, factor] : at.from) {
      state.before[c].push_back({fields().u, node, factor});
      streamed -= factor * assembly_->mesh.nodes[static_cast<std::size_t>(node)];
    }
    state.interval[c] = at.distance / rolling.velocity.norm();
    if (rolling.linear && partner.motion.moves())
      streamed -= state.interval[c] * partner.motion.at(Vector<dim>(X - partner.position));
    else if (rolling.linear)
      streamed.setZero();
    state.carried.row(static_cast<Eigen::Index>(c)) =
        -(streamed + at.distance * rolling.creepage_at(X)).transpose();
    state.rho = std::max(state.rho, softness_of_rolling * softest(*assembly_) / at.distance);
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

template <int dim>
void WornBodyEquations<dim>::add_terms(std::vector<TermFactory<dim>>& terms) {
  for (std::size_t p = 0; p < phases_.size(); ++p) add_equilibrium(p, terms);
  if (!assembly_->shape.gap)
    add(terms, TermKind::mesh_motion, 0,
        [of = assembly_, f = fields()](const Numbering& numbering) {
          return std::make_unique<MeshMotion<dim>>(
              of->mesh, of->cross_section ? &*of->cross_section : nullptr, of->shape.along,
              of->shape.law, numbering, f.d);
        });
  if (assembly_->shape.constraint == ConstraintForm::multiplier)
    add(terms, TermKind::mesh_motion, 0,
        [of = assembly_, f = fields()](const Numbering& numbering) {
          return std::make_unique<ShapeMultiplier<dim>>(of->mesh, of->shape.along, of->shape.law,
                                                        of->contact_nodes, numbering, f.d, f.mu);
        });
  for (std::size_t p = 0; p < phases_.size(); ++p) {
    contact_terms_.push_back(terms.size());
    add(terms, TermKind::contact, p, contact_of(p, assembly_->nominal_speed()));
  }
  add(terms, TermKind::evolution, 0, [of = assembly_, f = fields()](const Numbering& numbering) {
    return std::make_unique<ShapeEvolution<dim>>(numbering, of->contact_nodes, f.d);
  });
  if (condensation_) return;
  for (const SpringSupport<dim>& springs : assembly_->supports.springs) add_springs(springs, terms);
  for (const Load<dim>& load : assembly_->loads)
    add_load(
        load, [](const Phase<dim>& phase) { return phase.load; }, terms);
  for (const SwingingLoad<dim>& swinging : assembly_->swinging_loads)
    add_load(
        swinging.load,
        [&swinging](const Phase<dim>& phase) {
          return phase.swing * swinging.factor.value(phase.position);
        },
        terms);
}

/// Of a phase, in its displacements at the contact nodes.
template <int dim>
void WornBodyEquations<dim>::add_condensed(std::size_t p, std::vector<TermFactory<dim>>& terms) {
  add(terms, TermKind::body, p, [of = condensation_, f = fields_[p]](const Numbering& numbering) {
    return std::make_unique<CondensedBody<dim>>(of->stiffness(), of->kept(), numbering, f.u);
  });
  for (const DeadForces<dim>& load : condensation_->loads())
    add(terms, TermKind::load, p,
        [f = fields_[p], load, factor = load.cyclic ? phases_[p].load : 1](const Numbering& n) {
          using Purpose = typename Loads<dim>::Purpose;
          return std::make_unique<Loads<dim>>(n, f.u, factor * load.forces, load.history,
                                              load.presses ? Purpose::presses : Purpose::acts);
        });
}

/// The rows of u and w, without contact and loads on the bodies. The first guide of the partner
/// follows the history of the interface.
template <int dim>
void WornBodyEquations<dim>::add_equilibrium(std::size_t p, std::vector<TermFactory<dim>>& terms) {
  if (condensation_)
    add_condensed(p, terms);
  else
    add(terms, TermKind::body, p, [of = assembly_, f = fields_[p]](const Numbering& numbering) {
      return std::make_unique<BodyTerm<dim>>(of->mesh, of->bodies, numbering, f.u,
                                             of->shape.gap ? FieldId::none : f.d);
    });
  const std::vector<std::optional<double>> forces = phases_[p].forces();
  for (std::size_t k = 0; k < forces.size(); ++k) {
    if (!forces[k]) continue;
    const Guide<dim>& guide = phases_[p].counter_body.guides[k];
    Field::Values along = Field::Values::Zero(static_cast<Eigen::Index>(forces.size()), 1);
    for (std::size_t l = 0; l < forces.size(); ++l)  // forces of all directions add up
      if (const Guide<dim>& other = phases_[p].counter_body.guides[l]; forces[l])
        along(static_cast<Eigen::Index>(l), 0) =
            *forces[k] * (l == k ? 1 : guide.along.dot(other.along));
    // What presses the bodies on each other may not vanish.
    add(terms, TermKind::press, p,
        [of = assembly_, f = fields_[p], along, k,
         factors = guide.factors](const Numbering& numbering) {
          using Purpose = typename Loads<dim>::Purpose;
          return k == 0
                     ? std::make_unique<Loads<dim>>(numbering, f.w, along, of->interface.history)
                     : std::make_unique<Loads<dim>>(numbering, f.w, along, factors, Purpose::acts);
        });
  }
}

/// Where the other ends move by c(t) u^, k A^ (u - c u^): the springs, and the force c k A^ u^.
template <int dim>
void WornBodyEquations<dim>::add_springs(const SpringSupport<dim>& springs,
                                         std::vector<TermFactory<dim>>& terms) {
  const NodalField<dim> pull = pull_of<dim>(springs, *assembly_);
  const auto number = static_cast<std::size_t>(&springs - assembly_->supports.springs.data());
  const auto first = kinds_.size();
  for (std::size_t p = 0; p < fields_.size(); ++p) {
    const WornBodyFields& fields = fields_[p];
    add(terms, TermKind::spring, p,
        [of = assembly_, f = fields, springs](const Numbering& numbering) {
          return std::make_unique<Springs<dim>>(of->mesh, springs.facets, springs.stiffness,
                                                numbering, f.u, of->section());
        });
    if (!pull.isZero(0))
      add(terms, TermKind::spring, p,
          [f = fields, pull, history = springs.history](const Numbering& n) {
            return std::make_unique<Loads<dim>>(n, f.u, pull, history, Loads<dim>::Purpose::acts);
          });
  }
  for (std::size_t k = first; k < kinds_.size(); ++k) kinds_[k].number = number;
}

template <int dim>
void WornBodyEquations<dim>::add_load(const Load<dim>& load,
                                      const std::function<double(const Phase<dim>&)>& factor_in,
                                      std::vector<TermFactory<dim>>& terms) {
  const auto purpose = load.presses ? Loads<dim>::Purpose::presses : Loads<dim>::Purpose::acts;
  for (std::size_t p = 0; p < phases_.size(); ++p)
    add(terms, TermKind::load, p,
        [of = assembly_, f = fields_[p], factor = factor_in(phases_[p]), load,
         purpose](const Numbering& numbering) -> std::unique_ptr<Term<dim>> {
          if (load.forces.size() > 0)
            return std::make_unique<Loads<dim>>(numbering, f.u, factor * load.forces, load.history,
                                                purpose);
          return std::make_unique<PressureLoad<dim>>(of->mesh, load.facets, factor * load.pressure,
                                                     load.history, numbering, f.u, f.d,
                                                     of->section());
        });
}

template <int dim>
BlockSelection WornBodyEquations<dim>::selection(bool deformation, bool mesh_motion) const {
  BlockSelection selected;
  for (const Block& block : composition_->fields->blocks)
    selected.push_back(block.differential ? 0
                       : block.role == Role::extension || block.role == Role::reaction
                           ? mesh_motion
                           : deformation);
  return selected;
}

template <int dim>
BlockSelection WornBodyEquations<dim>::deformation() const {
  return selection(true, false);
}

template <int dim>
BlockSelection WornBodyEquations<dim>::without_creepage() const {
  BlockSelection selected = deformation();
  for (std::size_t b = 0; b < selected.size(); ++b)
    if (composition_->fields->blocks[b].name == "creepage") selected[b] = 0;
  return selected;
}

template <int dim>
const ContactNodes<dim>& WornBodyEquations<dim>::contact(const ComposedSystem<dim>& system,
                                                         std::size_t phase) const {
  return dynamic_cast<const ContactNodes<dim>&>(system.term(contact_terms_[phase]));
}

template <int dim>
std::vector<ContactNode<dim>> WornBodyEquations<dim>::contact_nodes(
    const ComposedSystem<dim>& system, const FieldValues<dim>& values, const Point& at,
    std::size_t phase) const {
  return contact(system, phase).nodes(system.evaluation(at, values, contact_terms_[phase]));
}

template <int dim>
NodalField<dim> WornBodyEquations<dim>::places(const ComposedSystem<dim>& system,
                                               const FieldValues<dim>& values, double t,
                                               std::size_t phase) const {
  return dynamic_cast<const PlacesOnPartner<dim>&>(contact(system, phase))
      .places(system.evaluation({.t = t, .y = {}}, values, contact_terms_[phase]));
}

template class WornBodyEquations<2>;
template class WornBodyEquations<3>;

}  // namespace gnomon
