// Variable-step, variable-order BDF by IDA, with a semismooth Newton solver inside.
#pragma once

#include <gnomon/integrators/integrator.hpp>
#include <memory>

namespace gnomon {

/// integrator.max_order.
const Key& max_order_key();

/// IDA on the DAE of a model. The error test contains only the differential components (weighted
/// root mean square over them; docs/integrators.md says which errors this does not control).
class BdfSolver : public Stepper {
public:
  BdfSolver(const System& system, const IntegratorSettings& settings, Counters& counters);
  ~BdfSolver() override;

  bool follow(Stepper& before, const State& state, bool same) override;

private:
  StepReport take_step(State& state, double t_stop) override;
  class Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace gnomon
