#include <gnomon/laws/catalogue.hpp>
#include <gnomon/model/wear_scene.hpp>

namespace gnomon {

WearLaw read_wear_law(const Scene& scene) {
  return Registry<WearLawKind>::find(scene.text("wear.law"), "wear law").make(scene);
}

double wear_by_pressure(const Scene& scene, const WearLaw& law, const WearCircumstances& at) {
  constexpr int moments = 16;  // middles of equal parts of the run
  const double speed = scene.real("wear.velocity"), end = scene.real("time.end");
  for (const double multiple : {1.0, 3.0, 10.0, 30.0}) {
    const double pressure = multiple * at.pressure;
    double sum = 0;
    for (int k = 0; k < moments; ++k) {
      const double t = end * (k + 0.5) / moments;
      sum += law.rate({.pressure = pressure,
                       .speed = speed,
                       .friction_power = at.friction * pressure * speed,
                       .moment = {.time = t, .slid = speed * t, .within = t}})
                 .value;
    }
    if (sum > 0) return sum / (moments * pressure);
  }
  return 0;
}

void require_law(const Scene& scene, const WearLaw& law, const WearCircumstances& at) {
  const bool expression = scene.text("wear.law") == "expression";
  check_wear_law(law,
                 {.pressure = at.pressure,
                  .speed = scene.real("wear.velocity"),
                  .depth = at.depth,
                  .duration = scene.real("time.end"),
                  .friction = at.friction,
                  .nominal_speed = scene.real("wear.velocity")},
                 scene.where(expression ? "wear.rate" : "wear.law"));
}

}  // namespace gnomon
