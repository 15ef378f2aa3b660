// A plug-in that registers an integrator without the function that makes its stepper.
#include <gnomon/integrators/integrator.hpp>

namespace {
const gnomon::Registration<gnomon::Integrator> registration(
    {.name = "nothing",
     .family = "",
     .order = "1",
     .error_estimate = "",
     .stability = "",
     .driver = "",
     .help = "",
     .table = [](const gnomon::IntegratorSettings&) { return std::nullopt; },
     .make = nullptr});
}  // namespace
