// The fields of a wearing assembly: their unknowns, and the scales of these.
#include <algorithm>
#include <cmath>
#include <gnomon/model/physics.hpp>
#include <gnomon/model/worn_body_equations.hpp>
#include <gnomon/shapes/counter_surface.hpp>
#include <gnomon/terms/shape_multiplier.hpp>
#include <limits>

#include "model/rolling_fields.hpp"

namespace gnomon {

namespace {

/// The problem's scales, but not smaller than rounding errors of positions and stresses allow: a
/// small load, a short run or a stiff body would otherwise require an impossible accuracy.
template <int dim>
Scales above_rounding(const Assembly<dim>& body) {
  const auto [low, high] = Box<dim>::around(body.mesh.nodes);
  const double size = (high - low).maxCoeff();
  // Gaps are differences of coordinates as large as the partner's radius.
  const double reach = body.pairs.empty() ? body.interface.partner.shape.reach() : 0;
  const double length = 1e-6 * std::max(size, reach);
  double area = std::pow(size, dim - 1);
  if (body.section() == Section::meridian) area *= 2 * M_PI * high[0];
  double modulus = 0;
  for (const Body& each : body.bodies)
    modulus = std::max(modulus, each.material.moduli.lambda + 2 * each.material.moduli.mu);
  const double stiffness = 1e-7 * modulus * area;
  Scales scales = body.scales;
  scales.auxiliary_force *= body.shape.law.material.collapse_force;
  scales.displacement = std::max(scales.displacement, length);
  scales.force = std::max(scales.force, stiffness);
  if (scales.wear_depth < length) scales.auxiliary_force *= length / scales.wear_depth;
  return scales;
}

template <int dim>
std::vector<int> contact_nodes(const Assembly<dim>& body) {
  std::vector<int> nodes;
  for (const auto& patch : body.contact_nodes) nodes.push_back(patch.node);
  return nodes;
}

template <int dim>
Field shape_field(const Assembly<dim>& body, const Scales& scales, int interior, int surface) {
  Field d = field_at_nodes<dim>("shape", body.shape.held, interior, scales.auxiliary_force,
                                scales.wear_depth);
  for (std::size_t c = 0; c < body.contact_nodes.size(); ++c) {
    if (!body.wears(static_cast<int>(c))) continue;
    const int node = body.contact_nodes[c].node;
    for (int i = 0; i < dim; ++i) {
      if (d.block(node, i) >= 0) d.block(node, i) = surface;
      d.row_scale(node, i) = scales.wear_depth / scales.duration;
    }
  }
  d.carrier = body.carrier;
  d.direction = body.shape_direction;
  return d;
}

template <int dim>
Field multiplier_field(const Assembly<dim>& body, const Scales& scales, int block) {
  Field lambda("contact_multiplier", contact_nodes(body), 1);
  for (std::size_t c = 0; c < body.carries.size(); ++c)
    lambda.block(static_cast<Eigen::Index>(c), 0) = body.carries[c] ? block : -1;
  lambda.row_scale.setConstant(scales.displacement);
  lambda.unknown_scale.setConstant(scales.stress);
  return lambda;
}

/// A value for each guide of the counter-body, unknown where a force presses it. An angle moves the
/// body by its size; a spin has the arm of the contact.
template <int dim>
Field rigid_motion_field(const Assembly<dim>& body, const Phase<dim>& phase, const Scales& scales,
                         int block, int creepage) {
  const std::vector<std::optional<double>> forces = phase.forces();
  const int at_no_node = static_cast<int>(body.mesh.nodes.size());
  Field w("rigid_motion", std::vector<int>(forces.size(), at_no_node), 1);
  const auto [low, high] = Box<dim>::around(body.mesh.nodes);
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const Guide<dim>& guide = phase.counter_body.guides[k];
    const double arm = guide.turns() ? (high - low).maxCoeff() : 1;
    if (forces[k]) w.block(k, 0) = guide.creeps() ? creepage : block;
    w.row_scale(k, 0) = scales.force * (guide.spins() ? guide.creep : arm);
    w.unknown_scale(k, 0) = scales.displacement / arm;
  }
  return w;
}

/// How far the partner has moved at a contact node in each of the phases, from the first [length].
template <int dim>
std::vector<Vector<dim>> moves_of_partner(const Assembly<dim>& body,
                                          const std::vector<Phase<dim>>& phases,
                                          const ContactPatch<dim>& patch) {
  std::vector<Vector<dim>> moves;
  if (!body.cycle) return moves;
  const auto carried = [&](const Phase<dim>& phase) {
    return carried_by(body.cycle->motion, body.interface.partner, phase, patch.initial_position);
  };
  for (const Phase<dim>& phase : phases) moves.push_back(carried(phase) - carried(phases.front()));
  return moves;
}

/// How far the partner moves over the phases; without such a motion, what friction shears the
/// contact [length].
template <int dim>
double slip_scale(const Assembly<dim>& body, const std::vector<Phase<dim>>& phases,
                  const Scales& scales) {
  double range = 0;
  for (const ContactPatch<dim>& patch : body.contact_nodes)
    for (const Vector<dim>& moved : moves_of_partner(body, phases, patch))
      range = std::max(range, moved.norm());
  return range > 0 ? range : std::max(body.interface.friction, 1e-3) * scales.displacement;
}

/// Whether the partner moves in a direction over the cycle, at a contact node.
template <int dim>
bool partner_moves(const Assembly<dim>& body, const ContactPatch<dim>& patch, int direction) {
  constexpr double rounding = 1e-9;
  double range = 0, whole = 0;
  for (const Vector<dim>& moved : moves_of_partner(body, body.phases, patch)) {
    range = std::max(range, std::abs(moved[direction]));
    whole = std::max(whole, moved.norm());
  }
  return range > rounding * whole;
}

/// Whether friction at a contact node moves nothing in a direction: the node is held, and so is, of
/// a pair, the node of the master that is opposite, as in a symmetry.
template <int dim>
bool held_on_partner(const Assembly<dim>& body, int node, int direction) {
  if (!body.supports.held(node, direction)) return false;
  const Vector<dim>& X = body.mesh.nodes[static_cast<std::size_t>(node)];
  double nearest = std::numeric_limits<double>::infinity();
  bool held = true;
  for (const MortarPair<dim>& pair : body.pairs) {
    const auto has = [node](const auto& facet) { return std::ranges::count(facet, node) > 0; };
    if (std::ranges::none_of(pair.slave, has)) continue;
    for (const auto& facet : pair.master)
      for (const int other : facet) {
        const Vector<dim> apart = body.mesh.nodes[static_cast<std::size_t>(other)] - X,
                          beside = apart - pair.approach * pair.approach.dot(apart);
        if (beside.norm() >= nearest) continue;
        nearest = beside.norm();
        held = body.supports.held(other, direction);
      }
  }
  return held;
}

/// Of a phase, at the contact nodes.
Block of_friction(const char* name, const char* symbol, std::size_t phase) {
  return {.name = name,
          .symbol = symbol,
          .where = "contact nodes",
          .role = Role::friction,
          .owner = static_cast<int>(phase)};
}

/// Vectors at the contact nodes that carry a multiplier, in a block of their own.
template <int dim>
Field contact_vectors(const Assembly<dim>& body, const Block& own, FieldSet& set) {
  const int block = set.add(own);
  Field field(own.name, contact_nodes(body), dim);
  for (std::size_t c = 0; c < body.carries.size(); ++c)
    field.block.row(static_cast<Eigen::Index>(c)).setConstant(body.carries[c] ? block : -1);
  return field;
}

}  // namespace

