#include "model/resultants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <gnomon/base/processes.hpp>

#include "mesh/facet_table.hpp"
#include "model/connected_parts.hpp"
#include "model/force_places.hpp"

namespace gnomon {
namespace {

/// Of all values of u, also of those that supports hold, or of the latter alone.
template <int dim>
Numbering numbering_of(const WornBodyEquations<dim>& equations, bool held_alone) {
  const auto& composition = *equations.composition();
  auto set = std::make_shared<FieldSet>(*composition.fields);
  for (std::size_t p = 0; p < equations.phases().size(); ++p) {
    Field& u = (*set)[equations.fields(p).u];
    const int block = std::max(u.block.maxCoeff(), 0);
    u.block.setConstant(block);
    if (held_alone)
      u.block = equations.assembly().supports.held.unaryExpr(
          [block](auto held) { return held ? block : -1; });
  }
  return {std::move(set), BlockSelection(composition.fields->blocks.size(), 1)};
}

bool acts_on_bodies(TermKind kind) {
  return kind == TermKind::body || kind == TermKind::load || kind == TermKind::spring;
}

/// From the frames of the bodies to space, in a phase.
template <int dim>
class InSpace {
public:
  /// `body_of`: by node. References must outlive the object.
  InSpace(const std::vector<int>& body_of, const std::vector<BodyPlace<dim>>& places)
      : body_of_(body_of), places_(places) {}
  Vector<dim> force(Eigen::Index node, const Vector<dim>& in_frame) const {
    return places_.empty() ? in_frame : Vector<dim>(of(node).turn * in_frame);
  }
  NodalField<dim> forces(NodalField<dim> nodal) const {
    for (Eigen::Index node = 0; !places_.empty() && node < nodal.rows(); ++node)
      nodal.row(node) = force(node, nodal.row(node).transpose()).transpose();
    return nodal;
  }
  NodalField<dim> points(NodalField<dim> nodal) const {
    for (Eigen::Index node = 0; !places_.empty() && node < nodal.rows(); ++node)
      nodal.row(node) = of(node).of(nodal.row(node).transpose()).transpose();
    return nodal;
  }

private:
  const BodyPlace<dim>& of(Eigen::Index node) const {
    return places_[static_cast<std::size_t>(body_of_[static_cast<std::size_t>(node)])];
  }

  const std::vector<int>& body_of_;
  const std::vector<BodyPlace<dim>>& places_;
};

/// Sums of forces at nodes.
template <int dim>
class NodalSum {
public:
  explicit NodalSum(const Assembly<dim>& assembly) : assembly_(assembly) {}
  void add(ResultantForce& to, double weight, const Vector<dim>& place,
           const Vector<dim>& force) const {
    const bool revolved = assembly_.section() == Section::meridian;
    const std::array<double, 3> x = point_in_space<dim>(place),
                                f = point_in_space<dim>(weight * force);
    for (int i = revolved ? 1 : 0; i < 3; ++i) to.force[i] += f[i];  // hoop stresses: radial ones
    if (revolved || assembly_.copies != 1) return;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      to.torque[i] += x[j] * f[k] - x[k] * f[j];
    }
  }
  void add_all(ResultantForce& to, double weight, const NodalField<dim>& places,
               const NodalField<dim>& forces) const {
    for (Eigen::Index node = 0; node < forces.rows(); ++node)
      add(to, weight, places.row(node).transpose(), forces.row(node).transpose());
  }

private:
  const Assembly<dim>& assembly_;
};

/// By contact node: the pair whose slave it belongs to, or -1.
template <int dim>
std::vector<int> pair_of_slaves(const Assembly<dim>& assembly) {
  std::vector<int> pair_of(assembly.contact_nodes.size(), -1);
  for (std::size_t k = 0; k < assembly.pairs.size(); ++k)
    for (const int node : nodes_of_facets(assembly.pairs[k].slave))
      pair_of[static_cast<std::size_t>(assembly.contact_node(node))] = static_cast<int>(k);
  return pair_of;
}

}  // namespace

