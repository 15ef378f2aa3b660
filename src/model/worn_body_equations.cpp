#include <algorithm>
#include <gnomon/mesh/semi_coarsening.hpp>
#include <gnomon/model/physics.hpp>
#include <gnomon/model/worn_body_equations.hpp>
#include <gnomon/terms/body_term.hpp>
#include <gnomon/terms/condensed_body.hpp>
#include <gnomon/terms/pressure_load.hpp>
#include <gnomon/terms/shape_evolution.hpp>
#include <gnomon/terms/shape_multiplier.hpp>
#include <gnomon/terms/springs.hpp>
#include <gnomon/terms/stick_term.hpp>

#include "model/connected_parts.hpp"

namespace gnomon {

namespace {

template <int dim>
std::shared_ptr<const std::vector<NodeInterpolation>> coarsening(const Assembly<dim>& body) {
  if (!body.solver.coarsens) return nullptr;
  return std::make_shared<const std::vector<NodeInterpolation>>(semi_coarsening(body.mesh));
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
  composition->part = connected_parts(assembly_->mesh);
  composition->part.resize(composition->fields->nodes + 1, -1);
  composition->solver = assembly_->solver;
  composition->coarsening = coarsening(*assembly_);
  composition_ = composition;
  composition->stages = {selection(false, true), deformation()};
  if (memory_before_ != FieldId::none) let_memory_follow(*composition);
}

/// The memory of slip is solved for with the contact; what sticks throughout the cycle keeps it.
template <int dim>
void WornBodyEquations<dim>::let_memory_follow(Composition<dim>& composition) const {
  composition.remember = [terms = contact_terms_, memory = memory()](
                             const ComposedSystem<dim>& whole, const Point& at,
                             FieldValues<dim>& values) {
    Eigen::VectorXd stuck = Eigen::VectorXd::Ones(values.vector(memory.s).rows());
    for (const std::size_t term : terms) {
      const auto& contact = dynamic_cast<const ContactNodes<dim>&>(whole.term(term));
      const std::vector<ContactNode<dim>> nodes = contact.nodes(whole.evaluation(at, values, term));
      for (std::size_t c = 0; c < nodes.size(); ++c)
        if (!nodes[c].active || !nodes[c].sticks) stuck[static_cast<Eigen::Index>(c)] = 0;
    }
    values.vector(memory.before) = values.vector(memory.s);
    values.scalar(memory.stuck) = stuck;
  };
  const std::vector<Block>& blocks = composition.fields->blocks;
  for (std::size_t b = 0; b < blocks.size(); ++b)
    if (blocks[b].role == Role::memory) composition.stages.back()[b] = 1;
}

template <int dim>
void WornBodyEquations<dim>::add(std::vector<TermFactory<dim>>& terms, TermKind kind,
                                 std::size_t phase, TermFactory<dim> make) {
  kinds_.push_back({kind, phase});
  terms.push_back(std::move(make));
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
Rolling<dim> WornBodyEquations<dim>::rolling(const FieldValues<dim>& values) const {
  Rolling<dim> found = *assembly_->interface.rolling;
  if (const FieldId unknown = fields().creepage; unknown != FieldId::none)
    found.creepage += values.vector(unknown).row(0).transpose();
  if (const FieldId unknown = fields().spin; unknown != FieldId::none)
    found.spin =
        found.turn * values.vector(unknown).row(0).dot(
                         found.turned(assembly_->contact_nodes.front().initial_position).first);
  const CounterBody<dim>& partner = phases_.front().counter_body;
  for (std::size_t k = 0; k < partner.guides.size(); ++k) {
    const Guide<dim>& guide = partner.guides[k];
    if (!guide.creeps()) continue;
    const double by = guide.creepage(values.scalar(fields().w)[static_cast<Eigen::Index>(k)]);
    found.creepage += by * guide.along;
    if (!guide.spins()) continue;
    found.spin = by * guide.turn;
    found.turn = guide.turn;
    found.centre = partner.position + guide.centre;
  }
  return found;
}

template <int dim>
Rolling<dim> WornBodyEquations<dim>::rolling_of_first(const FieldValues<dim>& values) const {
  Rolling<dim> own = rolling(values);
  if (assembly_->pairs.empty()) return own;
  const auto& [slave, master] = assembly_->pairs.front().numbers;
  if (slave > master) own.creepage *= -1, own.spin *= -1;
  return own;
}

template <int dim>
NodalField<dim> WornBodyEquations<dim>::carried(const Phase<dim>& phase) const {
  const std::size_t count = assembly_->contact_nodes.size();
  NodalField<dim> result = NodalField<dim>::Zero(static_cast<Eigen::Index>(count), dim);
  for (std::size_t c = 0; assembly_->cycle && c < count; ++c)
    result.row(static_cast<Eigen::Index>(c)) =
        carried_by(assembly_->cycle->motion, assembly_->interface.partner, phase,
                   assembly_->contact_nodes[c].initial_position)
            .transpose();
  return result;
}

template <int dim>
void WornBodyEquations<dim>::add_terms(std::vector<TermFactory<dim>>& terms) {
  for (std::size_t p = 0; p < phases_.size(); ++p) add_equilibrium(p, terms);
  add_forces_of_rolling(terms);
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
  for (const Load<dim>& load : assembly_->loads) add_load(load, terms);
  for (const Load<dim>& load : assembly_->swinging_loads) add_load(load, terms);
}

/// Of a phase, in its displacements at the contact nodes.
template <int dim>
void WornBodyEquations<dim>::add_condensed(std::size_t p, std::vector<TermFactory<dim>>& terms) {
  for (const CondensedPart& part : condensation_->parts())
    add(terms, TermKind::body, p,
        [of = condensation_, &part, f = fields_[p]](const Numbering& numbering) {
          return std::make_unique<CondensedBody<dim>>(part.stiffness, part.kept, numbering, f.u);
        });
  for (const DeadForces<dim>& load : condensation_->loads())
    add(terms, TermKind::load, p,
        [f = fields_[p], load, factor = load.factor(phases_[p])](const Numbering& n) {
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

/// The rows of the creepages that forces determine, without contact.
template <int dim>
void WornBodyEquations<dim>::add_forces_of_rolling(std::vector<TermFactory<dim>>& terms) {
  if (fields().creepage == FieldId::none) return;
  NodalField<dim> force = NodalField<dim>::Zero(1, dim);
  for (int i = 0; i < dim; ++i) force(0, i) = assembly_->interface.rolling->force[i].value_or(0);
  add(terms, TermKind::press, 0, [field = fields().creepage, force](const Numbering& numbering) {
    return std::make_unique<Loads<dim>>(numbering, field, force, LoadHistory{},
                                        Loads<dim>::Purpose::acts);
  });
  if (fields().spin == FieldId::none) return;
  const Rolling<dim>& rolling = *assembly_->interface.rolling;
  NodalField<dim> moment = NodalField<dim>::Zero(std::ssize(assembly_->contact_nodes), dim);
  moment.row(0) =
      *rolling.moment *
      rolling.turned(assembly_->contact_nodes.front().initial_position).first.transpose();
  add(terms, TermKind::press, 0, [field = fields().spin, moment](const Numbering& numbering) {
    return std::make_unique<Loads<dim>>(numbering, field, moment, LoadHistory{},
                                        Loads<dim>::Purpose::acts);
  });
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
void WornBodyEquations<dim>::add_load(const Load<dim>& load, std::vector<TermFactory<dim>>& terms) {
  const auto purpose = load.presses ? Loads<dim>::Purpose::presses : Loads<dim>::Purpose::acts;
  for (std::size_t p = 0; p < phases_.size(); ++p)
    add(terms, TermKind::load, p,
        [of = assembly_, f = fields_[p], factor = phases_[p].load_factor(load.swing), load,
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
    selected.push_back(block.differential || block.role == Role::memory ? 0
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
