// A wear law: Archard's coefficient falls from (1 + excess) k to k while a node slides, as a
// running-in layer is worn off,
//
//   Wdot = k (1 + excess exp(-h / layer)) p v,
//
// with h the depth worn off at the node. A scene chooses it by wear.law = "running-in".

#include <cmath>
#include <gnomon/wear_laws/wear_law_kind.hpp>

namespace {

using namespace gnomon;

WearLaw running_in(double k, double excess, double layer) {
  return WearLaw({.rate = [=](const WearInput& at, std::span<const char>) {
    const double fresh = excess * std::exp(-at.depth / layer);
    const double archard = k * at.pressure * at.speed;
    return WearRate{.value = (1 + fresh) * archard,
                    .by_pressure = (1 + fresh) * k * at.speed,
                    .by_speed = (1 + fresh) * k * at.pressure,
                    .by_depth = -fresh / layer * archard};
  }});
}

// All keys of laws are in the tables of all scenes; so they are optional or have a default.
const Registration<WearLawKind> registration(
    {.name = "running-in",
     .help = "Archard's law with a coefficient that falls while a layer is worn off",
     .keys = {{.name = "wear.excess",
               .default_value = 1.0,
               .range = {.min = 0},
               .help = "of the coefficient of an unworn surface in the law running-in"},
              {.name = "wear.layer",
               .unit = "mm",
               .default_value = 0.001,
               .range = positive_quantity,
               .help = "depth over which the excess falls by e in the law running-in"}},
     .make = [](const Scene& scene) {
       return running_in(scene.real("wear.coefficient"), scene.real("wear.excess"),
                         scene.real("wear.layer"));
     }});

}  // namespace
