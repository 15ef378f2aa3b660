// Closed forms and identities of two bodies: Hertz, the sum of the wear coefficients, orders of
// integrators.

#include <cmath>
#include <gnomon/results/surface_difference.hpp>

#include "support/problem_run.hpp"
#include "support/two_bodies.hpp"

namespace gnomon::pair_theorems_test {
namespace {

using namespace testing;

/// A round body on a flat one, both 20 times as large as the half-width of contact, 1.
TwoBodies round_on_flat(Section section, double upper_modulus, double lower_modulus) {
  constexpr double radius = 50;
  TwoBodies pair{.upper = {.along = 40, .high = 40, .to = 20, .size = 20, .grading = 2},
                 .lower = {.along = 50, .high = 40, .to = 20, .size = 20, .grading = 2},
                 .kinematics = Kinematics::small,
                 .section = section};
  pair.upper.young_modulus = upper_modulus, pair.lower.young_modulus = lower_modulus;
  pair.upper.surface = [=](double x) { return x * x / (2 * radius); };
  const double modulus = 1 / (0.91 / upper_modulus + 0.91 / lower_modulus);
  pair.force = section == Section::plane ? M_PI * modulus / (8 * radius)  // of one half
                                         : 4 * modulus / (3 * radius);
  return pair;
}

TEST(PairTheorems, PressuresAreThoseOfHertz) {
  for (const Section section : {Section::plane, Section::meridian})
    for (const double ratio : {1.0, 3.0, 100.0}) {
      SCOPED_TRACE(::testing::Message() << int(section) << " moduli 1:" << ratio);
      const TwoBodies pair = round_on_flat(section, 1000, 1000 * ratio);
      const WearModel<2> model(two_bodies<2>(pair));
      Counters counters;
      const Observation start = model.observe(model.start(counters));
      const double peak =
          section == Section::plane ? 4 * pair.force / M_PI : 3 * pair.force / (2 * M_PI);
      EXPECT_NEAR(*value_of(start, "max_pressure") / peak, 1, 0.015);
    }
}

/// Blocks with waves, closed throughout.
TwoBodies closed_waves(double upper, double lower) {
  TwoBodies pair{.upper = {.along = 8, .high = 5, .wear = upper},
                 .lower = {.along = 11, .high = 5, .wear = lower},
                 .force = 60};
  pair.upper.surface = [](double x) { return 0.01 * std::cos(M_PI * x); };
  return pair;
}

/// The largest depth of a side, from the mean over its nodes.
double waviness(const WearModel<2>& model, const State& state, bool upper) {
  const ContactSurface surface = model.contact(state).value();
  double low = 1, high = 0;
  for (std::size_t c = 0; c < surface.node.size(); ++c) {
    if (model.assembly().carries[c] != upper) continue;
    low = std::min(low, surface.wear_depth[c]), high = std::max(high, surface.wear_depth[c]);
  }
  return high - low;
}

// Only the sum of the coefficients enters the gap, and the depths divide like them.
TEST(PairTheorems, TheSumOfTheCoefficientsWears) {
  const auto pressures = [](double upper, double lower) {
    TwoBodies pair = closed_waves(upper, lower);
    pair.kinematics = Kinematics::small;
    pair.lower.along = pair.upper.along;
    const WearModel<2> model(two_bodies<2>(pair));
    const State end = run_model(model, "esdirk-4", 10, 0, 100).last();
    return std::pair(*value_of(model.observe(end), "max_pressure"),
                     std::pair(waviness(model, end, true), waviness(model, end, false)));
  };
  const auto [upper, depths_upper] = pressures(2e-6, 1e-9);
  const auto [both, depths] = pressures(1.5e-6, 0.5e-6);
  EXPECT_NEAR(both / upper, 1, 1e-3);
  EXPECT_NEAR(depths.first / depths.second, 3, 0.03);
  EXPECT_NEAR((depths.first + depths.second) / depths_upper.first, 1, 0.02);
}

TEST(PairTheorems, IntegratorsHaveTheirOrder) {
  const WearModel<2> model(two_bodies<2>(closed_waves(6e-6, 3e-6)));
  const auto run = [&](const std::string& name, double step) {
    return run_model(model, name, step, 0, 100).last();
  };
  const State reference = run("esdirk-4", 2.5);
  const auto error = [&](const State& state) {
    return shape_error(model.contact(state).value(), model.contact(reference).value());
  };
  for (const auto& [name, order] :
       {std::pair{"backward-euler", 1.0}, {"sdirk-2", 2.0}, {"esdirk-3", 3.0}}) {
    const double coarse = error(run(name, 20)), fine = error(run(name, 10));
    EXPECT_GT(coarse, 1e-9);
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.35) << name << " " << coarse << " " << fine;
  }
}

}  // namespace
}  // namespace gnomon::pair_theorems_test
