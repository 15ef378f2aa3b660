#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/laws/catalogue.hpp>
#include <gnomon/model/wear_scene.hpp>

namespace gnomon {

WearLaw read_wear_law(const Scene& scene) {
  return Registry<WearLawKind>::find(scene.text("wear.law"), "wear law").make(scene);
}

namespace {

/// The key that gives the law.
std::string where_law(const Scene& scene) {
  return scene.where(scene.text("wear.law") == "expression" ? "wear.rate" : "wear.law");
}

/// Wdot / p at a pressure; of a rate that is proportional to it, whatever the pressure, to the last
/// digit.
double secant(const WearLaw& law, const WearCircumstances& at, double pressure, double speed,
              double t) {
  constexpr double rounding = 1e-12;
  const WearRate rate = law.rate({.pressure = pressure,
                                  .speed = speed,
                                  .friction_power = at.friction * pressure * speed,
                                  .moment = {.time = t, .slid = speed * t, .within = t}});
  const double secant = rate.value / pressure;
  const double slope = rate.by_pressure + rate.by_friction_power * at.friction * speed;
  return std::abs(slope - secant) <= rounding * secant ? slope : secant;
}

}  // namespace

double wear_by_pressure(const Scene& scene, const WearLaw& law, const WearCircumstances& at) try {
  constexpr int moments = 16;  // middles of equal parts of the run
  const double speed = scene.real("wear.velocity"), end = scene.real("time.end");
  for (const double multiple : {1.0, 3.0, 10.0, 30.0}) {
    const auto at_moment = [&](int k) {
      return secant(law, at, multiple * at.pressure, speed, end * (k + 0.5) / moments);
    };
    const double first = at_moment(0);
    double difference = 0;  // so that equal ones have their mean to the last digit
    for (int k = 1; k < moments; ++k) difference += at_moment(k) - first;
    if (const double mean = first + difference / moments; mean > 0) return mean;
  }
  return 0;
} catch (const RecoverableError& error) {
  throw InputError(where_law(scene) + ": " + error.what());
}

void require_law(const Scene& scene, const WearLaw& law, const WearCircumstances& at) {
  check_wear_law(law,
                 {.pressure = at.pressure,
                  .speed = scene.real("wear.velocity"),
                  .depth = at.depth,
                  .duration = scene.real("time.end"),
                  .friction = at.friction,
                  .nominal_speed = scene.real("wear.velocity")},
                 where_law(scene));
}

}  // namespace gnomon
