#include "model/phase_start.hpp"

#include <algorithm>
#include <gnomon/newton/algebraic_solver.hpp>
#include <utility>

#include "model/near_facets.hpp"

namespace gnomon {

template <int dim>
std::shared_ptr<const Assembly<dim>> with_friction(const Assembly<dim>& body, double part) {
  AssemblyParts<dim> parts = body;
  parts.interface.friction *= part;
  for (MortarPair<dim>& pair : parts.pairs) pair.friction *= part;
  return std::make_shared<const Assembly<dim>>(std::move(parts));
}

template <int dim>
std::vector<Vector<dim>> PhaseStart<dim>::positions(const FieldValues<dim>& of) const {
  const WornBodyFields& fields = alone_.fields();
  return deformed(alone_.assembly().mesh, of.vector(fields.d), of.vector(fields.u));
}

/// To where nothing loads the bodies, at the same shape.
template <int dim>
void PhaseStart<dim>::lift() {
  FieldValues<dim> unloaded(*alone_.composition()->fields);
  const FieldId d = alone_.fields().d;
  unloaded.vector(d) = values_.vector(d);
  values_ = std::move(unloaded);
}

/// Ends on the way where bodies leave the facets that were found: increments would fail beyond.
template <int dim>
RampReport PhaseStart<dim>::ramp() {
  const Assembly<dim>& body = alone_.assembly();
  ComposedSystem<dim> contact(alone_.composition(), alone_.without_creepage());
  contact.freeze(values_, t_);
  RampOptions options = ramp_options(body);
  if (!body.pairs.empty())
    options.strays = [&](std::span<const double> y, double part) {
      return part < 1 && have_strayed(body, phase(), positions(contact.values(t_, y)), part);
    };
  return find_equilibrium(alone_, contact, options, values_, counters_);
}

/// With the facets that bodies have come to, again and again, by Newton's method alone. Whether
/// this ends.
template <int dim>
bool PhaseStart<dim>::settles(Body body) {
  constexpr int most = 10;
  for (int k = 0; k < most; ++k) {
    body = with_facets_near(*body, phase(), positions(values_));
    const WornBodyEquations<dim> near(body, {phase()});
    ComposedSystem<dim> contact(near.composition(), near.without_creepage());
    contact.freeze(values_, t_);
    std::vector<double> y(contact.structure().size);
    contact.numbering().gather(values_, y);
    NewtonSolver newton(contact.structure(), counters_, {.max_iterations = 30});
    if (!newton.solve(algebraic_function(contact), y).converged) return false;
    contact.numbering().scatter(y, values_);
    if (flies_away(near, values_)) return false;
    if (!have_strayed(*body, phase(), positions(values_), 1)) return true;
  }
  return false;
}

template <int dim>
RampReport PhaseStart<dim>::ramp_by_facets(Body body) {
  lift();
  RampOptions options = ramp_options(*body);
  for (;;) {
    const WornBodyEquations<dim> near(body, {phase()});
    ComposedSystem<dim> contact(near.composition(), near.without_creepage());
    contact.freeze(values_, t_);
    options.strays = [&](std::span<const double> y, double part) {
      return have_strayed(*body, phase(), positions(contact.values(t_, y)), part);
    };
    RampReport report = find_equilibrium(near, contact, options, values_, counters_);
    options.most -= report.increments + report.failures;
    if (report.reached == 1 || report.increments == 0 || options.most <= 0) return report;
    options.begin = report.reached;
    body = with_facets_near(*body, phase(), positions(values_));
  }
}

template <int dim>
bool PhaseStart<dim>::friction_grows() {
  constexpr double largest = 0.25, smallest = 0.01;
  const Assembly<dim>& whole = alone_.assembly();
  if (ramp_by_facets(with_friction(whole, 0)).reached < 1) return false;
  double reached = 0, step = largest;
  while (reached < 1) {
    const double target = std::min(1.0, reached + step);
    const FieldValues<dim> before = values_;
    if (settles(with_friction(whole, target))) {
      reached = target;
      continue;
    }
    values_ = before;
    step /= 2;
    if (step < smallest) return false;
  }
  return true;
}

template <int dim>
RampReport PhaseStart<dim>::find() {
  const Assembly<dim>& body = alone_.assembly();
  RampReport at_once = ramp();
  if (body.pairs.empty()) return at_once;
  if (at_once.reached == 1 &&
      (!have_strayed(body, phase(), positions(values_), 1) || settles(alone_.shared_assembly())))
    return at_once;
  RampReport by_facets = ramp_by_facets(alone_.shared_assembly());
  const bool rubs =
      std::ranges::any_of(body.pairs, [](const auto& pair) { return pair.friction > 0; });
  if (by_facets.reached < 1 && rubs && friction_grows()) return {.reached = 1};
  return by_facets;
}

template std::shared_ptr<const Assembly<2>> with_friction(const Assembly<2>&, double);
template std::shared_ptr<const Assembly<3>> with_friction(const Assembly<3>&, double);
template class PhaseStart<2>;
template class PhaseStart<3>;

}  // namespace gnomon
