// The effect of the force does not depend on the positions of the bodies before they are loaded.

#include <fmt/format.h>

#include "support/pin.hpp"

namespace gnomon::initial_gap_test {
namespace {

using namespace testing;

std::string gap(double g) {
  return fmt::format("contact.initial_gap={:.17g}", g);
}

// From a micrometre to beyond the pin, apart and overlapping; the pin comes down by the gap.
TEST(InitialGap, OfThePinOnlyShiftsIt) {
  const PinRun touching = run_pin("esdirk-3", 0, 1e-3, 200, {elements(10)});
  const auto height = [](const PinRun& run) {
    return run.model->contact(run.states.front())->current.at(5)[1];
  };
  for (const double g : {1e-3, 0.1, 10.0, 1e3, -1e-3, -0.1, -5.0, -20.0}) {
    const PinRun run = run_pin("esdirk-3", 0, 1e-3, 200, {elements(10), gap(g)});
    EXPECT_LT((run.worn_surface() - touching.worn_surface()).norm(), 1e-9) << g;
    EXPECT_NEAR(height(run), height(touching) - g, 1e-9) << g;
    EXPECT_EQ(run.counters.steps, touching.counters.steps) << g;
  }
}

TEST(InitialGap, OfTheBallsOnlyShiftsTheApproach) {
  const std::pair<const char*, Overrides> scenes[] = {
      {"ball_on_flat/small_deformation.toml", {"mesh.elements=[4, 2, 1]"}},
      {"ball_on_half_space/small_deformation.toml",
       {"mesh.elements=[6, 12, 4]", "mesh.size=[0.08, 0.08, 0.08]"}}};
  for (const auto& [scene, mesh] : scenes) {
    const auto start = [&, scene = scene, mesh = mesh](double g) {
      Overrides overrides = mesh;
      overrides.push_back(gap(g));
      const auto model = model_of(scene, overrides);
      Counters counters;
      const State state = model->start(counters);
      return std::pair(observed(*model, state, "approach"), model->contact(state)->pressure);
    };
    const auto [approach, pressure] = start(0);
    // The ball's centre in the surface, and below it.
    for (const double g : {1e-3, 5.0, 1e3, -1e-3, -5.0, -12.0}) {
      const auto [moved, same] = start(g);
      EXPECT_NEAR(moved - g, approach, 1e-8) << scene << " " << g;
      for (std::size_t c = 0; c < pressure.size(); ++c)
        EXPECT_NEAR(same[c], pressure[c], 1e-3) << scene << " " << g;  // of some 1000 MPa
    }
  }
}

}  // namespace
}  // namespace gnomon::initial_gap_test
