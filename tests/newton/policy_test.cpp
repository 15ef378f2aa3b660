// The decisions of Newton's method, without an iteration.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "newton/newton_policy.hpp"

namespace gnomon::policy_test {
namespace {

using Verdict = NewtonPolicy::Verdict;

/// A step from an iterate with this norm on this branch; whether it came with a set-up.
bool step(NewtonPolicy& policy, double norm, const ActiveSet& branch = {}, bool demanded = false) {
  EXPECT_EQ(policy.judge({norm, branch}), Verdict::go_on) << norm;
  const bool set_up = policy.plan(demanded).set_up;
  if (set_up) policy.factors_made();
  return set_up;
}

TEST(NewtonPolicy, IsDoneBelowTheToleranceAndAtAGuessBelowAHundredthOfIt) {
  NewtonPolicy policy(modified_newton);
  policy.begin();
  EXPECT_EQ(policy.judge({0.99e-13}), Verdict::done);
  policy.begin();
  EXPECT_TRUE(step(policy, 1.01e-13));
  EXPECT_EQ(policy.judge({0.99e-11}), Verdict::done);
  EXPECT_EQ(policy.iterations(), 1);
}

TEST(NewtonPolicy, TakesAPredictorOfIdaWithinTheToleranceAsItIs) {
  NewtonPolicy policy(newton_in_ida);
  policy.begin();
  EXPECT_EQ(policy.judge({0.99e-11}), Verdict::done);
  policy.begin();
  EXPECT_EQ(policy.judge({1.01e-11}), Verdict::go_on);
}

TEST(NewtonPolicy, KeepsFactorsOverSolvesAsLongAsTheyContract) {
  NewtonPolicy policy(modified_newton);
  policy.begin();
  EXPECT_FALSE(policy.began_with_kept_factors());
  EXPECT_TRUE(step(policy, 1));
  EXPECT_FALSE(step(policy, 0.2));
  policy.begin();
  EXPECT_TRUE(policy.began_with_kept_factors());
  EXPECT_FALSE(step(policy, 1));  // another solve: its contraction is not known yet
  EXPECT_FALSE(step(policy, 0.19));
  EXPECT_TRUE(step(policy, 0.04));  // more than a fifth
  EXPECT_FALSE(step(policy, 0.001));
}

TEST(NewtonPolicy, FullNewtonMakesFactorsInEveryIteration) {
  NewtonPolicy policy(NewtonOptions{});
  policy.begin();
  for (double norm : {1.0, 1e-2, 1e-4}) EXPECT_TRUE(step(policy, norm));
  policy.begin();
  EXPECT_FALSE(policy.began_with_kept_factors());
}

TEST(NewtonPolicy, KeptFactorsServeOneBranchAndNearbyWeightsOfTheRates) {
  NewtonPolicy policy(modified_newton);
  const auto set_up = [&](double rate_weight, const ActiveSet& branch) {
    policy.begin(rate_weight);
    return step(policy, 1, branch);
  };
  EXPECT_TRUE(set_up(10, {0, 1}));
  EXPECT_FALSE(set_up(10, {0, 1}));
  EXPECT_TRUE(set_up(10, {1, 1}));
  EXPECT_FALSE(set_up(13.9, {1, 1}));
  EXPECT_TRUE(set_up(14.1, {1, 1}));
  EXPECT_FALSE(set_up(14.1 / 1.39, {1, 1}));  // of those made last
  EXPECT_TRUE(set_up(14.1 / 1.41, {1, 1}));
}

TEST(NewtonPolicy, LeavesTheWeightOfTheRatesToIdaAndObeysIt) {
  NewtonPolicy policy(newton_in_ida);
  policy.begin();
  EXPECT_TRUE(step(policy, 1, {1}, true));
  policy.begin();
  EXPECT_FALSE(step(policy, 1, {1}));
  policy.begin();
  EXPECT_TRUE(step(policy, 1, {1}, true));
}

TEST(NewtonPolicy, PlansASetUpAgainWhereTheLastOneFailedOrIsForgotten) {
  NewtonPolicy policy(modified_newton);
  policy.begin();
  policy.judge({1});
  EXPECT_TRUE(policy.plan().set_up);  // and it fails: factors_made() is not called
  policy.begin();
  EXPECT_FALSE(policy.began_with_kept_factors());
  EXPECT_TRUE(step(policy, 1));
  policy.begin();
  EXPECT_FALSE(step(policy, 1));
  policy.forget_factors();
  policy.begin();
  EXPECT_TRUE(step(policy, 1));
}

// Rounding: an acceptable residual that a fresh Jacobian does not halve.
/// Whether the set-up planned at this iterate is whole.
bool whole(NewtonPolicy& policy, double norm, const ActiveSet& branch) {
  EXPECT_EQ(policy.judge({norm, branch}), Verdict::go_on) << norm;
  const NewtonPolicy::Plan plan = policy.plan();
  EXPECT_TRUE(plan.set_up) << norm;
  policy.factors_made();
  return plan.whole;
}

TEST(NewtonPolicy, BlamesTheOldSlowPartForSlowContractionOnOneBranchOnly) {
  NewtonPolicy policy(modified_newton);
  policy.begin();
  EXPECT_FALSE(whole(policy, 1, {0}));
  EXPECT_FALSE(whole(policy, 0.9, {1}));
  EXPECT_TRUE(whole(policy, 0.8, {1}));
}

TEST(NewtonPolicy, AfterAFailureSetUpsAreWholeUntilASolveSucceeds) {
  NewtonPolicy policy(modified_newton);
  policy.forget_factors();
  policy.begin();
  EXPECT_TRUE(whole(policy, 1, {0}));
  EXPECT_TRUE(whole(policy, 0.1, {1}));
  EXPECT_EQ(policy.judge({1e-12, {1}}), Verdict::done);
  policy.begin();
  EXPECT_FALSE(whole(policy, 1, {0}));
}

TEST(NewtonPolicy, LateSetUpsAreWhole) {
  NewtonPolicy policy(modified_newton);
  policy.begin();
  for (int k = 0; k < 12; ++k) EXPECT_EQ(whole(policy, 1, {char(k % 2)}), k >= 8) << k;
}

TEST(NewtonPolicy, AcceptsASmallResidualThatAFreshJacobianDoesNotHalve) {
  NewtonPolicy policy(modified_newton);
  policy.begin();
  EXPECT_TRUE(step(policy, 1));
  EXPECT_FALSE(step(policy, 0.9e-9));  // kept factors: does not show rounding
  EXPECT_TRUE(step(policy, 0.6e-9));   // slow, so with a fresh one
  EXPECT_EQ(policy.judge({0.31e-9}), Verdict::rounding);

  policy.begin();
  step(policy, 1), step(policy, 0.9e-9), step(policy, 0.6e-9);
  EXPECT_EQ(policy.judge({0.29e-9}), Verdict::go_on);
}

TEST(NewtonPolicy, DoesNotTakeALargeResidualForRounding) {
  NewtonPolicy policy(modified_newton);
  policy.begin();
  for (int k = 0; k < 10; ++k) step(policy, 1.1e-9);
  EXPECT_EQ(policy.judge({1.1e-9}), Verdict::go_on);
}

TEST(NewtonPolicy, InIdaIsAtRoundingFromTheThirdIterationOnWhateverTheFactors) {
  NewtonPolicy policy(newton_in_ida);
  policy.begin();
  step(policy, 1, {}, true);
  step(policy, 0.9e-9);
  step(policy, 0.5e-9);  // slow, but the second iteration
  EXPECT_EQ(policy.judge({0.25e-9}), Verdict::rounding);
  policy.begin();
  step(policy, 1), step(policy, 0.9e-9), step(policy, 0.5e-9);
  EXPECT_EQ(policy.judge({0.09e-9}), Verdict::go_on);  // fivefold
}

TEST(NewtonPolicy, FailsWhenIterationsAreUsedUp) {
  for (const double last : {1e-3, 0.9e-9}) {
    for (const NewtonOptions& options : {modified_newton, newton_in_ida}) {
      NewtonPolicy policy(options);
      policy.begin();
      for (int k = 0; k < options.max_iterations; ++k) step(policy, k % 2 ? 1.0 : 2.0);
      // After the last iteration KINSOL accepts a small residual; IDA shortens its step.
      const bool accepted = last < 1e-9 && options.acceptable_at_the_end;
      EXPECT_EQ(policy.judge({last}), accepted ? Verdict::rounding : Verdict::failed);
      EXPECT_EQ(policy.iterations(), options.max_iterations);
    }
  }
}

TEST(NewtonPolicy, AsksForLinearResidualsByTheContraction) {
  NewtonPolicy policy(modified_newton);
  const auto reduction = [&](double norm) {
    EXPECT_EQ(policy.judge({norm}), Verdict::go_on);
    const NewtonPolicy::Plan plan = policy.plan();
    if (plan.set_up) policy.factors_made();
    return plan.reduction;
  };
  policy.begin();
  EXPECT_DOUBLE_EQ(reduction(1e8), 1e-4);   // no contraction yet: the loosest
  EXPECT_DOUBLE_EQ(reduction(1), 1e-9);     // kept factors: a tenth of the contraction
  EXPECT_DOUBLE_EQ(reduction(0.1), 1e-4);   // never looser
  EXPECT_DOUBLE_EQ(reduction(1e-9), 1e-4);  // 1e-9, but a fifth of the final residual is enough
  policy.begin();
  reduction(1e10);
  EXPECT_DOUBLE_EQ(reduction(1), 1e-10);  // never tighter

  NewtonPolicy full(NewtonOptions{});
  full.begin();
  full.judge({1}), full.plan(), full.factors_made();
  full.judge({1e-3});
  EXPECT_DOUBLE_EQ(full.plan().reduction, 0.9e-6);  // fresh: 0.9 of its square
}

TEST(ResidualNorm, IsTheLargestByTheScaleOfItsRow) {
  Structure structure;
  structure.row_scale = {1, 10, 0.1};
  structure.differential = {0, 1, 1};
  const ResidualNorm norm(structure);
  EXPECT_DOUBLE_EQ(norm(std::vector<double>{1, -30, 0.2}), 3);
  EXPECT_DOUBLE_EQ(norm(std::vector<double>{-4, 0, 0}), 4);
}

TEST(ResidualNorm, AllowsForTheRoundingOfRatesOnly) {
  Structure structure;
  structure.row_scale = {1, 1, 1};
  structure.differential = {0, 1, 1};
  ResidualNorm norm(structure);
  // Ten roundings of y = 2 times a weight of 1e9, over an acceptable residual of 1e-9.
  norm.allow_for_rounding(1e9, std::vector<double>{2, 2, 0}, 1e-9);
  EXPECT_EQ(norm.scale()[0], 1);
  EXPECT_NEAR(norm.scale()[1], 20 * 2.220446e-16 * 1e18, 1);
  EXPECT_EQ(norm.scale()[2], 1);
  norm.allow_for_rounding(1, std::vector<double>{2, 2, 0}, 1e-9);
  EXPECT_EQ(norm.scale()[1], 1);  // of this solve, not of the last
}

}  // namespace
}  // namespace gnomon::policy_test