template <int dim>
FieldSet WornBodyEquations<dim>::make_fields() {
  const Scales scales = above_rounding(*assembly_);
  FieldSet set;
  set.nodes = static_cast<int>(assembly_->mesh.nodes.size());
  fields_.resize(phases_.size());
  const auto of_phase = [](Block block, std::size_t phase) {
    block.owner = static_cast<int>(phase);
    return block;
  };
  for (std::size_t p = 0; p < phases_.size(); ++p) {
    const int displacement = set.add(of_phase(
        {"displacement", "u", condensation_ ? "contact nodes" : "all nodes", Role::stiffness}, p));
    fields_[p].u = set.add(field_at_nodes<dim>(
        "displacement", condensation_ ? condensation_->left_out() : assembly_->supports.held,
        displacement, scales.force, scales.displacement));
  }
  const bool gap = assembly_->shape.gap;
  const int interior =
      gap ? -1 : set.add({"shape", "d", "nodes off the contact surface", Role::extension});
  const int surface = set.add({.name = "worn_surface",
                               .symbol = "d",
                               .where = "contact nodes (differential)",
                               .role = Role::evolution,
                               .differential = true});
  const FieldId d = set.add(shape_field(*assembly_, scales, gap ? surface : interior, surface));
  for (std::size_t p = 0; p < phases_.size(); ++p) {
    const int multiplier =
        set.add(of_phase({"contact_multiplier", "lambda", "contact nodes", Role::multiplier}, p));
    fields_[p].lambda = set.add(multiplier_field(*assembly_, scales, multiplier));
  }
  for (std::size_t p = 0; p < phases_.size(); ++p) {
    fields_[p].d = d;
    if (!phases_[p].moves_freely()) continue;
    const int rigid = set.add(of_phase({"rigid_motion", "w", "counter-body", Role::rigid}, p));
    const bool creeps = std::ranges::any_of(phases_[p].counter_body.guides, &Guide<dim>::creeps);
    const int creepage =
        creeps ? set.add(of_phase({"creepage", "xi", "counter-body", Role::rigid}, p)) : -1;
    fields_[p].w = set.add(rigid_motion_field(*assembly_, phases_[p], scales, rigid, creepage));
  }
  if (assembly_->interface.sticks || assembly_->interface.rolling) {
    const double slip = slip_scale(*assembly_, phases_, scales);
    add_friction(scales, set);
    if (assembly_->interface.sticks) add_memory(slip, scales, set);
    if (!assembly_->pairs.empty()) add_places(slip, set);
    if (assembly_->interface.rolling && assembly_->interface.rolling->creeps())
      std::tie(fields_.front().creepage, fields_.front().spin) =
          add_creepage(*assembly_, scales, set);
    if (assembly_->interface.rolling)
      fields_.front().mean_power = add_mean_power(*assembly_, scales, set);
  }
  if (assembly_->shape.constraint == ConstraintForm::multiplier) {
    const int reaction = set.add({"shape_multiplier", "mu", "contact nodes", Role::reaction});
    const FieldId mu = set.add(shape_multiplier_field<dim>(
        assembly_->contact_nodes, assembly_->shape.held, scales.auxiliary_force, reaction));
    for (WornBodyFields& fields : fields_) fields.mu = mu;
  }
  return set;
}

