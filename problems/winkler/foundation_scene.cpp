#include "foundation_scene.hpp"

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/cycles/compared_rates.hpp>
#include <gnomon/cycles/cycle_scene.hpp>
#include <gnomon/model/wear_scene.hpp>
#include <gnomon/scene/keys.hpp>
#include <limits>
#include <string>

namespace gnomon::winkler {

namespace {

using enum PhaseSet::Kind;

/// The approach delta at which the springs carry the force of a phase: the force is convex in it,
/// so that Newton's method comes down from full contact and ends after as many iterations at most
/// as there are springs to lose.
double approach(const Foundation& f, const Phase& phase, const std::vector<double>& d) {
  if (phase.held) return phase.press;
  const double force = std::max(phase.press, 0.0);
  const auto surface = [&](std::size_t i) { return f.profile(f.x[i]) + d[i]; };
  double delta = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < d.size(); ++i) delta = std::max(delta, surface(i));
  delta += force / (f.modulus * f.width);
  for (std::size_t iteration = 0; iteration <= d.size(); ++iteration) {
    double area = 0, moment = 0;  // of the springs that touch
    for (std::size_t i = 0; i < d.size(); ++i)
      if (surface(i) < delta) area += f.area[i], moment += f.area[i] * surface(i);
    if (area == 0) break;
    const double next = (force / f.modulus + moment) / area;
    if (!(next < delta)) break;
    delta = next;
  }
  return delta;
}

std::vector<double> mean_rate(const Foundation& f, const std::vector<Phase>& phases, double t,
                              const std::vector<double>& d) {
  std::vector<double> mean(d.size(), 0.0);
  for (const Phase& phase : phases) {
    const double delta = approach(f, phase, d);
    for (std::size_t i = 0; i < d.size(); ++i) {
      const double compression = delta - f.profile(f.x[i]) - d[i];
      const WearInput input = wear_input(f, phase, i,
                                         {.pressure = f.modulus * std::max(0.0, compression),
                                          .depth = d[i],
                                          .moment = {.time = t, .within = t}});
      mean[i] += phase.weight * f.wear.rate(input).value;
    }
  }
  return mean;
}

RateDifference compare(const Foundation& f, const std::vector<Phase>& phases, int times, double t,
                       const std::vector<double>& d) {
  return compare_rates(f.area, mean_rate(f, phases, t, d),
                       mean_rate(f, f.phase_set({comparison, times}), t, d));
}

double error_of_motion(const std::vector<Phase>& phases, const std::vector<Phase>& instants) {
  const auto speed = [](const Phase& phase) { return phase.speed; };
  const auto pressed = [](const Phase& phase) { return phase.speed * phase.press; };
  return std::max(error_of_mean(phases, instants, speed), error_of_mean(phases, instants, pressed));
}

/// The error of the means of speed and of its product with force or approach; nothing is solved.
double error_of_motion(const Foundation& foundation) {
  return error_of_motion(foundation.phases, foundation.phase_set({fine}));
}

/// The number of phases, as many as the foundation has or more, that is within the tolerance on the
/// unworn pin.
ChosenPhases choose_phases(const Foundation& foundation, double tolerance) {
  const std::vector<double> unworn(foundation.x.size(), 0.0);
  const std::vector<Phase> instants = foundation.phase_set({fine});
  return gnomon::choose_phases(
      tolerance,
      [&](int times) {
        return static_cast<long>(foundation.phase_set({own, times}).size());
      },
      [&](int times) {
        const std::vector<Phase> phases = foundation.phase_set({own, times});
        const double of_motion = error_of_motion(phases, instants);
        if (of_motion > tolerance) return of_motion;
        const auto [difference, whole] = compare(foundation, phases, times, 0, unworn);
        // Where nothing wears, the phases may all have missed the contact.
        if (!(whole > 0)) return std::numeric_limits<double>::infinity();
        return std::max(of_motion, difference / whole);
      });
}

/// The factors are in the order of the equations of winkler.cpp.
constexpr const char* archard_rate = "k * v * p";

/// The largest force of a phase; of a held flat that of the springs of the unworn pin.
double typical_force(const Foundation& f) {
  double most = 0;
  for (const Phase& phase : f.phases) {
    double force = phase.held ? 0 : phase.press;
    for (std::size_t i = 0; phase.held && i < f.x.size(); ++i)
      force += f.area[i] * f.modulus * std::max(0.0, phase.press - f.profile(f.x[i]));
    most = std::max(most, force);
  }
  return most;
}

void read_pin(const Scene& scene, Foundation& f) {
  f.radius = scene.real("pin.radius");
  f.width = scene.real("pin.width");
  f.modulus = scene.real("foundation.modulus");
  f.duration = scene.real("time.end");
  const long n = scene.integer("foundation.points");
  const double spacing = f.width / double(n - 1);
  for (long i = 0; i < n; ++i) {
    f.x.push_back(f.width * (double(i) / double(n - 1) - 0.5));
    f.area.push_back(i == 0 || i == n - 1 ? spacing / 2 : spacing);
  }
}

void read_motion(const Scene& scene, Foundation& f) {
  static_cast<FlatMotion&>(f) = read_flat_motion(scene);
  f.force = typical_force(f);
  if (!(f.force > 0))
    throw InputError(scene.where("cycle.y") +
                     ": expected a flat that presses the pin, y > 0, in some phase");
  f.speed = mean_speed(f.phases);
  if (!f.phase_set) return;
  const std::string remark = remark_on_motion(error_of_motion(f), phase_tolerance(scene),
                                              static_cast<long>(f.phases.size()), f.parts);
  if (!remark.empty()) f.remarks.push_back(remark);
}

void read_wear(const Scene& scene, Foundation& f) {
  f.wear = read_wear_law(scene, f.speed);
  WearCircumstances at{.pressure = f.mean_pressure(), .speed = f.speed, .duration = f.duration};
  try {
    f.wear_by_pressure = wear_by_pressure(f.wear, at);
  } catch (const RecoverableError& error) {
    throw unsound_law(scene, error);
  }
  if (f.wear_by_pressure == 0)
    throw InputError(
        scene.where("wear.rate") +
        ": expected a law that wears the centre of this pin; the springs have no friction");
  f.mean_depth = depth_by_law(f.wear, at, f.wear_by_pressure * f.mean_pressure() * f.duration);
  at.depth = f.mean_depth;
  at.initial.clear();
  for (const double x : f.x) at.initial.push_back({x, f.profile(x), 0});
  f.wear = required_law(scene, f.wear, at, f.remarks);
}

/// With a given number of phases.
std::shared_ptr<Foundation> foundation_of(const Scene& scene) {
  auto f = std::make_shared<Foundation>();
  read_pin(scene, *f);
  read_motion(scene, *f);
  read_wear(scene, *f);
  return f;
}

}  // namespace

