#include "model/phase_error.hpp"

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/base/processes.hpp>
#include <gnomon/cycles/compared_rates.hpp>
#include <gnomon/model/wear_model.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <limits>

#include "model/halved_path.hpp"
#include "model/wear_start.hpp"

namespace gnomon {

namespace {

/// Around the cycle.
double distance(double a, double b) {
  const double apart = std::abs(a - b);
  return std::min(apart, 1 - apart);
}

/// Forces to six digits are enough for an estimate of an error.
constexpr NewtonOptions rough_newton{
    .tolerance = 1e-6, .acceptable = 1e-5, .max_iterations = 60, .keep_factors = true};

/// The deformation of a body in any phases of its cycle, at a fixed shape and time. What is known
/// of some phases gives the first guesses for others.
template <int dim>
class FixedShape {
public:
  /// The unworn shape at t = 0.
  explicit FixedShape(std::shared_ptr<const Assembly<dim>> body)
      : body_(std::move(body)),
        d_(NodalField<dim>::Zero(static_cast<Eigen::Index>(body_->mesh.nodes.size()), dim)) {}
  /// The shape and time of a state, whose phases are known: its values, and contact in each phase.
  FixedShape(double t, const WornBodyEquations<dim>& equations, const FieldValues<dim>& values,
             const std::vector<PhaseContact<dim>>& contacts)
      : body_(equations.shared_assembly()), t_(t), d_(values.vector(equations.fields().d)) {
    for (std::size_t p = 0; p < contacts.size(); ++p)
      keep(equations.phases()[p], equations.fields(p), values, contacts[p].nodes);
  }

  /// Mean wear rate over the phases at every contact node [length / time]. Throws SolutionError.
  std::vector<double> mean_rate(const std::vector<Phase<dim>>& phases) {
    for (const Phase<dim>& phase : phases)
      if (!is_known(phase.position)) solve(phase);
    std::vector<double> mean(body_->contact_nodes.size(), 0.0);
    for (const Phase<dim>& phase : phases) {
      const Known& known = nearest(phase.position);
      for (std::size_t c = 0; c < mean.size(); ++c) mean[c] += phase.weight * known.rate[c];
    }
    return mean;
  }

  /// A part of its volume: of every contact node, known after mean_rate() [length^(dim - 1)].
  const std::vector<double>& areas() const { return areas_; }

private:
  struct Known {
    double position;
    NodalField<dim> u;
    Eigen::VectorXd lambda;
    Eigen::VectorXd w;
    std::vector<double> rate;  // of wear, at every contact node
  };
  void solve(const Phase<dim>& phase) {
    const WornBodyEquations<dim> equations(body_, {phase});
    const WornBodyFields& fields = equations.fields();
    ComposedSystem<dim> deformation(equations.composition(), equations.deformation());
    FieldValues<dim> values(*equations.composition()->fields);
    values.vector(fields.d) = d_;
    deformation.freeze(values, t_);
    if (!known_.empty()) {
      const Known& guess = nearest(phase.position);
      values.vector(fields.u) = guess.u;
      values.scalar(fields.lambda) = guess.lambda;
      if (fields.w != FieldId::none) values.scalar(fields.w) = guess.w;
    }
    std::vector<double> y(static_cast<std::size_t>(deformation.structure().size));
    deformation.numbering().gather(values, y);
    find_deformation(equations, deformation, y);
    values = deformation.values(t_, y);
    keep(phase, fields, values, equations.contact_nodes(deformation, values, {.t = t_, .y = y}));
  }

  /// From the guess, or by a load ramp where that fails.
  void find_deformation(const WornBodyEquations<dim>& equations, ComposedSystem<dim>& deformation,
                        std::vector<double>& y) const {
    Counters counters;
    if (!known_.empty()) {
      NewtonSolver newton(deformation.structure(), counters, rough_newton);
      std::vector<double> guessed = y;
      if (newton.solve(algebraic_function(deformation), guessed).converged) {
        y = guessed;
        return;
      }
    }
    FieldValues<dim> values(*equations.composition()->fields);
    values.vector(equations.fields().d) = d_;
    const RampReport ramp =
        find_equilibrium(equations, deformation, ramp_options(*body_), values, counters);
    if (ramp.reached < 1) throw SolutionError(ramp.reason);
    deformation.numbering().gather(values, y);
  }

  void keep(const Phase<dim>& phase, const WornBodyFields& fields, const FieldValues<dim>& values,
            const std::vector<ContactNode<dim>>& nodes) {
    Known known{
        phase.position,
        values.vector(fields.u),
        values.scalar(fields.lambda),
        fields.w == FieldId::none ? Eigen::VectorXd() : Eigen::VectorXd(values.scalar(fields.w)),
        {}};
    areas_.clear();
    for (const ContactNode<dim>& node : nodes) {
      known.rate.push_back(node.wear_rate);
      areas_.push_back(node.area);  // those of the shape, the same in all phases
    }
    known_.push_back(std::move(known));
  }

