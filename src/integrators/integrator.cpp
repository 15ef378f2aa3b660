#include <gnomon/integrators/integrator.hpp>

namespace gnomon {

StepReport Stepper::advance(State& state, double t_stop) {
  const Counters before = counted_;
  StepReport report = take_step(state, t_stop);
  ++counted_.steps;
  report.newton_iterations = counted_.newton_iterations - before.newton_iterations;
  report.restarted = counted_.rejected_steps > before.rejected_steps;
  return report;
}

}  // namespace gnomon
