// Every Runge-Kutta method of the registry: order conditions, stability and the statements of its
// entry.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/stability/stability.hpp>
#include <string>

namespace gnomon::table_test {
namespace {

using Vec = Eigen::VectorXd;

struct Condition {
  int order;
  double weight;  ///< elementary weight
  double value;   ///< 1 / density of the rooted tree
};

/// All order conditions up to order five (Butcher; Hairer, Norsett and Wanner I, table II.2.2).
std::vector<Condition> conditions(const Eigen::MatrixXd& A, const Vec& b, const Vec& c) {
  const Vec one = Vec::Ones(b.size()), c2 = c.cwiseProduct(c), c3 = c2.cwiseProduct(c);
  const Vec Ac = A * c, Ac2 = A * c2, AAc = A * Ac;
  const auto w = [&](const Vec& v) { return b.dot(v); };
  return {{1, w(one), 1},
          {2, w(c), 1. / 2},
          {3, w(c2), 1. / 3},
          {3, w(Ac), 1. / 6},
          {4, w(c3), 1. / 4},
          {4, w(c.cwiseProduct(Ac)), 1. / 8},
          {4, w(Ac2), 1. / 12},
          {4, w(AAc), 1. / 24},
          {5, w(c3.cwiseProduct(c)), 1. / 5},
          {5, w(c2.cwiseProduct(Ac)), 1. / 10},
          {5, w(Ac.cwiseProduct(Ac)), 1. / 20},
          {5, w(c.cwiseProduct(Ac2)), 1. / 15},
          {5, w(A * c3), 1. / 20},
          {5, w(c.cwiseProduct(AAc)), 1. / 30},
          {5, w(A * c.cwiseProduct(Ac)), 1. / 40},
          {5, w(A * Ac2), 1. / 60},
          {5, w(A * AAc), 1. / 120}};
}

/// The order up to which all conditions hold.
int order_of(const ButcherTable& table, const Vec& b) {
  int order = 5;
  for (const Condition& condition : conditions(table.A, b, table.c))
    if (std::abs(condition.weight - condition.value) > 1e-12)
      order = std::min(order, condition.order - 1);
  return order;
}

class Tables : public ::testing::TestWithParam<std::string> {
protected:
  void SetUp() override {
    const Integrator& integrator = Integrators::find(GetParam(), "integrator");
    claims_ = integrator.stability;
    order_ = std::stoi(integrator.order);
    estimate_ = integrator.error_estimate;
    for (double alpha : {0.5, 1.0, 0.7}) {
      IntegratorSettings settings;
      settings.own["integrator.alpha"] = alpha;
      tables_.push_back(integrator.table(settings).value());
      if (GetParam() != "theta") break;
    }
  }
  bool claims(const std::string& what) const { return claims_.find(what) != std::string::npos; }

