// bdf: variable-step, variable-order backward differentiation by IDA.

#include <gnomon/integrators/bdf.hpp>
#include <gnomon/integrators/integrator.hpp>

namespace gnomon {

namespace {

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