namespace {

/// The analysis of the matrix takes the square of their number, some seconds of these, and no
/// signal ends it: each delta is coupled with every point.
constexpr int fewest_points = 3, most_points = 50000;

/// The springs as many times as far from each other.
std::optional<Scene> with_spacing(const Scene& scene, double factor) {
  const auto spaces = static_cast<double>(scene.integer("foundation.points") - 1);
  const long points = std::lround(spaces / factor) + 1;
  if (points < fewest_points || points > most_points) return {};
  return scene.with("foundation.points", points);
}

}  // namespace

std::vector<Key> foundation_keys() {
  std::vector<Key> result = {
      length_key("pin.radius", "radius of curvature R of the pin's surface y = x^2/(2R)"),
      length_key("pin.width", "width L of the pin"),
      real_key("foundation.modulus", "MPa/mm", required(), positive_quantity,
               "modulus K_w of the springs: pressure per unit of compression"),
      controlling(integer_key("foundation.points", by_default(401L),
                              {.min = fewest_points, .max = most_points},
                              "number of springs over the width, both ends included"),
                  ErrorSource::mesh, with_spacing)};
  for (const Key& key : phase_keys()) result.push_back(key);
  for (const Key& key : worn_body_keys(2))
    if ((key.name.starts_with("wear.") || key.name.starts_with("tables.")) &&
        key.name != "wear.normal" && key.name != "wear.velocity") {
      result.push_back(key);
      if (key.name == "wear.rate") result.back().default_value = archard_rate;
    }
  return result;
}

bool has_archard_rate(const Scene& scene) {
  return scene.text("wear.law") == "archard" ||
         (scene.text("wear.law") == "expression" &&
          (scene.text("wear.rate") == archard_rate || scene.text("wear.rate") == "k * p * v"));
}

std::shared_ptr<const Foundation> read_foundation(const Scene& scene) {
  if (!chooses_phases(scene)) return foundation_of(scene);
  const double tolerance = phase_tolerance(scene);
  const ChosenPhases chosen =
      choose_phases(*foundation_of(with_phases(scene, fewest_chosen_phases)), tolerance);
  auto f = foundation_of(with_phases(scene, chosen.count));
  f->remarks.push_back(remark_on_choice(chosen, tolerance));
  return f;
}

std::optional<PhaseError> phase_error(const Foundation& foundation, double t,
                                      const std::vector<double>& d) {
  auto [difference, whole] = compare(foundation, foundation.phases, 1, t, d);
  double worn = 0;
  for (std::size_t i = 0; i < d.size(); ++i) worn += foundation.area[i] * d[i];
  if (t > 0) whole = std::max(whole, worn / t);
  if (!(whole > 0)) return {};
  return PhaseError{t, static_cast<long>(foundation.phases.size()),
                    std::max(error_of_motion(foundation), difference / whole)};
}

}  // namespace gnomon::winkler
