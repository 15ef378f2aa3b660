// A counter-body that moves by a given approach over time instead of being pressed by a force.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>

#include "support/pressed_block.hpp"
#include "support/problem_run.hpp"

namespace gnomon::given_approach_test {
namespace {

using namespace testing;

/// The block on its plane, held at the top, to be pressed from below.
AssemblyParts<3> held_block(PressedBlock block) {
  block.across = block.high = 4;
  auto body = pressed_block(block);
  body.loads.clear();
  for (std::size_t node = 0; node < body.mesh.nodes.size(); ++node)
    if (body.mesh.nodes[node][2] > block.size - 1e-9)
      body.supports.held(static_cast<Eigen::Index>(node), 2) = 1;
  return body;
}

std::vector<double> pressures(const Model& model, const State& state) {
  return model.contact(state).value().pressure;
}

/// p(t) of a column that is compressed at a rate and wears: dp/dt = E/L (rate - K p).
double column_pressure(double start, double stiffness, double rate, double wear, double t) {
  const double limit = rate / wear;
  return limit + (start - limit) * std::exp(-stiffness * wear * t);
}

// The approach at which a force is in equilibrium gives the same pressures as the force, whether it
// is there from the start or comes over time; nothing wears.
TEST(GivenApproach, GivesWhatTheForceGives) {
  PressedBlock block;
  block.wear = 0;
  auto pressed = held_block(block);
  pressed.interface.force = block.force;
  pressed.interface.partner.guide();
  Counters counters;
  const WearModel<3> by_force(pressed);
  const State start = by_force.start(counters);
  const double approach = observed(by_force, start, "approach");
  ASSERT_GT(approach, 0.01);
  const std::vector<double> reference = pressures(by_force, start);
  const double largest = *std::max_element(reference.begin(), reference.end());
  ASSERT_GT(largest, 1);

  const auto expect_reference = [&](const Model& model, const State& state) {
    const std::vector<double> pressure = pressures(model, state);
    for (std::size_t c = 0; c < reference.size(); ++c)
      EXPECT_NEAR(pressure[c], reference[c], 1e-7 * largest);
  };
  auto moved = held_block(block);
  moved.interface.partner.guide(LoadHistory({0}, {approach}));
  const WearModel<3> by_approach(moved);
  expect_reference(by_approach, by_approach.start(counters));

  auto coming = held_block(block);  // from where it does not touch yet
  coming.interface.partner.guide(LoadHistory({10, 70}, {-0.002, approach}));
  const WearModel<3> over_time(coming);
  const ModelRun run = run_model(over_time, "backward-euler", 20, 1e-3, 80);
  for (const double p : pressures(over_time, run.states.front())) EXPECT_EQ(p, 0);
  expect_reference(over_time, run.last());
}

// The load ramp moves it from where it touches: what is too much fails at a part of it.
TEST(GivenApproach, ComesByTheLoadRamp) {
  const auto start_at = [](double approach) {
    auto body = held_block({.wear = 0});
    body.interface.partner.guide(LoadHistory({0}, {approach}));
    const WearModel<3> model(body);
    Counters counters;
    const std::vector<double> pressed = pressures(model, model.start(counters));
    return *std::max_element(pressed.begin(), pressed.end());
  };
  EXPECT_NEAR(start_at(0), 0, 1e-9);  // touches in a point
  EXPECT_GT(start_at(0.5), 100);
  try {
    start_at(1.5);  // of a height of 2
    FAIL() << "expected no equilibrium";
  } catch (const SolutionError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("up to load fraction 0."));
  }
}

// A flat column against closed form, with a breakpoint of the approach, on which a step ends.
TEST(GivenApproach, AColumnWearsAsFastAsItIsPressed) {
  PressedBlock block;
  block.radius = 1e9;
  block.force = 0.4;  // 0.1 MPa
  block.wear = 1e-4;
  const double stiffness = block.young_modulus / block.size, start = 0.1 / stiffness;
  auto body = held_block(block);
  body.bodies.front().element.kinematics = Kinematics::small;
  const double rate = 2e-5, later = 5e-6;
  body.interface.partner.guide(
      LoadHistory({0, 30, 100}, {start, start + 30 * rate, start + 30 * rate + 70 * later}));
  const WearModel<3> model(body);
  const ModelRun run = run_model(model, "esdirk-4", 0, 1e-5, 70);
  const auto on_breakpoint = [](const State& state) { return state.t == 30; };
  EXPECT_TRUE(std::any_of(run.states.begin(), run.states.end(), on_breakpoint));
  for (const State& state : run.states) {
    const double at_30 = column_pressure(0.1, stiffness, rate, block.wear, 30);
    const double expected =
        state.t <= 30 ? column_pressure(0.1, stiffness, rate, block.wear, state.t)
                      : column_pressure(at_30, stiffness, later, block.wear, state.t - 30);
    for (const double p : pressures(model, state))
      EXPECT_NEAR(p, expected, 2e-3 * expected) << state.t;  // the column gets shorter
  }
  // By then the rate of wear is that of the approach, to what the exponential leaves.
  EXPECT_NEAR(column_pressure(0.1, stiffness, rate, block.wear, 1000), rate / block.wear, 1e-9);
}

}  // namespace
}  // namespace gnomon::given_approach_test
