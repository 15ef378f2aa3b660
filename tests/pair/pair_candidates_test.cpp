// Which facets of a master a slave may meet, as bodies move.
#include <fmt/format.h>

#include <cmath>
#include <gnomon/run/run.hpp>

#include "part/part_scene.hpp"

namespace gnomon::pair_candidates_test {
namespace {

using namespace testing;

class PairCandidates : public PartScenes {};

/// A stiff cap of a cylinder that does not wear sinks into a flat one over many fine facets, which
/// it then meets beside those that it faced at first: a segment of a circle wears off.
TEST_F(PairCandidates, WhatSinksMeetsOtherFacets) {
  folder_.write("cap.geo", R"(R = 6; w = 1.5; e = R - Sqrt(R * R - w * w); n = 150;
Point(1) = {0, 0, 0}; Point(2) = {0, R, 0}; Point(3) = {w, e, 0};
Point(4) = {w, 1.5, 0}; Point(5) = {0, 1.5, 0};
Circle(1) = {1, 2, 3}; Line(2) = {3, 4}; Line(3) = {4, 5}; Line(4) = {5, 1};
Point(11) = {0, 0, 0}; Point(12) = {w, 0, 0}; Point(13) = {w, -1.5, 0}; Point(14) = {0, -1.5, 0};
Line(11) = {12, 11}; Line(12) = {11, 14}; Line(13) = {14, 13}; Line(14) = {13, 12};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Curve Loop(11) = {11 : 14}; Plane Surface(11) = {11};
Transfinite Curve {1, 3} = n + 1; Transfinite Curve {11, 13} = n + 3;
Transfinite Curve {2, 4, 12, 14} = 5;
Transfinite Surface {1}; Transfinite Surface {11}; Recombine Surface {1, 11};
Physical Surface("cap") = {1}; Physical Surface("flat") = {11};
Physical Curve("round") = {1}; Physical Curve("top") = {3}; Physical Curve("middle") = {4, 12};
Physical Curve("face") = {11}; Physical Curve("base") = {13};
)");
  constexpr double a = 1.2, R = 6, rate = 2e-8 * 50 * 100;
  const double segment = R * R * std::asin(a / R) - a * std::sqrt(R * R - a * a);
  const auto model = this->model(fmt::format(R"(problem = "worn_body"
mesh.file = "cap.geo"
body = [ {{ name = "cap", young_modulus = 1e7, poisson_ratio = 0.3, material = "linear" }},
         {{ name = "flat", young_modulus = 4e3, poisson_ratio = 0.3, material = "linear" }} ]
pair = [ {{ bodies = ["cap", "flat"] }} ]
motion = [ {{ body = "flat", velocity = [0.0, 0.0, 100.0] }} ]
support = [ {{ on = "base" }}, {{ on = "middle", directions = ["x"] }} ]
load = [ {{ on = "top", force = [0.0, -25.0] }} ]
wear = {{ on = ["face"], coefficient = 2e-8 }}
shape.motion = "gap"
time.end = {}
)",
                                             segment / rate));
  IntegratorSettings settings = controlled_settings(*model, 1e-3, segment / rate);
  settings.settled = {segment / rate};
  const RunOutcome end =
      run(*model, Integrators::find("esdirk-3", "integrator"), settings, {}, nullptr, {});
  ASSERT_EQ(end.status, RunOutcome::Status::finished) << end.diagnosis;
  EXPECT_GT(end.epochs, 1);
  const auto last = [&](const char* name) { return value_of(end.last->scalars, name).value(); };
  EXPECT_NEAR(2 * last("worn_volume") / segment, 1, 0.01);
  EXPECT_NEAR(2 * last("contact_half_width"), a, 0.02);
  EXPECT_LT(last("max_pressure") * 2 * a / 50, 1.1);
}

}  // namespace
}  // namespace gnomon::pair_candidates_test
