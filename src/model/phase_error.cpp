#include "model/phase_error.hpp"

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/base/processes.hpp>
#include <gnomon/model/wear_model.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <limits>
#include <span>

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

}  // namespace

template <int dim>
FixedShape<dim>::FixedShape(std::shared_ptr<const WornBody<dim>> body)
    : body_(std::move(body)),
      d_(NodalField<dim>::Zero(static_cast<Eigen::Index>(body_->mesh.nodes.size()), dim)) {}

template <int dim>
FixedShape<dim>::FixedShape(double t, const WornBodyEquations<dim>& equations,
                            const FieldValues<dim>& values,
                            const std::vector<PhaseContact<dim>>& contacts)
    : body_(equations.shared_body()), t_(t), d_(values.vector(equations.fields().d)) {
  for (std::size_t p = 0; p < contacts.size(); ++p)
    keep(equations.phases()[p], equations.fields(p), values, contacts[p].nodes);
}

template <int dim>
void FixedShape<dim>::keep(const Phase<dim>& phase, const WornBodyFields& fields,
                           const FieldValues<dim>& values,
                           const std::vector<ContactNode<dim>>& nodes) {
  Known known{phase.position,
              values.vector(fields.u),
              values.scalar(fields.lambda),
              phase.force ? values.scalar(fields.w)[0] : 0,
              {}};
  areas_.clear();
  for (const ContactNode<dim>& node : nodes) {
    known.rate.push_back(node.wear_rate);
    areas_.push_back(node.area);  // those of the shape, the same in all phases
  }
  known_.push_back(std::move(known));
}

template <int dim>
auto FixedShape<dim>::nearest(double position) const -> const Known& {
  return *std::ranges::min_element(
      known_, {}, [&](const Known& known) { return distance(known.position, position); });
}

template <int dim>
bool FixedShape<dim>::is_known(double position) const {
  constexpr double rounding = 1e-12;
  return std::ranges::any_of(
      known_, [&](const Known& known) { return distance(known.position, position) < rounding; });
}

/// From the guess, or by a load ramp where that fails.
template <int dim>
void FixedShape<dim>::find_deformation(const WornBodyEquations<dim>& equations,
                                       ComposedSystem<dim>& deformation,
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

template <int dim>
void FixedShape<dim>::solve(const std::vector<Phase<dim>>& phases) {
  const WornBodyEquations<dim> equations(body_, phases);
  ComposedSystem<dim> deformation(equations.composition(), equations.deformation());
  FieldValues<dim> values(*equations.composition()->fields);
  values.vector(equations.fields().d) = d_;
  deformation.freeze(values, t_);
  for (std::size_t p = 0; p < phases.size() && !known_.empty(); ++p) {
    const Known& guess = nearest(phases[p].position);
    const WornBodyFields& fields = equations.fields(p);
    values.vector(fields.u) = guess.u;
    values.scalar(fields.lambda) = guess.lambda;
    if (phases[p].force) values.scalar(fields.w)[0] = guess.w;
  }
  std::vector<double> y(static_cast<std::size_t>(deformation.structure().size));
  deformation.numbering().gather(values, y);
  find_deformation(equations, deformation, y);
  values = deformation.values(t_, y);
  for (std::size_t p = 0; p < phases.size(); ++p)
    keep(phases[p], equations.fields(p), values,
         equations.contact_nodes(deformation, values, {.t = t_, .y = y}, p));
}

template <int dim>
std::vector<double> FixedShape<dim>::mean_rate(const std::vector<Phase<dim>>& phases) {
  std::vector<Phase<dim>> unknown;
  for (const Phase<dim>& phase : phases)
    if (!is_known(phase.position)) unknown.push_back(phase);
  const std::size_t at_a_time = std::max(body_->cycle.size(), (phases.size() + 1) / 2);
  for (std::size_t first = 0; first < unknown.size(); first += at_a_time) {
    const std::size_t count = std::min(at_a_time, unknown.size() - first);
    const auto begin = unknown.begin() + static_cast<std::ptrdiff_t>(first);
    solve({begin, begin + static_cast<std::ptrdiff_t>(count)});
  }
  std::vector<double> mean(body_->contact_nodes.size(), 0.0);
  for (const Phase<dim>& phase : phases) {
    const Known& known = nearest(phase.position);
    for (std::size_t c = 0; c < mean.size(); ++c) mean[c] += phase.weight * known.rate[c];
  }
  return mean;
}

std::optional<double> relative_difference(const std::vector<double>& areas,
                                          const std::vector<double>& coarse,
                                          const std::vector<double>& fine) {
  double difference = 0, whole = 0;
  for (std::size_t c = 0; c < areas.size(); ++c) {
    difference += areas[c] * std::abs(coarse[c] - fine[c]);
    whole += areas[c] * std::abs(fine[c]);
  }
  difference = sum_over_processes(difference), whole = sum_over_processes(whole);
  return whole > 0 ? std::optional(difference / whole) : std::nullopt;
}

template <int dim>
PhaseError choose_phases(std::shared_ptr<const WornBody<dim>> body, double tolerance, long most) {
  FixedShape<dim> shape(body);
  PhaseError chosen{0, static_cast<long>(body->cycle.size()),
                    std::numeric_limits<double>::infinity()};
  std::vector<double> coarse = shape.mean_rate(body->cycle);
  for (int refinement = 2; chosen.phases < most; refinement *= 2) {
    const std::vector<double> fine = shape.mean_rate(body->refined_cycle(*body, refinement));
    // Where nothing wears, the phases may all have missed the contact.
    if (const auto error = relative_difference(shape.areas(), coarse, fine);
        error && *error <= tolerance)
      return {0, chosen.phases, *error};
    chosen.phases *= 2;
    coarse = fine;
  }
  return chosen;
}

template <int dim>
std::optional<PhaseError> WearModel<dim>::phase_error(const State& state) const {
  if (!body().refined_cycle) return {};
  const FieldValues<dim> values = system_.values(state.t, state.y);
  FixedShape<dim> shape(state.t, equations_, values, contacts(values, state));
  const std::vector<double> coarse = shape.mean_rate(body().cycle);
  const std::vector<double> fine = shape.mean_rate(body().refined_cycle(body(), 2));
  const auto error = relative_difference(shape.areas(), coarse, fine);
  if (!error) return {};
  return PhaseError{state.t, phases(), *error};
}

template class FixedShape<2>;
template class FixedShape<3>;
template PhaseError choose_phases(std::shared_ptr<const WornBody<2>>, double, long);
template PhaseError choose_phases(std::shared_ptr<const WornBody<3>>, double, long);
template std::optional<PhaseError> WearModel<2>::phase_error(const State&) const;
template std::optional<PhaseError> WearModel<3>::phase_error(const State&) const;

}  // namespace gnomon
