// The sliding distance s = v t of wear laws of pairs, whose speed v is that where they touch.

#include <cmath>

#include "part/part_scene.hpp"

namespace gnomon::sliding_distance_test {
namespace {

using namespace testing;

/// Two blocks on each other and, beside them, a pin with a round end on a flat.
const char* const mesh = R"(
Point(1) = {0, -3, 0, 1}; Point(2) = {4, -3, 0, 1}; Point(3) = {4, 0, 0, 1};
Point(4) = {0, 0, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Point(5) = {0, 0, 0, 1}; Point(6) = {4, 0, 0, 1}; Point(7) = {4, 3, 0, 1}; Point(8) = {0, 3, 0, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Curve Loop(2) = {5, 6, 7, 8}; Plane Surface(2) = {2};
Transfinite Curve {1:4} = 5; Transfinite Curve {5:8} = 6; Transfinite Surface {1, 2};
Point(11) = {10, 0, 0, 0.3}; Point(12) = {22, 0, 0, 0.3}; Point(13) = {22, -4, 0, 1};
Point(14) = {10, -4, 0, 1};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(3) = {11, 12, 13, 14}; Plane Surface(3) = {3};
Point(21) = {12, 4, 0, 0.3}; Point(22) = {16, 0, 0, 0.3}; Point(23) = {20, 4, 0, 0.3};
Point(24) = {20, 6, 0, 1}; Point(25) = {12, 6, 0, 1}; Point(26) = {16, 4, 0};
Circle(21) = {21, 26, 22}; Circle(22) = {22, 26, 23}; Line(23) = {23, 24}; Line(24) = {24, 25};
Line(25) = {25, 21};
Curve Loop(4) = {21, 22, 23, 24, 25}; Plane Surface(4) = {4};
Physical Surface("track") = {1}; Physical Surface("block") = {2};
Physical Surface("flat") = {3}; Physical Surface("pin") = {4};
Physical Curve("face") = {5}; Physical Curve("round") = {21, 22};
Physical Curve("bases") = {1, 13}; Physical Curve("sides") = {7, 23, 25};
Physical Curve("top") = {7}; Physical Curve("head") = {24};
)";

const char* const text = R"toml(
problem = "worn_body"
mesh.file = "pairs.geo"
body = [ { name = "track", young_modulus = 1000.0, poisson_ratio = 0.0, material = "linear" },
         { name = "block", young_modulus = 1000.0, poisson_ratio = 0.0, material = "linear" },
         { name = "flat", young_modulus = 1000.0, poisson_ratio = 0.3, material = "linear" },
         { name = "pin", young_modulus = 3000.0, poisson_ratio = 0.3, material = "linear" } ]
pair = [ { bodies = ["block", "track"] }, { bodies = ["pin", "flat"] } ]
support = [ { on = "bases" }, { on = "sides", directions = ["x"] } ]
load = [ { on = "top", force = [0.0, -8.0] }, { on = "head", force = [0.0, -15.0] } ]
[shape]
motion = "gap"
[wear]
on = ["face", "round"]
coefficient = 1e-7
rate = "k * p * v * exp(-s / 1e5)"
[time]
end = 3000.0
[[motion]]
body = "track"
)toml";

using SlidingDistance = PartScenes;

// Each pair counts its own, the round one by the speed at its lowest point.
TEST_F(SlidingDistance, IsOfTheSpeedWhereAPairTouches) {
  folder_.write("pairs.geo", mesh);
  const auto model = this->model(std::string(text) +
                                 "velocity = [20.0, 0.0]\n"
                                 "[[motion]]\nbody = \"flat\"\nvelocity = [100.0, 0.0]\n");
  EXPECT_THAT(model->remarks,
              ::testing::Contains(::testing::HasSubstr("20 mm/s on \"face\", 100 mm/s on ")));
  const State end = run_model(*model, "esdirk-3", 0, 1e-5, 3000).last();
  const double s0 = 1e5;
  EXPECT_NEAR(observed(*model, end, "worn_volume_block") / (1e-7 * 8 * s0 * -std::expm1(-0.6)), 1,
              1e-4);
  EXPECT_NEAR(observed(*model, end, "worn_volume_pin") / (1e-7 * 15 * s0 * -std::expm1(-3.0)), 1,
              5e-4);
}

// By the mean over the cycle, of which phases are not equally far apart.
TEST_F(SlidingDistance, IsOfTheMeanSpeedOfACycle) {
  folder_.write("pairs.geo", mesh);
  const auto model = this->model(std::string(text) +
                                 "cycle = { x = \"0.1*sin(2*pi*tau)\" }\n"
                                 "[[motion]]\nbody = \"flat\"\n"
                                 "cycle = { x = \"0.5*sin(2*pi*tau)\" }\n"
                                 "[cycle]\nperiod = 0.02\nphases = 8\n");
  const State end = run_model(*model, "esdirk-3", 0, 1e-5, 3000).last();
  const double s0 = 1e5;
  EXPECT_NEAR(observed(*model, end, "worn_volume_block") / (1e-7 * 8 * s0 * -std::expm1(-0.6)), 1,
              2e-3);
  EXPECT_NEAR(observed(*model, end, "worn_volume_pin") / (1e-7 * 15 * s0 * -std::expm1(-3.0)), 1,
              2e-3);
}

}  // namespace
}  // namespace gnomon::sliding_distance_test
