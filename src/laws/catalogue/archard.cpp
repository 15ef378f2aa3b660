#include <gnomon/laws/catalogue.hpp>

namespace gnomon {

WearLaw archard(double coefficient) {
  return WearLaw({.rate = [k = coefficient](const WearInput& at, std::span<const char>) {
    return WearRate{.value = k * at.pressure * at.speed,
                    .by_pressure = k * at.speed,
                    .by_speed = k * at.pressure};
  }});
}

WearLaw dissipation_wear(double coefficient) {
  return WearLaw({.rate = [K = coefficient](const WearInput& at, std::span<const char>) {
    return WearRate{.value = K * at.friction_power, .by_friction_power = K};
  }});
}

namespace {

const char* const key = "wear.coefficient";

const Registration<WearLawKind> by_pressure(
    {.name = "archard",
     .help = "Archard: k p v (paper, sec. 4.1)",
     .keys = {{.name = key,
               .unit = "1/MPa",
               .range = positive_quantity,
               .help = "wear coefficient k of the rate k p v"}},
     .make = [](const Scene& scene) { return archard(scene.real(key)); }});

const Registration<WearLawKind> by_dissipation(
    {.name = "dissipation",
     .help = "by the frictional dissipation: K q = K mu p v (paper, eq. 13)",
     .keys = {{.name = key,
               .unit = "1/MPa",
               .range = positive_quantity,
               .help = "wear coefficient K of the rate K mu p v"}},
     .make = [](const Scene& scene) { return dissipation_wear(scene.real(key)); }});

}  // namespace

}  // namespace gnomon
