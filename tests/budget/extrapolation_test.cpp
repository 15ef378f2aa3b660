// Errors from the differences of two and three meshes.

#include "budget/extrapolation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace gnomon::budget {
namespace {

// Values 1 + c h^p on h, 2h and 4h: the error of the first is c h^p.
TEST(Extrapolation, FindsAnErrorOfOrderOneToTwo) {
  for (const double order : {1.0, 1.5, 2.0}) {
    const auto value = [&](double h) { return 1 + 0.01 * std::pow(h, order); };
    const auto [error, found] = extrapolated(value(2) - value(1), value(4) - value(2));
    EXPECT_NEAR(error, 0.01, 1e-12);
    EXPECT_NEAR(found, order, 1e-9);
  }
}

TEST(Extrapolation, DoesNotBelieveInLowOrders) {
  EXPECT_EQ(extrapolated(0.01, 0.015).order, 1);  // 0.58 by the differences
  EXPECT_EQ(extrapolated(0.01, 0.01).order, usual_order);
  EXPECT_EQ(extrapolated(0.01, -0.02).order, usual_order);
  EXPECT_EQ(extrapolated(0.01, not_known).order, usual_order);
}

TEST(Extrapolation, OfAnAreaIsAtLeastWhatItsLastNodesLeaveOpen) {
  Goals goals;
  goals.values = {{"contact_area", "mm^2", 1},
                  {"mean_pressure", "MPa", 1},
                  {"approach", "mm", 1},
                  {"inner_pressure", "MPa", 1}};
  goals.area = 0.03, goals.pressure_open = 0.02;
  std::vector<double> errors = {0.01, -0.05, 0.01, -0.01};
  respect_area(goals, errors);
  EXPECT_EQ(errors, (std::vector<double>{0.03, 0.05, 0.01, 0.03}));
  errors[0] = not_known;
  respect_area(goals, errors);
  EXPECT_TRUE(std::isnan(errors[0]));
}

}  // namespace
}  // namespace gnomon::budget