template <int dim>
Vector<dim> pressing_force(const Phase<dim>& phase, const LoadHistory& first, double t,
                           double within) {
  Vector<dim> sum = Vector<dim>::Zero();
  const std::vector<std::optional<double>> forces = phase.forces();
  for (std::size_t k = 0; k < forces.size(); ++k) {
    const Guide<dim>& guide = phase.counter_body.guides[k];
    const LoadHistory& history = k == 0 ? first : guide.factors;
    if (forces[k]) sum += *forces[k] * history.factor(t, within) * guide.along;
  }
  return sum;
}

template <int dim>
Resultants<dim>::Resultants(WornBodyEquations<dim> equations)
    : equations_(std::move(equations)),
      all_(numbering_of(equations_, false)),
      held_(numbering_of(equations_, true)),
      body_of_(body_of_nodes(equations_.assembly().mesh, equations_.assembly().body_of)),
      pair_of_(pair_of_slaves(equations_.assembly())),
      undeformed_(undeformed_parts(equations_.assembly())) {
  for (std::size_t k = 0; k < equations_.kinds().size(); ++k) {
    const TermKind kind = equations_.kinds()[k].kind;
    terms_.push_back(acts_on_bodies(kind) ? equations_.composition()->terms[k](of_kind(kind))
                                          : nullptr);
  }
}

/// The rows of u to which terms of a kind, phase and number add, nodes x dim; on the bodies. What
/// the bodies carry themselves, only where supports hold them.
template <int dim>
NodalField<dim> Resultants<dim>::of(const FieldValues<dim>& values, double t,
                                    KindOfTerm wanted) const {
  const Numbering& numbering = of_kind(wanted.kind);
  std::vector<double> F(static_cast<std::size_t>(numbering.all_numbers()));
  const std::vector<double> ydot(F.size());
  const Evaluation<dim> at{.values = values, .ydot = ydot, .t = t, .within = t};
  for (std::size_t k = 0; k < terms_.size(); ++k)
    if (equations_.kinds()[k] == wanted) terms_[k]->add_residual(at, F);
  const Field::Indices& numbers = numbering.numbers(equations_.fields(wanted.phase).u);
  NodalField<dim> force = NodalField<dim>::Zero(numbers.rows(), dim);
  for (Eigen::Index k = 0; k < force.size(); ++k)
    if (numbers.data()[k] >= 0) force.data()[k] = -F[numbers.data()[k]];
  return force;
}

