// bdf: variable-step, variable-order backward differentiation by IDA, with a semismooth Newton
// solver inside.

#include "integrators/bdf_memory.hpp"

namespace gnomon {

namespace {

class BdfSolver : public Stepper {
public:
  BdfSolver(const System& system, const IntegratorSettings& settings, Counters& counters)
      : Stepper(counters), memory_(std::make_unique<BdfMemory>(system, settings, counters)) {}

  /// IDA keeps its history where the unknowns are the same; it cannot be given others.
  bool follow(Stepper& before, const State&, bool same) override {
    auto& earlier = dynamic_cast<BdfSolver&>(before);
    if (!same || !earlier.memory_->begun()) return !earlier.memory_->begun();
    earlier.memory_->adopt(memory_->system(), memory_->settings());
    memory_ = std::move(earlier.memory_);
    return true;
  }

private:
  StepReport take_step(State& state, double t_stop) override {
    return memory_->advance(state, t_stop);
  }

  std::unique_ptr<BdfMemory> memory_;
};

const Registration<Integrator> registration({
    .name = "bdf",
    .family = "implicit multistep",
    .order = "1-5",
    .error_estimate = "predictor-corrector",
    .stability = "A and L at orders 1-2, A(alpha) at 3-5",
    .driver = "IDA",
    .help = "variable step and order, error control on the worn surface (integrator.rtol, .atol)",
    .fixed_steps = false,
    .keys = {max_order_key()},
    .table = [](const IntegratorSettings&) { return std::nullopt; },
    .make = [](const System& system, const IntegratorSettings& settings,
               Counters& counters) -> std::unique_ptr<Stepper> {
      return std::make_unique<BdfSolver>(system, settings, counters);
    },
});

}  // namespace

}  // namespace gnomon
