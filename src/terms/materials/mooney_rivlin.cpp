#include <fmt/format.h>

#include <gnomon/laws/mooney_rivlin.hpp>
#include <gnomon/scene/keys.hpp>
#include <gnomon/terms/material_law.hpp>
#include <gnomon/terms/solid_kernels.hpp>

namespace gnomon {
namespace {

constexpr double usual_ratio = 0.2;  // of rubbers

/// C01 / (C10 + C01): polyconvex up to lambda / (2 mu).
std::array<double, 2> ratios(const Scene& scene, const std::string& table,
                             const ElasticModuli& moduli) {
  const std::string key = table + "mooney_ratio";
  const double ratio = scene.given(key) ? scene.real(key) : usual_ratio;
  const double most = moduli.lambda / (2 * moduli.mu);
  if (!(ratio <= most))
    throw InputError(fmt::format(
        "{}: expected nu / (1 - 2 nu) = {:.4g} or less with this Poisson's ratio nu, got {:g}",
        scene.where(key), most, ratio));
  return {ratio, 0};
}

const Registration<MaterialLaw> registration{
    {.name = "mooney-rivlin",
     .help = "Mooney and Rivlin, compressible: eq. (38) with a term of the second invariant",
     .kernels = &law_kernels<MooneyRivlinPoint>,
     .keys = {real_key("mooney_ratio", "",
                       absent(fmt::format("{:g} with mooney-rivlin", usual_ratio)),
                       {.min = 0, .max = 1}, "C01 / (C10 + C01) of the material mooney-rivlin")},
     .ratios = ratios}};

}  // namespace
}  // namespace gnomon
