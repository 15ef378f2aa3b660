#include <gnomon/wear_laws/wear_law_kind.hpp>

namespace gnomon {

WearLaw archard(double coefficient) {
  return WearLaw({.rate =
                      [k = coefficient](const WearInput& at, std::span<const char>) {
                        return WearRate{.value = k * at.pressure * at.speed,
                                        .by_pressure = k * at.speed,
                                        .by_speed = k * at.pressure};
                      },
                  .in_time = false});
}

namespace {

const Registration<WearLawKind> registration(
    {.name = "archard",
     .help = "Archard: k p v (paper, sec. 4.1), as wear.rate = \"k * p * v\" but built in",
     .keys = {},
     .make = [](const Scene& scene) { return archard(scene.real("wear.coefficient")); }});

}  // namespace

}  // namespace gnomon
