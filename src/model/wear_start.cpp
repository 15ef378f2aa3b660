// Consistent start of a worn body: equilibrium at the initial shape by a load ramp.

#include <fmt/format.h>

#include <algorithm>

#include <gnomon/error.hpp>
#include <gnomon/integration/stepper.hpp>
#include <gnomon/integration/stage_solver.hpp>
#include <gnomon/wear_model.hpp>

namespace gnomon {

namespace {

/// Moves the free body along the normal until its nearest point touches, so that the first matrix is
/// not singular.
template <int dim>
void close_initial_gap(const WornBody<dim>& body, NodalState<dim>& state) {
  const RigidPlane<dim>& plane = body.contact.counter_body;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& patch : body.contact_nodes)
    least = std::min(least, plane.gap(body.mesh.nodes[patch.node]));
  for (Eigen::Index node = 0; node < state.u.rows(); ++node)
    for (int i = 0; i < dim; ++i)
      if (!body.displacement_fixed(node, i)) state.u(node, i) = -least * plane.normal[i];
}

}  // namespace

template <int dim>
State WearModel<dim>::start(Counters& counters) const {
  constexpr double smallest_increment = 1e-4;
  WearSystem<dim> contact(
      std::make_shared<WornBody<dim>>(system_.body()),
      {.deformation = true, .interior_shape = false, .contact_shape = false});
  NewtonSolver newton(contact.structure(), counters);
  const NonlinearFunction function = algebraic_function(contact);

  NodalState<dim> nodal = NodalState<dim>::zero(system_.body());
  close_initial_gap(system_.body(), nodal);
  std::vector<double> good(contact.structure().size), trial;
  contact.unknowns().gather(nodal, good);
  double reached = 0, increment = 1;
  while (reached < 1) {
    const double target = std::min(1.0, reached + increment);
    contact.set_load_factor(target);
    trial = good;
    const NewtonReport report = newton.solve(function, trial);
    if (report.converged) {
      good = trial;
      reached = target;
      increment *= 2;
    } else if ((increment /= 2) < smallest_increment) {
      throw SolutionError(fmt::format("no equilibrium at t = 0 beyond load fraction {:.4f}: {}",
                                      reached, report.reason));
    }
  }

  contact.unknowns().scatter(good, nodal);
  State state;
  state.y.resize(system_.structure().size);
  system_.unknowns().gather(nodal, state.y);
  set_rates(system_, nullptr, state);
  return state;
}

template State WearModel<2>::start(Counters&) const;
template State WearModel<3>::start(Counters&) const;

}  // namespace gnomon
