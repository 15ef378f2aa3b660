// Laws that fall with the depth: what they wear, and whether the default tolerance resolves it.

#include <fmt/format.h>

#include <cmath>
#include <gnomon/model/wear_scene.hpp>
#include <gnomon/wear_laws/wear_law_kind.hpp>

#include "support/problem_run.hpp"

namespace gnomon::falling_law_test {
namespace {

using namespace testing;

double depth_of(const std::string& rate, double nominal) {
  ExpressionNames names;
  names.variables = wear_law_variables();
  const WearLaw law = expression_wear_law(Expression(rate, names), 100, 1000);
  return depth_by_law(law, {.pressure = 20, .speed = 1000, .duration = 100}, nominal);
}

/// dh/dt = r exp(-h/h0): h = h0 ln(1 + r t / h0).
TEST(FallingLaw, ItsDepthIsThatOfItsClosedForm) {
  for (const double h0 : {1e-2, 1e-4, 1e-6, 1e-8})
    EXPECT_NEAR(depth_of(fmt::format("1e-7*p*v*exp(-h/{})", h0), 0.2) / (h0 * std::log1p(0.2 / h0)),
                1, 0.06);
  // 1 + h / 0.01 times as slow: h + h^2 / 0.02 = 0.2.
  EXPECT_NEAR(depth_of("1e-7*p*v/(1+h/0.01)", 0.2), std::sqrt(1e-4 + 0.004) - 0.01, 1e-3);
  EXPECT_NEAR(depth_of("1e-7*p*v*if(h<0.003,1,0)", 0.2) / 0.003, 1, 0.16);  // to a step of the grid
}

/// To the last digit, so that scales do not change.
TEST(FallingLaw, WhatDoesNotFallWearsTheNominalDepth) {
  for (const char* rate : {"1e-7*p*v", "1e-7*p*v*(1+h/0.01)", "1e-7*p*v*if(t<50,1,2)"})
    EXPECT_EQ(depth_of(rate, 0.2), 0.2) << rate;
  EXPECT_EQ(depth_of("1e-7*max(p-1e6,0)*v", 0.2), 0.2);  // wears nothing at this pressure
  EXPECT_EQ(depth_of("1e-7*p*v*exp(-h/0.01)", 0), 0);
}

/// A flat pin on springs, under a uniform pressure.
TEST(FallingLaw, TheDefaultToleranceResolvesIt) {
  for (const double h0 : {0.05, 1e-3, 1e-5, 1e-7}) {
    const auto model = make_model(parse_scene(fmt::format(R"toml(problem = "winkler"
pin = {{ radius = 1e9, width = 10.0 }}
foundation = {{ modulus = 70.33, points = 11 }}
load.force = 20.0
time.end = 1000.0
[wear]
coefficient = 1e-7
velocity = 1000.0
rate = "k*p*v*exp(-h/h0)"
constants = {{ h0 = {} }}
)toml",
                                                          h0),
                                              "pin.toml", {}, key_table));
    const double exact = h0 * std::log1p(0.2 / h0);
    EXPECT_NEAR(model->differential_scale / exact, 1, 0.06);
    const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-4, 1000);
    EXPECT_NEAR(observed(*model, run.last(), "wear_depth") / exact, 1, 1e-3) << h0;
  }
}

}  // namespace
}  // namespace gnomon::falling_law_test
