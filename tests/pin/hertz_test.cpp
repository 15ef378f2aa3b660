// The pin at the start against Hertz. What is measured and why it differs:
// docs/notes/equations.md, Accuracy.

#include <fmt/format.h>

#include <cmath>

#include "support/pin.hpp"

namespace gnomon::hertz_test {
namespace {

using namespace testing;

constexpr double E_star = 640 / (1 - 0.3 * 0.3);

/// The start, relative to Hertz. F R is kept, so the half width of Hertz is 0.4255 mm for every R.
struct Start {
  double pressure;     ///< largest pressure divided by that of Hertz
  double width_error;  ///< of the half width, in facet lengths

  explicit Start(int n, double R = 5) {
    const double F = 100 / R, a = std::sqrt(4 * F * R / (M_PI * E_star));
    EXPECT_NEAR(a, 0.4255, 1e-4);
    const auto model =
        pin_model({elements(n), fmt::format("pin.radius={}", R), fmt::format("load.force={}", F)});
    Counters counters;
    const State start = model->start(counters);
    pressure = observed(*model, start, "max_pressure") / (2 * F / (M_PI * a));
    width_error = (observed(*model, start, "contact_half_width") - a) / (10.0 / n);
  }
};

TEST(Hertz, HalfWidthIsKnownToAFacet) {
  for (int n : {20, 40, 60, 80}) EXPECT_LT(std::abs(Start(n).width_error), 1) << n;
}

// With refinement the ratio tends to the limit at this a / R, which is not one because the pressure
// is nominal.
TEST(Hertz, PressureTendsToItsNominalLimit) {
  constexpr double limit = 0.988;  // 0.9874 at 320x320
  std::vector<double> error;
  for (int n : {20, 40, 80}) {
    const Start start(n);
    error.push_back(std::abs(start.pressure - limit));
    if (n == 80) {
      EXPECT_NEAR(start.pressure, 1, 0.03);
    }
  }
  EXPECT_LT(error[1], error[0] / 2);
  EXPECT_LT(error[2], error[1] / 2);
}

// Hertz holds for small a / R: on the same mesh the difference is proportional to it.
TEST(Hertz, PressureApproachesHertzAsTheContactFlattens) {
  const double flat = Start(40, 2000).pressure;
  const double round = 1 - Start(40, 5).pressure / flat;     // a / R = 0.085
  const double between = 1 - Start(40, 50).pressure / flat;  // 0.0085
  EXPECT_NEAR(round, 0.013, 0.001);
  EXPECT_NEAR(between / round, 0.1, 0.02);
  EXPECT_NEAR(Start(80, 2000).pressure, 1, 0.007);  // 0.9951; at a / R = 0.085 it is 0.9824
}

}  // namespace
}  // namespace gnomon::hertz_test
