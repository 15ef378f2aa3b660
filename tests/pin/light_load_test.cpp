// Light loads on stiff and nearly incompressible bodies: neither rounding nor the choice of the
// active set may cost Newton iterations.

#include <fmt/format.h>

#include <algorithm>

#include "support/pin.hpp"

namespace gnomon::light_load_test {
namespace {

using namespace testing;

/// Ten steps of 20 s of backward Euler; the product k F, and with it the wear, is that of the
/// scene.
PinRun run_under(double force, Overrides overrides) {
  overrides.push_back(elements(20));
  overrides.push_back(fmt::format("load.force={}", force));
  overrides.push_back(fmt::format("wear.coefficient={}", 1e-7 * 20 / force));
  return run_pin("backward-euler", 20, 0, 200, overrides);
}

// 96, 97 and 90 iterations when written. With rho from E alone 197, 198 and 398, and 12 rejections.
TEST(LightLoad, CostsNoMoreThanAHeavyOne) {
  std::vector<long> iterations;
  for (double force : {20.0, 2.0, 0.2}) {
    const PinRun run = run_under(force, {"body.young_modulus=2e5"});
    EXPECT_EQ(run.counters.rejected_steps, 0) << force;
    EXPECT_NEAR(run.observed("contact_force"), force, 1e-6 * force);
    EXPECT_NEAR(run.observed("worn_volume"), 0.39957, 2e-5) << force;
    iterations.push_back(run.counters.newton_iterations);
  }
  const auto [least, most] = std::minmax_element(iterations.begin(), iterations.end());
  EXPECT_LT(*most, 1.3 * *least);
  EXPECT_LT(*most, 130);
}

TEST(LightLoad, OnAStiffNearlyIncompressibleBody) {
  const PinRun run = run_under(1e-4, {"body.young_modulus=1e6", "body.poisson_ratio=0.4999"});
  EXPECT_EQ(run.counters.rejected_steps, 0);
  EXPECT_LT(run.counters.newton_iterations, 120);  // 81 when written
  EXPECT_NEAR(run.observed("worn_volume"), 0.39957, 2e-5);
}

}  // namespace
}  // namespace gnomon::light_load_test
