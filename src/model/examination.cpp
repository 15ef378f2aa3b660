#include <algorithm>
#include <gnomon/model/examination.hpp>
#include <gnomon/model/wear_model.hpp>
#include <gnomon/terms/loads.hpp>
#include <limits>
#include <set>

namespace gnomon {

namespace {

template <int dim>
std::array<double, 3> array_of(const Vector<dim>& v) {
  std::array<double, 3> result{};
  std::copy(v.begin(), v.end(), result.begin());
  return result;
}

/// The rows of u of every node, also of those that supports hold: what they carry.
template <int dim>
std::shared_ptr<FieldSet> without_supports(const WornBodyEquations<dim>& equations) {
  auto set = std::make_shared<FieldSet>(*equations.composition()->fields);
  for (std::size_t p = 0; p < equations.phases().size(); ++p) {
    Field& u = (*set)[equations.fields(p).u];
    const int block = u.block.maxCoeff();
    u.block.setConstant(std::max(block, 0));
  }
  return set;
}

template <int dim>
class Resultants {
public:
  Resultants(const WornBodyEquations<dim>& equations, const FieldValues<dim>& values, double t)
      : equations_(equations),
        values_(values),
        t_(t),
        numbering_(without_supports(equations),
                   BlockSelection(equations.composition()->fields->blocks.size(), 1)) {}

