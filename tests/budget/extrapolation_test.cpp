// Errors from the differences of two and three meshes.

#include "budget/extrapolation.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace gnomon::budget {
namespace {

// Values 1 + c h^p on h, 2h and 4h: the error of the first is c h^p.
TEST(Extrapolation, FindsAnErrorOfItsOrder) {
  const auto expect_found = [](double order, const auto& by) {
    const auto value = [&](double h) { return 1 + 0.1 * std::pow(h, order); };
    const auto [error, found] = by(value(2) - value(1), value(4) - value(2));
    EXPECT_NEAR(error, 0.1, 1e-12);
    EXPECT_NEAR(found, order, 1e-9);
  };
  for (const double order : {1.0, 1.5, 1.9}) expect_found(order, extrapolated);
  for (const double order : {0.5, 0.7, 1.0, 1.5, 1.9}) expect_found(order, extrapolated_at_edge);
}

TEST(Extrapolation, DoesNotBelieveInLowOrders) {
  EXPECT_EQ(extrapolated(0.03, 0.045).order, 1);  // 0.58 by the differences
  EXPECT_EQ(extrapolated(0.03, 0.03).order, usual_order);
  EXPECT_EQ(extrapolated(0.03, -0.06).order, usual_order);
  EXPECT_EQ(extrapolated(0.03, not_known).order, usual_order);
}

TEST(Extrapolation, DoesNotKnowAnErrorAtAnEdgeThatHardlyFalls) {
  EXPECT_EQ(extrapolated_at_edge(0.03, 0.037).order, 0.5);  // 0.3 by the differences
  EXPECT_TRUE(std::isnan(extrapolated_at_edge(0.03, 0.034).error));
  EXPECT_TRUE(std::isnan(extrapolated_at_edge(-0.03, -0.02).error));
  EXPECT_EQ(extrapolated_at_edge(0.002, 0.002).order, usual_order);  // chance
  EXPECT_EQ(extrapolated_at_edge(0.03, -0.03).order, usual_order);
  EXPECT_EQ(extrapolated_at_edge(0.03, not_known).order, usual_order);
}

TEST(Extrapolation, NamesTheValuesWhoseErrorIsNotKnown) {
  BudgetPart part{.source = ErrorSource::mesh, .key = "mesh.factor", .how = {}, .errors = {}};
  const std::vector<Scalar> values = {{"wear_depth", "mm", 1}, {"approach", "mm", 1}};
  extrapolate(part, values, {0.12, 0.01}, {0.09, 0.02}, 2);
  EXPECT_TRUE(std::isnan(part.errors[0]));
  EXPECT_NEAR(part.errors[1], 0.005, 1e-12);  // of order 1
  EXPECT_THAT(part.doubt, ::testing::HasSubstr("of wear_depth (by 9 %, then 12 %) from"));
  const Budget budget{.values = values,
                      .parts = {part, {ErrorSource::time, "integrator.rtol", "", {1e-6, 1e-6}}}};
  EXPECT_THAT(budget_warnings(budget), ::testing::ElementsAre("mesh: " + part.doubt));
  EXPECT_THAT(budget_table(budget), ::testing::HasSubstr(part.doubt));
  EXPECT_TRUE(std::isnan(budget.total(0)));  // a small part of it is no bound
  EXPECT_GT(budget.total(1), 0.005);
}

/// On coarse elements all sticks, and rounding wears.
TEST(Extrapolation, KnowsNothingFromACompanionWithoutTheValue) {
  const std::vector<Scalar> values = {
      {"worn_volume", "mm^2", 4e-5}, {"wear_depth", "mm", 7e-5}, {"max_pressure", "MPa", 170}};
  Goals coarse;
  coarse.values = {
      {"worn_volume", "mm^2", 3e-15}, {"wear_depth", "mm", 0}, {"max_pressure", "MPa", 120}};
  std::vector<double> changes = {-1e10, not_known, 0.1};
  BudgetPart part{.source = ErrorSource::mesh, .key = "mesh.factor", .how = {}, .errors = {}};
  forget_without_value(coarse, values, changes, part.doubt);
  extrapolate(part, values, changes, {0.5, 0.5, 0.2});
  EXPECT_TRUE(std::isnan(part.errors[0]));
  EXPECT_TRUE(std::isnan(part.errors[1]));
  EXPECT_GT(part.errors[2], 0.05);
  EXPECT_EQ(part.doubt,
            "the companion with larger elements has nothing of worn_volume, wear_depth, where the "
            "run has some: the error is not known");
  EXPECT_TRUE(std::isnan(Budget{.values = values, .parts = {part}}.total(0)));
}

/// The run changes by 2 % to elements four times as large: its error is not 240 %.
TEST(Extrapolation, OfCoarseMeshesIsNotFarMoreThanTheRunAllows) {
  std::vector<double> errors = {2.4, 0.01, not_known, 0.5};
  const std::vector<double> fine = {-0.02, 0.02, 0.02, not_known},
                            coarse = {0.02, 0.02, 0.02, 0.02};
  respect_run(fine, coarse, 1, errors);  // of the same elements nothing is known
  EXPECT_EQ(errors[0], 2.4);
  respect_run(fine, coarse, 4, errors);
  EXPECT_NEAR(errors[0], 0.02, 1e-15);
  EXPECT_EQ(errors[1], 0.01);
  EXPECT_TRUE(std::isnan(errors[2]));
  EXPECT_EQ(errors[3], 0.5);
  errors = {0.5};  // one of the differences is small by chance
  respect_run({0}, {0.07}, 4, errors);
  EXPECT_NEAR(errors[0], 0.03, 1e-15);
}

TEST(Extrapolation, OfAnAreaIsAtLeastWhatItsLastNodesLeaveOpen) {
  Goals goals;
  goals.values = {{"contact_area", "mm^2", 1}, {"mean_pressure", "MPa", 1},
                  {"approach", "mm", 1},       {"inner_pressure", "MPa", 1},
                  {"max_pressure", "MPa", 1},  {"wear_depth", "mm", 1}};
  goals.area = 0.03, goals.pressure_open = 0.02;
  goals.peak_at_edge = 0.2, goals.depth_at_edge = 0.1;
  std::vector<double> errors = {0.01, -0.05, 0.01, -0.01, 0.01, -0.01};
  respect_area(goals, errors);
  EXPECT_EQ(errors, (std::vector<double>{0.03, 0.05, 0.01, 0.03, 0.2, 0.1}));
  errors[0] = not_known;
  respect_area(goals, errors);
  EXPECT_TRUE(std::isnan(errors[0]));
}

/// The cam and follower of 12 phases on elements of twice the size; on its own the depth changes by
/// 10 %.
TEST(Extrapolation, OfPhasesIsInTheDepthAtLeastThatOfTheProfile) {
  const std::vector<Scalar> values = {
      {"worn_volume", "mm^2", 1}, {"wear_depth", "mm", 1}, {"profile", "mm", 1}};
  std::vector<double> errors = {0.0013, 0.0027, 0.14};
  respect_profile(values, errors);
  EXPECT_EQ(errors, (std::vector<double>{0.0013, 0.14, 0.14}));
  errors = {0.0013, 0.2, not_known};
  respect_profile(values, errors);
  EXPECT_EQ(errors[1], 0.2);
}

}  // namespace
}  // namespace gnomon::budget
