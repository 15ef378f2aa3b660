#include "phase_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/phase_error.hpp"

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

}  // namespace

double error_of_motion(const Foundation& foundation) {
  return error_of_motion(foundation.phases, foundation.phase_set({fine}));
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

}  // namespace gnomon::winkler
