#include <gnomon/laws/neo_hookean.hpp>
#include <gnomon/terms/material_law.hpp>
#include <gnomon/terms/solid_kernels.hpp>

namespace gnomon {
namespace {

const Registration<MaterialLaw> registration{{.name = "neo-hookean",
                                              .help = "the paper's law, eq. (38)",
                                              .kernels = &law_kernels<NeoHookeanPoint>}};

}  // namespace
}  // namespace gnomon
