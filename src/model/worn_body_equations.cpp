#include <algorithm>
#include <cmath>
#include <gnomon/mesh/semi_coarsening.hpp>
#include <gnomon/model/worn_body_equations.hpp>
#include <gnomon/terms/body_term.hpp>
#include <gnomon/terms/loads.hpp>
#include <numeric>

namespace gnomon {

namespace {

/// The problem's scales, but not smaller than rounding errors of positions and stresses allow: a
/// small load, a short run or a stiff body would otherwise require an impossible accuracy.
template <int dim>
Scales above_rounding(const WornBody<dim>& body) {
  Vector<dim> low = body.mesh.nodes.front(), high = low;
  for (const Vector<dim>& X : body.mesh.nodes) low = low.cwiseMin(X), high = high.cwiseMax(X);
  const double length = 1e-6 * (high - low).maxCoeff();
  double area = std::pow((high - low).maxCoeff(), dim - 1);
  if (body.element.section == Section::meridian) area *= 2 * M_PI * high[0];
  const double stiffness =
      1e-7 * (body.material.moduli.lambda + 2 * body.material.moduli.mu) * area;
  Scales scales = body.scales;
  scales.displacement = std::max(scales.displacement, length);
  scales.force = std::max(scales.force, stiffness);
  if (scales.wear_depth < length) scales.auxiliary_force *= length / scales.wear_depth;
  return scales;
}

std::vector<int> all_nodes(std::size_t count) {
  std::vector<int> nodes(count);
  std::iota(nodes.begin(), nodes.end(), 0);
  return nodes;
}

template <int dim>
std::vector<int> contact_nodes(const WornBody<dim>& body) {
  std::vector<int> nodes;
  for (const auto& patch : body.contact_nodes) nodes.push_back(patch.node);
  return nodes;
}

/// Values that are not held belong to a block.
void assign(Field& field, const auto& held, int block) {
  for (Eigen::Index k = 0; k < field.block.size(); ++k)
    field.block.data()[k] = held.data()[k] ? -1 : block;
}

template <int dim>
Field displacement_field(const WornBody<dim>& body, const Scales& scales, int block) {
  Field u("displacement", all_nodes(body.mesh.nodes.size()), dim);
  assign(u, body.displacement_fixed, block);
  u.row_scale.setConstant(scales.force);
  u.unknown_scale.setConstant(scales.displacement);
  return u;
}

template <int dim>
Field shape_field(const WornBody<dim>& body, const Scales& scales, int interior, int surface) {
  Field d("shape", all_nodes(body.mesh.nodes.size()), dim);
  assign(d, body.shape_fixed, interior);
  d.row_scale.setConstant(scales.auxiliary_force);
  d.unknown_scale.setConstant(scales.wear_depth);
  for (const auto& patch : body.contact_nodes)
    for (int i = 0; i < dim; ++i) {
      if (d.block(patch.node, i) >= 0) d.block(patch.node, i) = surface;
      d.row_scale(patch.node, i) = scales.wear_depth / scales.duration;
    }
  if (body.section)
    for (int node : d.node) d.carrier.push_back(body.shape_node(node));
  return d;
}

template <int dim>
Field multiplier_field(const WornBody<dim>& body, const Scales& scales, int block) {
  Field lambda("contact_multiplier", contact_nodes(body), 1);
  lambda.block.setConstant(block);
  lambda.row_scale.setConstant(scales.displacement);
  lambda.unknown_scale.setConstant(scales.stress);
  return lambda;
}

template <int dim>
Field shape_multiplier_field(const WornBody<dim>& body, const Scales& scales, int block) {
  Field mu("shape_multiplier", contact_nodes(body), dim);
  mu.row_scale.setConstant(scales.auxiliary_force);
  for (Eigen::Index c = 0; c < mu.entities(); ++c) {
    const ContactPatch<dim>& patch = body.contact_nodes[c];
    mu.unknown_scale.row(c).setConstant(scales.auxiliary_force / patch.initial_area);
    for (int i = 0; i < dim; ++i)
      if (!body.shape_fixed(patch.node, i)) mu.block(c, i) = block;
  }
  return mu;
}

Field rigid_motion_field(int nodes, const Scales& scales, int block) {
  Field w("rigid_motion", {nodes}, 1);
  w.block.setConstant(block);
  w.row_scale.setConstant(scales.force);
  w.unknown_scale.setConstant(scales.displacement);
  return w;
}

template <int dim>
std::vector<std::array<double, 3>> positions(const Mesh<dim>& mesh) {
  std::vector<std::array<double, 3>> result(mesh.nodes.size());
  for (std::size_t node = 0; node < mesh.nodes.size(); ++node)
    std::copy_n(mesh.nodes[node].begin(), dim, result[node].begin());
  return result;
}

template <int dim>
std::shared_ptr<const std::vector<NodeInterpolation>> coarsening(const WornBody<dim>& body) {
  if (body.solver.method != LinearSolverChoice::Method::block ||
      body.solver.preconditioner != LinearSolverChoice::Preconditioner::multigrid)
    return nullptr;
  return std::make_shared<const std::vector<NodeInterpolation>>(semi_coarsening(body.mesh));
}

template <int dim>
WornSurface<dim> worn_surface(const WornBody<dim>& body, const WornBodyFields& fields) {
  return {fields.d, fields.mu, &body.contact_nodes, body.augmentation};
}

template <int dim>
ContactState<dim> contact_state(const WornBody<dim>& body, const Phase<dim>& phase,
                                const WornBodyFields& fields, double nominal_speed) {
  ContactState<dim> state{fields.u,         fields.lambda,     fields.w,
                          body.mesh,        body.contact,      body.contact_nodes,
                          body.wear_weight, body.further_wear, body.wear_surface,
                          phase.weight,     nominal_speed};
  state.parameters.counter_body = phase.counter_body;
  return state;
}

}  // namespace

template <int dim>
WornBodyEquations<dim>::WornBodyEquations(std::shared_ptr<const WornBody<dim>> body)
    : WornBodyEquations(body, body->phases()) {}

template <int dim>
WornBodyEquations<dim>::WornBodyEquations(std::shared_ptr<const WornBody<dim>> body,
                                          std::vector<Phase<dim>> phases)
    : body_(std::move(body)), phases_(std::move(phases)) {
  auto composition = std::make_shared<Composition<dim>>();
  composition->fields = std::make_shared<const FieldSet>(make_fields());
  add_terms(composition->terms);
  for (const WornBodyFields& fields : fields_)
    for (PrescribedValues held : body_->prescribed_displacement) {
      held.field = fields.u;
      composition->prescribed.push_back(std::move(held));
    }
  composition->position = positions(body_->mesh);
  composition->solver = body_->solver;
  composition->coarsening = coarsening(*body_);
  composition_ = composition;
  composition->stages = {selection(false, true), deformation()};
}

/// Factories share the ownership of the body, so that terms may refer to it.
template <int dim>
void WornBodyEquations<dim>::add_terms(std::vector<TermFactory<dim>>& terms) {
  using Made = std::unique_ptr<Term<dim>>;
  for (std::size_t p = 0; p < phases_.size(); ++p) add_equilibrium(p, terms);
  terms.push_back([body = body_, f = fields()](const Numbering& numbering) -> Made {
    return std::make_unique<MeshMotion<dim>>(body->mesh, body->section ? &*body->section : nullptr,
                                             body->shape_along, body->mesh_motion, numbering, f.d,
                                             f.mu);
  });
  const double speed = body_->nominal_speed();
  for (std::size_t p = 0; p < phases_.size(); ++p) {
    contact_terms_.push_back(terms.size());
    terms.push_back([body = body_, phase = phases_[p], f = fields_[p],
                     speed](const Numbering& numbering) -> Made {
      return std::make_unique<ContactTerm<dim>>(contact_state(*body, phase, f, speed),
                                                worn_surface(*body, f), numbering);
    });
  }
  terms.push_back([body = body_, f = fields()](const Numbering& numbering) -> Made {
    return std::make_unique<ShapeEvolution<dim>>(numbering, worn_surface(*body, f));
  });
  for (const AddedTermFactory<dim>& make : body_->added_terms)
    for (const WornBodyFields& fields : fields_)
      terms.push_back([body = body_, f = fields, make](const Numbering& numbering) -> Made {
        return make(*body, f, numbering);
      });
}

/// The rows of u and w, without contact.
template <int dim>
void WornBodyEquations<dim>::add_equilibrium(std::size_t p, std::vector<TermFactory<dim>>& terms) {
  using Made = std::unique_ptr<Term<dim>>;
  terms.push_back([body = body_, f = fields_[p]](const Numbering& numbering) -> Made {
    return std::make_unique<BodyTerm<dim>>(body->mesh, body->material, body->element, numbering,
                                           f.u, f.d);
  });
  terms.push_back([body = body_, f = fields_[p],
                   factor = phases_[p].load](const Numbering& numbering) -> Made {
    return std::make_unique<Loads<dim>>(numbering, f.u, factor * body->load, body->load_history);
  });
  if (phases_[p].force)
    terms.push_back([body = body_, f = fields_[p],
                     force = *phases_[p].force](const Numbering& numbering) -> Made {
      return std::make_unique<Loads<dim>>(numbering, f.w, Field::Values::Constant(1, 1, force),
                                          body->load_history);
    });
}

template <int dim>
FieldSet WornBodyEquations<dim>::make_fields() {
  const Scales scales = above_rounding(*body_);
  FieldSet set;
  set.nodes = static_cast<int>(body_->mesh.nodes.size());
  fields_.resize(phases_.size());
  const auto of_phase = [](Block block, std::size_t phase) {
    block.owner = static_cast<int>(phase);
    return block;
  };
  for (std::size_t p = 0; p < phases_.size(); ++p) {
    const int displacement =
        set.add(of_phase({"displacement", "u", "all nodes", Role::stiffness}, p));
    fields_[p].u = set.add(displacement_field(*body_, scales, displacement));
  }
  const int interior = set.add({"shape", "d", "nodes off the contact surface", Role::extension});
  const int surface = set.add({.name = "worn_surface",
                               .symbol = "d",
                               .where = "contact nodes (differential)",
                               .role = Role::evolution,
                               .differential = true});
  const FieldId d = set.add(shape_field(*body_, scales, interior, surface));
  for (std::size_t p = 0; p < phases_.size(); ++p) {
    const int multiplier =
        set.add(of_phase({"contact_multiplier", "lambda", "contact nodes", Role::multiplier}, p));
    fields_[p].lambda = set.add(multiplier_field(*body_, scales, multiplier));
  }
  for (std::size_t p = 0; p < phases_.size(); ++p) {
    fields_[p].d = d;
    fields_[p].load = phases_[p].load;
    if (!phases_[p].force) continue;
    const int rigid = set.add(of_phase({"rigid_motion", "w", "counter-body", Role::rigid}, p));
    fields_[p].w = set.add(rigid_motion_field(set.nodes, scales, rigid));
  }
  if (body_->constraint == ConstraintForm::multiplier) {
    const int reaction = set.add({"shape_multiplier", "mu", "contact nodes", Role::reaction});
    const FieldId mu = set.add(shape_multiplier_field(*body_, scales, reaction));
    for (WornBodyFields& fields : fields_) fields.mu = mu;
  }
  return set;
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
const ContactTerm<dim>& WornBodyEquations<dim>::contact(const ComposedSystem<dim>& system,
                                                        std::size_t phase) const {
  return dynamic_cast<const ContactTerm<dim>&>(system.term(contact_terms_[phase]));
}

template <int dim>
std::vector<ContactNode<dim>> WornBodyEquations<dim>::contact_nodes(
    const ComposedSystem<dim>& system, const FieldValues<dim>& values, const Point& at,
    std::size_t phase) const {
  return contact(system, phase).nodes(system.evaluation(at, values, contact_terms_[phase]));
}

template class WornBodyEquations<2>;
template class WornBodyEquations<3>;

}  // namespace gnomon
