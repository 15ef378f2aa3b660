// A plug-in with an integrator that throws something that is no std::exception.
#include <gnomon/integrators/integrator.hpp>

namespace {
const gnomon::Registration<gnomon::Integrator> registration(
    {.name = "throws",
     .family = "",
     .order = "1",
     .error_estimate = "",
     .stability = "",
     .driver = "",
     .help = "",
     .table = [](const gnomon::IntegratorSettings&) { return std::nullopt; },
     .make = [](const gnomon::System&, const gnomon::IntegratorSettings&,
                gnomon::Counters&) -> std::unique_ptr<gnomon::Stepper> { throw 42; }});
}  // namespace
