// Consistent start of a worn body: equilibrium at the initial shape by a load ramp.

#include "model/wear_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/stepper.hpp>
#include <gnomon/model/wear_model.hpp>
#include <gnomon/newton/algebraic_solver.hpp>
#include <limits>
#include <optional>

namespace gnomon {

namespace {

/// A successful attempt needs 3 to 9 iterations.
constexpr int max_iterations = 15;
/// Tolerance of equilibria on the way to the whole load, relative to the first load that is tried.
constexpr double rough_tolerance = 1e-3;

/// Moves body and counter-body together, or apart, until they touch at a point, so that the first
/// matrix is not singular: moves the counter-body if it is free, otherwise the body. A counter-body
/// that passes by in a phase leaves the body as it is.
template <int dim>
void close_initial_gap(const WornBodyEquations<dim>& equations, std::size_t phase,
                       FieldValues<dim>& values) {
  const Assembly<dim>& body = equations.assembly();
  const CounterBody<dim>& other = equations.phases()[phase].counter_body;
  if (other.travel) return;
  const NodalField<dim>& d = values.vector(equations.fields().d);
  double least = std::numeric_limits<double>::infinity();
  for (const auto& patch : body.contact_nodes)
    least = std::min(least,
                     other.travel_to(body.mesh.nodes[patch.node] + d.row(patch.node).transpose()));
  if (!std::isfinite(least)) return;
  if (equations.phases()[phase].force) {
    values.scalar(equations.fields(phase).w)[0] = least;
    return;
  }
  NodalField<dim>& u = values.vector(equations.fields(phase).u);
  for (Eigen::Index node = 0; node < u.rows(); ++node)
    for (int i = 0; i < dim; ++i)
      if (!body.supports.held(node, i)) u(node, i) = -least * other.approach[i];
}

/// The approximate approach of a counter-body under part of its force: proportional to F^(2/3), as
/// for a ball (Hertz). From there Newton's method begins with several active nodes. With a single
/// active node it would invert the elements at that node, and the more easily the finer they are.
template <int dim>
double indentation(const Assembly<dim>& body, double fraction) {
  return body.scales.displacement * std::cbrt(fraction * fraction);
}

}  // namespace

template <int dim>
RampOptions ramp_options(const Assembly<dim>& body) {
  RampOptions options;
  for (const Body& each : body.bodies) {
    const ElasticModuli& law = each.material.moduli;
    const double whole_strain = body.scales.stress / law.young_modulus();
    const double strain = 3 * law.mu / (law.lambda + law.mu);
    if (strain < whole_strain) options.first = std::min(options.first, strain / whole_strain);
  }
  options.smallest *= options.first;
  return options;
}

template <int dim>
RampReport find_equilibrium(const WornBodyEquations<dim>& equations, ComposedSystem<dim>& contact,
                            const RampOptions& options, FieldValues<dim>& values,
                            Counters& counters) {
  // One solver at a time, because each holds factors. Most ramps reach the whole load at once and
  // need only the exact solver.
  std::optional<NewtonSolver> solver;
  bool exact = false;
  const NonlinearFunction function = algebraic_function(contact);
  struct Approach {
    int w;            // number of the unknown
    double touching;  // its value
  };
  std::vector<Approach> approaches;
  for (std::size_t p = 0; p < equations.phases().size(); ++p) {
    close_initial_gap(equations, p, values);
    const FieldId field = equations.fields(p).w;
    if (const int w = contact.numbering().number(field, 0); w >= 0)
      approaches.push_back({w, values.scalar(field)[0]});
  }
  bool loaded = false;
  const LoadSolve solve = [&](double fraction, std::span<double> y) {
    contact.set_load_fraction(fraction);
    if (!loaded)
      for (const Approach& at : approaches)
        y[at.w] = at.touching + indentation(equations.assembly(), fraction);
    if (!solver || exact != (fraction == 1)) {
      exact = fraction == 1;
      NewtonOptions newton{.max_iterations = max_iterations};
      if (exact) {  // where contact no longer changes, the last decades need no new factors
        newton.keep_factors = true;
        newton.max_iterations *= 2;  // as in modified_newton
      } else {
        newton.tolerance = rough_tolerance * options.first;
      }
      solver.reset();
      solver.emplace(contact.structure(), counters, newton);
    }
    const NewtonReport report = solver->solve(function, y);
    loaded = loaded || report.converged;
    return report;
  };
  std::vector<double> y(contact.structure().size);
  contact.numbering().gather(values, y);
  const RampReport report = ramp_load(solve, options, y);
  contact.numbering().scatter(y, values);
  return report;
}

namespace {

/// A part of the load has an equilibrium, so that the body is sound and the load too large for it;
/// or none has.
std::string failure_of(const RampReport& ramp, const Element& element) {
  const char* technology = technology_names[static_cast<std::size_t>(element.technology)];
  if (ramp.reached == 0)
    return fmt::format(
        "no equilibrium was found at the start, not even of a small part of the load "
        "(element {}): {}",
        technology, ramp.reason);
  return fmt::format(
      "the load or approach at the start is more than this body carries: the load ramp "
      "found equilibria up to load fraction {:.4g}, and none beyond (element {}): {}",
      ramp.reached, technology, ramp.reason);
}

}  // namespace

template <int dim>
State WearModel<dim>::start(Counters& counters) const {
  ComposedSystem<dim> contact(equations_.composition(), equations_.deformation());
  FieldValues<dim> values(*equations_.composition()->fields);
  const RampReport ramp =
      find_equilibrium(equations_, contact, ramp_options(assembly()), values, counters);
  if (ramp.reached < 1) throw SolutionError(failure_of(ramp, assembly().bodies.front().element));
  State state;
  state.y.resize(system_.structure().size);
  system_.numbering().gather(values, state.y);
  set_rates(system_, nullptr, state);
  return state;
}

template RampOptions ramp_options(const Assembly<2>&);
template RampOptions ramp_options(const Assembly<3>&);
template RampReport find_equilibrium(const WornBodyEquations<2>&, ComposedSystem<2>&,
                                     const RampOptions&, FieldValues<2>&, Counters&);
template RampReport find_equilibrium(const WornBodyEquations<3>&, ComposedSystem<3>&,
                                     const RampOptions&, FieldValues<3>&, Counters&);
template State WearModel<2>::start(Counters&) const;
template State WearModel<3>::start(Counters&) const;

}  // namespace gnomon
