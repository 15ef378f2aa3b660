// Variable-step, variable-order BDF by IDA, with a semismooth Newton solver inside.
#pragma once

#include <gnomon/integrators/integrator.hpp>
#include <memory>

namespace gnomon {

/// IDA on the DAE of a model. The error test sees the differential components only (weighted root
/// mean square over them; what that leaves uncontrolled: docs/integrators.md).
class BdfSolver : public Stepper {
public:
  BdfSolver(const System& system, const IntegratorSettings& settings, Counters& counters);
  ~BdfSolver() override;
  StepReport advance(State& state, double t_stop) override;

private:
  class Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace gnomon
