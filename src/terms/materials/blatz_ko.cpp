#include <gnomon/laws/blatz_ko.hpp>
#include <gnomon/terms/material_law.hpp>
#include <gnomon/terms/solid_kernels.hpp>

namespace gnomon {
namespace {

// Its forces grow without bound if a body is nearly worn away.
const Registration<MaterialLaw> registration{
    {.name = "blatz-ko",
     .help = "Blatz and Ko, which keeps elements from collapsing; a larger Poisson's ratio "
             "strengthens this",
     .kernels = &law_kernels<BlatzKoPoint>,
     .collapse_force = 1e3}};

}  // namespace
}  // namespace gnomon
