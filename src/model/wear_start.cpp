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

/// An attempt that will succeed needs 3 to 9 iterations.
constexpr int max_iterations = 15;
/// Of equilibria on the way to the whole load, in the first load that is tried.
constexpr double rough_tolerance = 1e-3;

/// Brings body and counter-body together, or apart, until they touch in a point, so that the first
/// matrix is not singular: moves the counter-body if it is free to, else the body.
template <int dim>
void close_initial_gap(const WornBody<dim>& body, NodalState<dim>& state) {
  const CounterBody<dim>& other = body.contact.counter_body;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& patch : body.contact_nodes)
    least = std::min(least, other.travel_to(body.mesh.nodes[patch.node]));
  if (body.counter_force) {
    state.w = least;
    return;
  }
  for (Eigen::Index node = 0; node < state.u.rows(); ++node)
    for (int i = 0; i < dim; ++i)
      if (!body.displacement_fixed(node, i)) state.u(node, i) = -least * other.approach[i];
}

/// How far a counter-body under part of its force comes near a body at rest, about: as a ball does,
/// by F^(2/3) (Hertz). From there Newton meets a whole patch of active nodes. With one node alone
/// that touches it would turn the elements beside that node inside out, the sooner the finer they
/// are.
template <int dim>
double indentation(const WornBody<dim>& body, double fraction) {
  return body.scales.displacement * std::cbrt(fraction * fraction);
}

/// As in a scene.
const char* element_name(ElementKind kind) {
  return variational(kind) ? "f-bar-variational" : averaged(kind) ? "f-bar" : "plain";
}

}  // namespace

template <int dim>
RampOptions ramp_options(const WornBody<dim>& body) {
  const NeoHookean& law = body.material;
  const double whole_strain = body.scales.stress / law.young_modulus();
  const double strain = 3 * law.mu / (law.lambda + law.mu);
  RampOptions options;
  options.first = strain < whole_strain ? strain / whole_strain : 1;
  options.smallest *= options.first;
  return options;
}

template <int dim>
RampReport find_equilibrium(WearSystem<dim>& contact, const RampOptions& options,
                            NodalState<dim>& state, Counters& counters) {
  // One at a time, for each holds factors. Most loads go on at once, and need the exact one alone.
  std::optional<NewtonSolver> solver;
  bool exact = false;
  const NonlinearFunction function = algebraic_function(contact);
  close_initial_gap(contact.body(), state);
  const double touching = state.w;
  bool loaded = false;
  const LoadSolve solve = [&](double fraction, std::span<double> y) {
    contact.set_load_factor(fraction * contact.body().load_history.factor(0));
    if (!loaded && contact.body().counter_force)
      y[contact.unknowns().w()] = touching + indentation(contact.body(), fraction);
    if (!solver || exact != (fraction == 1)) {
      exact = fraction == 1;
      NewtonOptions newton{.max_iterations = max_iterations};
      if (!exact) newton.tolerance = rough_tolerance * options.first;
      solver.reset();
      solver.emplace(contact.structure(), counters, newton);
    }
    const NewtonReport report = solver->solve(function, y);
    loaded = loaded || report.converged;
    return report;
  };
  std::vector<double> y(contact.structure().size);
  contact.unknowns().gather(state, y);
  const RampReport report = ramp_load(solve, options, y);
  contact.unknowns().scatter(y, state);
  return report;
}

template <int dim>
State WearModel<dim>::start(Counters& counters) const {
  const WornBody<dim>& body = system_.body();
  WearSystem<dim> contact(system_.shared_body(),
                          {.deformation = true, .interior_shape = false, .contact_shape = false});
  NodalState<dim> nodal = NodalState<dim>::zero(body);
  const RampReport ramp = find_equilibrium(contact, ramp_options(body), nodal, counters);
  if (ramp.reached < 1)
    throw SolutionError(fmt::format(
        "the load ramp found no equilibrium beyond load fraction {:.4g} with element {}: {}",
        ramp.reached, element_name(body.element), ramp.reason));
  State state;
  state.y.resize(system_.structure().size);
  system_.unknowns().gather(nodal, state.y);
  set_rates(system_, nullptr, state);
  return state;
}

template RampOptions ramp_options(const WornBody<2>&);
template RampOptions ramp_options(const WornBody<3>&);
template RampReport find_equilibrium(WearSystem<2>&, const RampOptions&, NodalState<2>&, Counters&);
template RampReport find_equilibrium(WearSystem<3>&, const RampOptions&, NodalState<3>&, Counters&);
template State WearModel<2>::start(Counters&) const;
template State WearModel<3>::start(Counters&) const;

}  // namespace gnomon
