// The load over time: its values, and their effect on the equations.

#include <gnomon/integrators/stop_times.hpp>
#include <gnomon/laws/load_history.hpp>
#include <gnomon/newton/algebraic_solver.hpp>

#include "support/pin.hpp"

namespace gnomon::load_history_test {
namespace {

using namespace testing;

TEST(LoadHistory, IsLinearBetweenItsPointsAndConstantBeyond) {
  const LoadHistory history({10, 20, 40}, {1, 3, 0.5});
  const std::pair<double, double> expected[] = {{0, 1},     {10, 1},   {15, 2},   {20, 3},
                                                {30, 1.75}, {40, 0.5}, {1e9, 0.5}};
  for (const auto& [t, factor] : expected) EXPECT_DOUBLE_EQ(history.factor(t), factor) << t;
  EXPECT_DOUBLE_EQ(history.integral(5), 5);
  EXPECT_DOUBLE_EQ(history.integral(15), 10 + 7.5);
  EXPECT_DOUBLE_EQ(history.integral(40), 10 + 20 + 35);
  EXPECT_DOUBLE_EQ(history.integral(100), 65 + 30);
  EXPECT_DOUBLE_EQ(history.least(5), 1);
  EXPECT_DOUBLE_EQ(history.least(30), 1);
  EXPECT_DOUBLE_EQ(history.least(36), 1);
  EXPECT_DOUBLE_EQ(history.least(38), 0.75);
  EXPECT_DOUBLE_EQ(history.least(100), 0.5);
  EXPECT_EQ(LoadHistory().factor(17), 1);
  EXPECT_EQ(LoadHistory().integral(17), 17);
}

TEST(LoadHistory, ContinuesAStraightLinePastItsEnd) {
  const LoadHistory history({10, 20, 40}, {1, 3, 0.5});
  EXPECT_DOUBLE_EQ(history.factor(21, 10), 3.2);
  EXPECT_DOUBLE_EQ(history.factor(21, 19.9), 3.2);
  EXPECT_DOUBLE_EQ(history.factor(21, 20), 3 - 0.125);
  EXPECT_DOUBLE_EQ(history.factor(12, 5), 1);
  EXPECT_DOUBLE_EQ(history.factor(48, 20), -0.5);
  EXPECT_DOUBLE_EQ(history.factor(48, 40), 0.5);
}

TEST(LoadHistory, JumpsWhereItHasTwoFactors) {
  const LoadHistory history({0, 10, 10, 20}, {1, 2, 5, 4});
  EXPECT_DOUBLE_EQ(history.factor(10), 5);
  EXPECT_DOUBLE_EQ(history.factor(10, 9), 2);
  EXPECT_DOUBLE_EQ(history.factor(11, 9), 2.1);
  EXPECT_DOUBLE_EQ(history.factor(15), 4.5);
  EXPECT_DOUBLE_EQ(history.integral(20), 15 + 45);
  EXPECT_EQ(history.least(20), 1);
  EXPECT_EQ(history.largest(), 5);
  EXPECT_EQ(LoadHistory::first_misplaced({0, 10, 10, 20}), 4);
  EXPECT_EQ(LoadHistory::first_misplaced({0, 10, 10, 10}), 3);
  EXPECT_EQ(LoadHistory::first_misplaced({0, 10, 9}), 2);
}

TEST(LoadHistory, StepsEndOnItsPoints) {
  const auto model = pin_model({elements(2), "load.times=[10, 20]", "load.factors=[1, 2]"});
  const Structure& structure = model->system().structure();
  EXPECT_EQ(end_of_smooth_part(structure, 0, 100), 10);
  EXPECT_EQ(end_of_smooth_part(structure, 0, 5), 5);
  EXPECT_EQ(end_of_smooth_part(structure, 10, 100), 20);
  EXPECT_EQ(end_of_smooth_part(structure, 20, 100), 100);
  EXPECT_TRUE(is_breakpoint(structure, 20));
  EXPECT_FALSE(is_breakpoint(structure, 15));
}

// For a given shape the algebraic solution at t is the start under the force at t, independent of
// earlier loads: nodes that have lost contact regain it.
TEST(LoadHistory, EquilibriaDoNotDependOnThePath) {
  const auto model =
      pin_model({elements(16), "load.times=[0, 1, 2, 3, 4]", "load.factors=[1, 1e-3, 5, 1e-2, 1]"});
  Counters counters;
  State state = model->start(counters);
  AlgebraicSolver stages(model->system(), counters);
  const double factors[] = {1, 1e-3, 5, 1e-2, 1};
  std::vector<double> in_contact;
  for (int t = 0; t < 5; ++t) {
    state.t = t;
    ASSERT_EQ(stages.solve(state.t, state.y), "") << t;
    const auto constant =
        pin_model({elements(16), "load.force=" + std::to_string(20 * factors[t])});
    const State start = constant->start(counters);
    for (const char* name : {"contact_force", "max_pressure", "contact_half_width"}) {
      const double expected = observed(*constant, start, name);
      EXPECT_NEAR(observed(*model, state, name), expected, 1e-6 * expected) << name << " " << t;
    }
    in_contact.push_back(observed(*model, state, "contact_nodes"));
  }
  EXPECT_EQ(in_contact[1], 1);
  EXPECT_GE(in_contact[2], 3);
  EXPECT_EQ(in_contact[4], in_contact[0]);
}

}  // namespace
}  // namespace gnomon::load_history_test
