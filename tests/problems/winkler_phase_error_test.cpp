// The error of the mean over the phases on springs: its estimate against the error itself, and the
// number of phases that a run chooses by it.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <functional>

#include "winkler_pin.hpp"

namespace gnomon::winkler_phase_error_test {
namespace {

using namespace winkler_pin;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The mean wear rate on the unworn pin over 4000 positions.
Depths fine_rates(const std::function<double(double)>& force) {
  constexpr int positions = 4000;
  Depths mean(n, 0.0);
  for (int s = 0; s < positions; ++s) {
    const double tau = (s + 0.5) / positions;
    const std::vector<double> p = pressures(Depths(n, 0.0), force(tau));
    for (int i = 0; i < n; ++i) mean[i] += k * speed_of_sine(tau) * p[i] / positions;
  }
  return mean;
}

TEST(WinklerPhaseErrors, IsEstimatedWithinAFactor) {
  const Depths exact =
      fine_rates([](double tau) { return 2 + 1.5 * std::sin(2 * pi * tau + 0.3); });
  for (const int phases : {4, 8, 16, 32}) {
    const auto model = pin(fmt::format(
        "phases = {}\nx = \"0.05 * sin(2*pi*tau)\"\nforce = \"2 + 1.5 * sin(2*pi*tau + 0.3)\"",
        phases));
    Counters counters;
    const State start = model->start(counters);
    double difference = 0, whole = 0;
    for (int i = 0, c = 0; i < n; ++c) {
      if (!model->system().structure().differential[c]) continue;
      difference += area(i) * std::abs(start.ydot[c] - exact[i]);
      whole += area(i) * exact[i];
      ++i;
    }
    const PhaseError estimate = model->phase_error(start).value();
    fmt::print("{} phases: estimated {:.2e}, error {:.2e}\n", phases, estimate.error,
               difference / whole);
    EXPECT_EQ(estimate.phases, phases);
    EXPECT_GT(estimate.error, 0.4 * difference / whole);
    EXPECT_LT(estimate.error, 3 * difference / whole);
  }
}

TEST(WinklerPhaseErrors, ChoosesPhasesByTheTolerance) {
  long last = 0;
  for (const double rtol : {1e-1, 1e-2, 1e-3}) {
    const auto model =
        pin("phases = \"auto\"\nx = \"0.05 * sin(2*pi*tau)\"\nforce = \"2 + 1.5 * sin(2*pi*tau + "
            "0.3)\"",
            {fmt::format("integrator.rtol={}", rtol)});
    Counters counters;
    EXPECT_GT(model->phases, last);
    EXPECT_LE(model->phase_error(model->start(counters)).value().error, rtol);
    EXPECT_THAT(model->remarks.back(),
                HasSubstr(fmt::format("cycle.phases = \"auto\": {} phases", model->phases)));
    last = model->phases;
  }
}

TEST(WinklerPhaseErrors, AbsentWithoutACycle) {
  const auto steady = model_of("winkler/pin.toml", {"foundation.points=41"});
  EXPECT_FALSE(steady->phase_error);
}

/// A motion to and fro four times a cycle looks constant at four equal positions.
TEST(WinklerPhaseErrors, OfTheMotionAloneIsRemarked) {
  const auto remarks = [](const char* phases) {
    return pin(fmt::format("phases = {}\nx = \"0.05 * sin(8*pi*tau)\"\nforce = \"4\"", phases))
        ->remarks;
  };
  EXPECT_THAT(remarks("[0.0, 0.25, 0.5, 0.75]"),
              ElementsAre(HasSubstr("the mean of speed or force over 4 phases")));
  EXPECT_THAT(remarks("64"), IsEmpty());
}

}  // namespace
}  // namespace gnomon::winkler_phase_error_test