  const Known& nearest(double position) const {
    return *std::ranges::min_element(
        known_, {}, [&](const Known& known) { return distance(known.position, position); });
  }
  bool is_known(double position) const {
    constexpr double rounding = 1e-12;
    return std::ranges::any_of(
        known_, [&](const Known& known) { return distance(known.position, position) < rounding; });
  }

  std::shared_ptr<const Assembly<dim>> body_;
  double t_ = 0;
  NodalField<dim> d_;
  std::vector<Known> known_;
  std::vector<double> areas_;
};

}  // namespace

template <int dim>
double error_of_motion(const std::vector<Phase<dim>>& phases, const std::vector<Phase<dim>>& fine) {
  const auto speed = [](const Phase<dim>& phase) {
    return phase.counter_body.motion.nominal_speed(Vector<dim>::Zero());
  };
  return std::max({error_of_mean(phases, fine, speed),
                   error_of_mean(phases, fine,
                                 [&](const Phase<dim>& phase) {
                                   return phase.force.value_or(0) * speed(phase);
                                 }),
                   error_of_mean(phases, fine, [&](const Phase<dim>& phase) {
                     return phase.load * speed(phase);
                   })});
}

template <int dim>
ChosenPhases choose_phases(std::shared_ptr<const Assembly<dim>> body, double tolerance) {
  using enum PhaseSet::Kind;
  const auto set = [&](PhaseSet::Kind kind, int times) {
    return phases_of(*body->cycle, body->interface.partner, body->interface.force, {kind, times});
  };
  const std::vector<Phase<dim>> instants = set(fine, 1);
  const auto error = [&](int times) {
    const std::vector<Phase<dim>> phases = set(own, times);
    const double of_motion = error_of_motion(phases, instants);
    if (of_motion > tolerance) return of_motion;
    FixedShape<dim> shape(body);
    const std::vector<double> mean = shape.mean_rate(phases);
    const auto [difference, whole] =
        compare_rates(shape.areas(), mean, shape.mean_rate(set(comparison, times)));
    // Where nothing wears, the phases may all have missed the contact.
    if (!(whole > 0)) return std::numeric_limits<double>::infinity();
    return std::max(of_motion, difference / whole);
  };
  return choose_phases(
      tolerance, [&](int times) { return static_cast<long>(set(own, times).size()); }, error);
}

namespace {

template <int dim>
std::vector<double> areas_of(const PhaseContact<dim>& phase) {
  std::vector<double> areas;
  for (const ContactNode<dim>& node : phase.nodes) areas.push_back(node.area);
  return areas;
}

template <int dim>
std::vector<double> mean_rate(const std::vector<PhaseContact<dim>>& phases) {
  std::vector<double> mean(phases.front().nodes.size(), 0.0);
  for (const auto& [weight, nodes] : phases)
    for (std::size_t c = 0; c < nodes.size(); ++c) mean[c] += weight * nodes[c].wear_rate;
  return mean;
}

}  // namespace

template <int dim>
std::optional<PhaseError> WearModel<dim>::phase_error(const State& state) const {
  const Assembly<dim>& body = assembly();
  using enum PhaseSet::Kind;
  const FieldValues<dim> values = system().values(state.t, state.y);
  const std::vector<PhaseContact<dim>> contacts = this->contacts(values, state);
  const auto set = [&](PhaseSet::Kind kind) {
    return phases_of(*body.cycle, body.interface.partner, body.interface.force, {kind});
  };
  const std::vector<double> areas = areas_of<dim>(contacts.front());
  RateDifference rates;
  if (body.interface.sticks) {
    rates = compare_rates(areas, mean_rate(contacts),
                          mean_rate(contacts_of_halves(equations_, values, state.t, rough_newton)));
  } else {
    FixedShape<dim> shape(state.t, equations_, values, contacts);
    const std::vector<double> mean = shape.mean_rate(body.phases);
    rates = compare_rates(areas, mean, shape.mean_rate(set(comparison)));
  }
  auto [difference, whole] = rates;
  // Bodies that hardly touch any more: what is lost is then small beside what is worn already.
  if (state.t > 0)
    whole = std::max(whole, *value_of(observe(state), "worn_volume") / (body.copies * state.t));
  constexpr double rounding = 1e-12;  // of a length that occurs: what nothing wears
  const double area = sum_over_processes(std::reduce(areas.begin(), areas.end()));
  if (!(whole * body.scales.duration > rounding * body.scales.displacement * area)) return {};
  const double of_motion = body.interface.sticks ? 0 : error_of_motion(body.phases, set(fine));
  return PhaseError{state.t, static_cast<long>(body.phases.size()),
                    std::max(of_motion, difference / whole)};
}

template double error_of_motion(const std::vector<Phase<2>>&, const std::vector<Phase<2>>&);
template double error_of_motion(const std::vector<Phase<3>>&, const std::vector<Phase<3>>&);
template ChosenPhases choose_phases(std::shared_ptr<const Assembly<2>>, double);
template ChosenPhases choose_phases(std::shared_ptr<const Assembly<3>>, double);
template std::optional<PhaseError> WearModel<2>::phase_error(const State&) const;
template std::optional<PhaseError> WearModel<3>::phase_error(const State&) const;

}  // namespace gnomon