template <int dim>
ForceBalance Resultants<dim>::balance(const FieldValues<dim>& values, double t,
                                      const std::vector<PhaseContact<dim>>& contacts) const {
  const Assembly<dim>& assembly = equations_.assembly();
  const Supports<dim>& held = assembly.supports;
  const NodalSum<dim> sum(assembly);
  ResultantForce loads{"loads"}, supports{"supports"}, springs{"springs"}, pressed{"contact"},
      rubbed{"friction"};
  ForceBalance balance;
  for (const NamedSupport& each : held.named) balance.reactions.push_back({each.name});
  for (const SpringSupport<dim>& each : held.springs) balance.reactions.push_back({each.name});
  std::vector<ResultantForce> pairs;
  for (const MortarPair<dim>& pair : assembly.pairs) {
    std::string name = fmt::format("\"{}\" on \"{}\"", pair.bodies[0], pair.bodies[1]);
    if (std::ranges::count(assembly.pairs, pair.numbers, &MortarPair<dim>::numbers) > 1)
      name += fmt::format(" (pair {})", pairs.size() + 1);
    pairs.push_back({std::move(name)});
  }
  double idle = 0, all = 0;
  for (std::size_t p = 0; p < equations_.phases().size(); ++p) {
    const double weight = assembly.copies * equations_.phases()[p].weight;
    const InSpace<dim> in_space(body_of_, equations_.phases()[p].places);
    const NodalField<dim> places =
        in_space.points(places_of(equations_, values, equations_.fields(p), undeformed_));
    const NodalField<dim> load = of(values, t, {TermKind::load, p});
    NodalField<dim> others = load + of(values, t, {TermKind::body, p});
    sum.add_all(loads, weight, places, in_space.forces(load));
    for (std::size_t k = 0; k < held.springs.size(); ++k) {
      const NodalField<dim> spring = of(values, t, {TermKind::spring, p, k});
      others += spring;
      const NodalField<dim> pull = in_space.forces(spring);
      sum.add_all(springs, weight, places, pull);
      sum.add_all(balance.reactions[held.named.size() + k], weight, places, pull);
    }
    for (std::size_t c = 0; c < contacts[p].nodes.size(); ++c) {
      const ContactNode<dim>& contact = contacts[p].nodes[c];
      const int node = assembly.contact_nodes[c].node;
      const Vector<dim> place = places.row(node).transpose(), force = -contact.force,
                        along = contact.normal * contact.normal.dot(force);
      others.row(node) += force.transpose();
      if (assembly.pairs.empty()) {
        sum.add(pressed, weight, place, along);
        sum.add(rubbed, weight, place, force - along);
      } else if (pair_of_[c] >= 0) {
        sum.add(pairs[static_cast<std::size_t>(pair_of_[c])], weight, place,
                in_space.force(node, contact.own_force));
      }
    }
    const NodalField<dim> carried =
        -(others.array() * held.held.template cast<double>().array()).matrix();
    sum.add_all(supports, weight, places, in_space.forces(carried));
    for (std::size_t k = 0; k < held.named.size(); ++k)
      for (const auto& [node, i] : held.named[k].held)
        sum.add(balance.reactions[k], weight, places.row(node).transpose(),
                in_space.force(node, carried(node, i) * Vector<dim>::Unit(i)));
    all += weight * load.cwiseAbs().sum();
    idle += weight * (load.array().abs() * held.held.template cast<double>().array()).sum();
  }
  balance.forces = {loads, supports, springs};
  if (assembly.pairs.empty()) balance.forces.insert(balance.forces.end(), {pressed, rubbed});
  balance.pairs = std::move(pairs);
  balance.idle_load = all > 0 ? idle / all : 0;
  return balance;
}

template <int dim>
std::vector<Scalar> force_columns(const Assembly<dim>& assembly, const ForceBalance& balance) {
  std::vector<Scalar> columns;
  if (assembly.copies != 1) return columns;
  const bool revolved = assembly.section() == Section::meridian;
  const char* const force_unit = dim == 3 || revolved ? "N" : "N/mm";
  const auto add = [&](const ResultantForce& each) {
    for (int i = revolved ? 1 : 0; i < dim; ++i)
      columns.push_back({fmt::format("force_{}_{}", each.name, revolved ? 'z' : "xyz"[i]),
                         force_unit, sum_over_processes(each.force[i])});
    for (int i = dim == 2 ? 2 : 0; i < 3 && !revolved; ++i)
      columns.push_back({fmt::format("torque_{}_{}", each.name, "xyz"[i]), dim == 3 ? "N mm" : "N",
                         sum_over_processes(each.torque[i])});
  };
  const auto has = [&](const std::string& name) {
    if (name == "loads") return !assembly.loads.empty() || !assembly.swinging_loads.empty();
    if (name == "supports") return assembly.supports.named.empty();
    return name == "contact" || (name == "friction" && assembly.interface.friction != 0);
  };
  for (const ResultantForce& each : balance.forces)
    if (has(each.name)) add(each);
  for (const ResultantForce& each : balance.reactions) add(each);
  return columns;
}

template Vector<2> pressing_force(const Phase<2>&, const LoadHistory&, double, double);
template Vector<3> pressing_force(const Phase<3>&, const LoadHistory&, double, double);
template class Resultants<2>;
template class Resultants<3>;
template std::vector<Scalar> force_columns(const Assembly<2>&, const ForceBalance&);
template std::vector<Scalar> force_columns(const Assembly<3>&, const ForceBalance&);

}  // namespace gnomon