  /// The rows of u to which the terms of a kind add, nodes x dim, in a phase; on the bodies.
  NodalField<dim> of(TermKind kind, std::size_t phase) const {
    std::vector<double> F(static_cast<std::size_t>(numbering_.size()));
    const std::vector<double> ydot(F.size());
    for (std::size_t k = 0; k < equations_.kinds().size(); ++k) {
      const KindOfTerm& each = equations_.kinds()[k];
      if (each.kind != kind || each.phase != phase) continue;
      Evaluation<dim> at{.values = values_, .ydot = ydot, .t = t_, .within = t_};
      equations_.composition()->terms[k](numbering_)->add_residual(at, F);
    }
    const Field::Indices& numbers = numbering_.numbers(equations_.fields(phase).u);
    NodalField<dim> force(numbers.rows(), dim);
    for (Eigen::Index k = 0; k < force.size(); ++k) force.data()[k] = -F[numbers.data()[k]];
    return force;
  }

private:
  const WornBodyEquations<dim>& equations_;
  const FieldValues<dim>& values_;
  double t_;
  Numbering numbering_;
};

/// Forces on the bodies, means over the phases, and how much of the loads does nothing.
template <int dim>
void add_forces(const WornBodyEquations<dim>& equations, const FieldValues<dim>& values, double t,
                const std::vector<PhaseContact<dim>>& contacts, Examination& facts) {
  const Assembly<dim>& assembly = equations.assembly();
  const Resultants<dim> resultants(equations, values, t);
  Vector<dim> loads = Vector<dim>::Zero(), springs = loads, supports = loads, pressed = loads,
              rubbed = loads;
  double idle = 0, all = 0;
  for (std::size_t p = 0; p < equations.phases().size(); ++p) {
    const double weight = assembly.copies * equations.phases()[p].weight;
    const NodalField<dim> load = resultants.of(TermKind::load, p),
                          spring = resultants.of(TermKind::spring, p),
                          inner = resultants.of(TermKind::body, p);
    loads += weight * load.colwise().sum().transpose();
    springs += weight * spring.colwise().sum().transpose();
    NodalField<dim> contact = NodalField<dim>::Zero(load.rows(), dim);
    for (std::size_t c = 0; c < contacts[p].nodes.size(); ++c) {
      const ContactNode<dim>& node = contacts[p].nodes[c];
      const Vector<dim> force = -node.force, along = node.normal * node.normal.dot(force);
      contact.row(assembly.contact_nodes[c].node) += force.transpose();
      pressed += weight * along;
      rubbed += weight * (force - along);
    }
    for (Eigen::Index node = 0; node < load.rows(); ++node)
      for (int i = 0; i < dim; ++i) {
        all += weight * std::abs(load(node, i));
        if (!assembly.supports.held(node, i)) continue;
        idle += weight * std::abs(load(node, i));
        supports[i] -=
            weight * (load(node, i) + spring(node, i) + inner(node, i) + contact(node, i));
      }
  }
  if (assembly.section() == Section::meridian)  // hoop stresses balance radial forces
    for (Vector<dim>* each : {&loads, &supports, &springs, &pressed, &rubbed}) (*each)[0] = 0;
  facts.forces = {{"loads", array_of<dim>(loads)},
                  {"supports", array_of<dim>(supports)},
                  {"springs", array_of<dim>(springs)},
                  {"contact", array_of<dim>(pressed)},
                  {"friction", array_of<dim>(rubbed)}};
  facts.idle_load = all > 0 ? idle / all : 0;
}

/// The deepest node of the boundary without contact inside the counter-body, in any phase.
template <int dim>
std::optional<BoundaryPoint> find_intrusion(const WornBodyEquations<dim>& equations,
                                            const FieldValues<dim>& values, double t) {
  const Assembly<dim>& assembly = equations.assembly();
  std::set<int> nodes;
  for (const auto& facet : assembly.interface.boundary) nodes.insert(facet.begin(), facet.end());
  for (const ContactPatch<dim>& patch : assembly.contact_nodes) nodes.erase(patch.node);
  std::optional<BoundaryPoint> deepest;
  for (std::size_t p = 0; p < equations.phases().size(); ++p) {
    const WornBodyFields& fields = equations.fields(p);
    const CounterBody<dim>& other = equations.phases()[p].counter_body;
    PartnerMotion<> q = other.given(t, t);
    if (fields.w != FieldId::none) q += values.scalar(fields.w);
    for (const int node : nodes) {
      const Vector<dim> x = assembly.mesh.nodes[node] +
                            values.vector(fields.d).row(node).transpose() +
                            values.vector(fields.u).row(node).transpose();
      const SignedDistance<dim> distance = other.unchecked_distance(x, q, t);
      if (distance.gap < -(deepest ? deepest->depth : 0))
        deepest = BoundaryPoint{array_of<dim>(assembly.mesh.nodes[node]), -distance.gap};
    }
  }
  return deepest;
}

/// From one end of the cycle's sliding to the other; absent where it does not come back.
template <int dim>
std::optional<double> stroke_of(const std::vector<Phase<dim>>& phases, double period) {
  constexpr double rounding = 1e-6;
  using Place = Eigen::Matrix<double, dim + 1, 1>;
  Place at = Place::Zero(), low = at, high = at;
  double path = 0;
  for (const Phase<dim>& phase : phases) {
    const Place step = phase.weight * period * sliding_velocity(phase);
    at += step;
    path += step.norm();
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  if (path == 0 || at.norm() > rounding * path) return {};
  return (high - low).norm();
}

template <int dim>
bool touches(const PhaseContact<dim>& phase) {
  return std::ranges::any_of(phase.nodes, &ContactNode<dim>::active);
}

template <int dim>
std::optional<ElasticDrag> find_drag(const WornBodyEquations<dim>& equations,
                                     const FieldValues<dim>& values,
                                     const std::vector<PhaseContact<dim>>& contacts) {
  const Assembly<dim>& assembly = equations.assembly();
  if (!assembly.cycle || assembly.interface.friction == 0) return {};
  const auto stroke = stroke_of(equations.phases(), assembly.cycle->motion.cycle.period);
  if (!stroke) return {};
  ElasticDrag found{.stroke = *stroke};
  for (std::size_t c = 0; c < assembly.contact_nodes.size(); ++c) {
    Vector<dim> low = Vector<dim>::Constant(std::numeric_limits<double>::infinity()), high = -low;
    bool active = false;
    for (std::size_t p = 0; p < contacts.size(); ++p) {
      if (!touches<dim>(contacts[p])) continue;
      const ContactNode<dim>& node = contacts[p].nodes[c];
      active = active || node.active;
      const Vector<dim> u =
          values.vector(equations.fields(p).u).row(assembly.contact_nodes[c].node).transpose();
      const Vector<dim> along = u - node.normal * node.normal.dot(u);
      low = low.cwiseMin(along);
      high = high.cwiseMax(along);
    }
    if (active) found.drag = std::max(found.drag, (high - low).norm());
  }
  return found;
}

}  // namespace

template <int dim>
Examination WearModel<dim>::examine(const State& state) const {
  const FieldValues<dim> values = system().values(state.t, state.y);
  const std::vector<PhaseContact<dim>> contacts = this->contacts(values, state);
  Examination facts;
  add_forces(equations_, values, state.t, contacts, facts);
  facts.intrusion = find_intrusion(equations_, values, state.t);
  facts.drag = find_drag(equations_, values, contacts);
  facts.deformation = assembly().scales.displacement;
  facts.touches = std::ranges::any_of(contacts, touches<dim>);
  return facts;
}

template Examination WearModel<2>::examine(const State&) const;
template Examination WearModel<3>::examine(const State&) const;

}  // namespace gnomon