/// lambda_T of each phase.
template <int dim>
void WornBodyEquations<dim>::add_friction(const Scales& scales, FieldSet& set) {
  std::vector<std::pair<std::size_t, int>> held;  // contact nodes, and directions
  for (std::size_t c = 0; c < assembly_->contact_nodes.size(); ++c)
    for (int i = 0; i < dim; ++i)
      if (const ContactPatch<dim>& patch = assembly_->contact_nodes[c];
          held_on_partner(*assembly_, patch.node, i) && !partner_moves(*assembly_, patch, i))
        held.emplace_back(c, i);
  for (std::size_t p = 0; p < phases_.size(); ++p) {
    Field traction =
        contact_vectors(*assembly_, of_friction("friction_multiplier", "lambda_T", p), set);
    for (const auto& [c, i] : held) traction.block(static_cast<Eigen::Index>(c), i) = -1;
    traction.row_scale.setConstant(scales.displacement);
    traction.unknown_scale.setConstant(scales.stress);
    fields_[p].traction = set.add(std::move(traction));
  }
}

/// s of a path.
template <int dim>
void WornBodyEquations<dim>::add_memory(double slip, const Scales& scales, FieldSet& set) {
  const bool follows = assembly_->interface.memory_follows;
  Field memory =
      contact_vectors(*assembly_,
                      {.name = "slip_memory",
                       .symbol = "s",
                       .where = follows ? "contact nodes" : "contact nodes (differential)",
                       .role = Role::memory,
                       .differential = !follows,
                       .tolerance_scale = slip / scales.wear_depth},
                      set);
  memory.row_scale.setConstant(slip / assembly_->cycle->motion.cycle.period);
  memory.unknown_scale.setConstant(slip);
  const FieldId s = set.add(std::move(memory));
  for (WornBodyFields& fields : fields_) fields.memory = s;
  if (!follows) return;
  const std::vector<int> nodes = set.fields.back().node;
  memory_before_ = set.add(Field("slip_memory_before", nodes, dim));
  memory_stuck_ = set.add(Field("slip_memory_stuck", nodes, 1));
}

/// r of each phase, of pairs.
template <int dim>
void WornBodyEquations<dim>::add_places(double slip, FieldSet& set) {
  for (std::size_t p = 0; p < phases_.size(); ++p) {
    Field place = contact_vectors(*assembly_, of_friction("place_on_partner", "r", p), set);
    place.row_scale.setConstant(slip);
    place.unknown_scale.setConstant(slip);
    fields_[p].place = set.add(std::move(place));
  }
}

template FieldSet WornBodyEquations<2>::make_fields();
template FieldSet WornBodyEquations<3>::make_fields();

}  // namespace gnomon