  std::string claims_, estimate_;
  int order_ = 0;
  std::vector<ButcherTable> tables_;
};

TEST_P(Tables, SatisfiesTheOrderConditionsUpToItsOrderOnly) {
  for (const ButcherTable& table : tables_) {
    EXPECT_EQ(order_of(table, table.b), table.order);
    EXPECT_LT((table.A.rowwise().sum() - table.c).cwiseAbs().maxCoeff(), 1e-13);
    if (GetParam() != "theta") {
      EXPECT_EQ(table.order, order_);
    }
    if (table.embedded_order == 0) continue;
    EXPECT_GE(order_of(table, table.b_embedded), table.embedded_order);
    EXPECT_THAT(estimate_, ::testing::HasSubstr(std::to_string(table.embedded_order)));
  }
}

TEST_P(Tables, IsDiagonallyImplicit) {
  for (const ButcherTable& table : tables_)
    for (int i = 0; i < table.stages(); ++i)
      for (int j = i + 1; j < table.stages(); ++j) EXPECT_EQ(table.A(i, j), 0);
}

TEST_P(Tables, HasTheStabilityItClaims) {
  const double at_infinity = std::abs(stability_function(tables_[0], -1e6));  // L: falls as 1/z
  if (claims("conditional")) {
    EXPECT_GT(at_infinity, 1);
    return;
  }
  EXPECT_EQ(claims("stiffly accurate"), tables_[0].stiffly_accurate());
  EXPECT_EQ(claims(" L"), at_infinity < 1e-4) << at_infinity;
  // A: bounded on the imaginary axis, poles (at 1 / A_ii) in the right half plane.
  for (const ButcherTable& table : tables_) {
    EXPECT_GE(table.A.diagonal().minCoeff(), 0);
    for (double y = 1e-3; y < 1e6; y *= 1.05)
      EXPECT_LE(std::abs(stability_function(table, {0, y})), 1 + 1e-12) << y;
  }
}

/// "z > -2.5": the end of an explicit method's interval on the negative axis.
TEST_P(Tables, ExplicitOnesStateTheirInterval) {
  const std::size_t at = claims_.find("z > -");
  if (at == std::string::npos) GTEST_SKIP() << "states none";
  const double end = std::stod(claims_.substr(at + 5));
  EXPECT_LE(std::abs(stability_function(tables_[0], -0.97 * end)), 1);
  EXPECT_GT(std::abs(stability_function(tables_[0], -1.03 * end)), 1);
}

std::vector<std::string> with_tables() {
  std::vector<std::string> names;
  for (const Integrator& integrator : Integrators::all())
    if (integrator.table({})) names.push_back(integrator.name);
  return names;
}

std::string parameter_name(const ::testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, Tables, ::testing::ValuesIn(with_tables()), parameter_name);

/// A method of a plug-in with a slip of the pen.
TEST(Table, WhatIsNoMethodIsRefused) {
  const auto refusal = [](auto&& spoil) -> std::string {
    const double gamma = (3 + std::sqrt(3.0)) / 6;
    ButcherTable table{"own", 3, Eigen::MatrixXd(2, 2), Vec(2), Vec(2), 1, Vec(2)};
    table.A << gamma, 0, 1 - 2 * gamma, gamma;
    table.b << 0.5, 0.5;
    table.c << gamma, 1 - gamma;
    table.b_embedded << 1, 0;
    spoil(table);
    try {
      checked_table(table);
    } catch (const RegistrationError& error) {
      return error.what();
    }
    return "";
  };
  using ::testing::HasSubstr;
  EXPECT_EQ(refusal([](ButcherTable&) {}), "");
  EXPECT_THAT(refusal([](ButcherTable& table) { table.b = Vec::Constant(3, 1. / 3); }),
              HasSubstr("\"own\": expected A, b, c, and b_embedded"));
  EXPECT_THAT(refusal([](ButcherTable& table) { table.b_embedded = {}; }), HasSubstr("b_embedded"));
  EXPECT_THAT(refusal([](ButcherTable& table) { table.A(1, 0) = NAN; }), HasSubstr("finite"));
  EXPECT_THAT(refusal([](ButcherTable& table) { table.A(0, 1) = 0.3; }), HasSubstr("triangular"));
  EXPECT_THAT(refusal([](ButcherTable& table) { table.c(1) = 0.9; }), HasSubstr("c = A 1"));
  EXPECT_THAT(refusal([](ButcherTable& table) { table.b(1) = 0.6; }), HasSubstr("order 3"));
  EXPECT_THAT(refusal([](ButcherTable& table) { table.order = 4; }), HasSubstr("order 4"));
  EXPECT_THAT(refusal([](ButcherTable& table) { table.embedded_order = 2; }),
              HasSubstr("order 2 to hold for b_embedded"));
}

TEST(Registry, HasTheFamiliesOfTheDesign) {
  EXPECT_THAT(with_tables(),
              ::testing::IsSupersetOf({"forward-euler", "backward-euler", "theta", "erk-2", "erk-3",
                                       "erk-4", "sdirk-2", "esdirk-3", "esdirk-4", "esdirk-5"}));
  EXPECT_NO_THROW(Integrators::find("bdf", "integrator"));
}

}  // namespace
}  // namespace gnomon::table_test
