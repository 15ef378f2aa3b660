// Laws that fall with the depth: what they wear, and whether the default tolerance resolves it.

#include <fmt/format.h>

#include <cmath>
#include <gnomon/model/wear_scene.hpp>
#include <gnomon/wear_laws/wear_law_kind.hpp>

#include "part/cyclic_flat.hpp"

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
  // It would add material beyond, where no surface comes.
  EXPECT_NEAR(depth_of("1e-7*p*v*(1-h/0.003)", 0.2) / 0.003, 1, 0.16);
  // It wears at three times the pressure.
  EXPECT_NEAR(depth_of("1e-7*max(p-40,0)*v*exp(-h/1e-4)", 0.2) / (1e-4 * std::log1p(2000)), 1,
              0.06);
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

/// Of a surface that hardly wears the law may be any.
class FallingLaws : public PartScenes {};
TEST_F(FallingLaws, EachSurfaceHasItsOwn) {
  folder_.write("two.geo", R"(
Point(1) = {-6, 0, 0}; Point(2) = {6, 0, 0}; Point(3) = {6, 3, 0}; Point(4) = {-6, 3, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Point(11) = {-3, 3, 0}; Point(12) = {3, 3, 0}; Point(13) = {3, 6, 0}; Point(14) = {-3, 6, 0};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1}; Curve Loop(11) = {11 : 14}; Plane Surface(11) = {11};
Transfinite Curve {1, 3} = 13; Transfinite Curve {2, 4} = 4; Transfinite Surface {1};
Transfinite Curve {11, 13} = 9; Transfinite Curve {12, 14} = 4; Transfinite Surface {11};
Recombine Surface {1, 11};
Physical Surface("plate") = {1}; Physical Surface("block") = {11}; Physical Curve("base") = {1};
Physical Curve("face") = {3}; Physical Curve("sole") = {11}; Physical Curve("top") = {13};
)");
  const auto model = this->model(R"toml(problem = "worn_body"
mesh.file = "two.geo"
body = [ { name = "plate", young_modulus = 7e4, poisson_ratio = 0.3, material = "linear" },
         { name = "block", young_modulus = 3e3, poisson_ratio = 0.3, material = "linear" } ]
pair = [ { bodies = ["block", "plate"] } ]
motion = [ { body = "plate", velocity = [50.0, 0.0] } ]
support = [ { on = "base" }, { on = "top", directions = ["x"] } ]
load = [ { on = "top", force = [0.0, -20.0] } ]
time.end = 1000
[wear]
on = ["face", "sole"]
surfaces.face.coefficient = 1e-12
surfaces.sole.coefficient = 1e-6
surfaces.sole.rate = "k*p*v*exp(-h/1e-6)"
)toml",
                                 {});
  const double exact = 1e-6 * std::log1p(1e-6 * 20 / 6 * 50 * 1000 / 1e-6);
  EXPECT_NEAR(model->differential_scale / exact, 1, 0.1);
  const State end = run_model(*model, "esdirk-3", 0, 1e-4, 1000).last();
  EXPECT_NEAR(observed(*model, end, "worn_volume_block") / (6 * exact), 1, 0.02);
}

/// A cylinder whose wear is far less than its indentation: the scale is that of the depth of its
/// contact.
TEST_F(FallingLaws, ACylinderHasThatOfItsContact) {
  folder_.write("flat.geo", flat_geometry(6));
  const auto model = this->model(R"toml(problem = "worn_body"
mesh.file = "flat.geo"
body = { young_modulus = 1e4, poisson_ratio = 0.3 }
support = [ { on = "bottom" } ]
time.end = 1000
[wear]
on = "surface"
coefficient = 2.9e-6
rate = "k*p*v*exp(-h/1e-7)"
[counter_body]
shape = "cylinder"
radius = 6.0
center = [0.0, 6.0]
motion.velocity = [10.0, 0.0]
press = { direction = [0.0, -1.0], force = 18.5 }
)toml",
                                 {});
  const State end = run_model(*model, "esdirk-3", 0, 1e-3, 1000).last();
  const double scale = model->differential_scale, depth = observed(*model, end, "wear_depth");
  EXPECT_GT(scale, 0.2 * depth);
  EXPECT_LT(scale, 2 * depth);
}

}  // namespace
}  // namespace gnomon::falling_law_test
