// A body between two others.

#include <cmath>
#include <map>

#include "part/part_scene.hpp"

namespace gnomon::three_bodies_test {
namespace {

using namespace testing;

/// Half of a roller of radius 5 between two plates, symmetric about x = 0.
constexpr const char* geometry = R"(
f = 0.03;
Point(1) = {0, 0, 0, f}; Point(2) = {0, 5, 0, 1}; Point(3) = {5, 5, 0, 1}; Point(4) = {0, 10, 0, f};
Circle(1) = {1, 2, 3}; Circle(2) = {3, 2, 4}; Line(3) = {4, 2}; Line(4) = {2, 1};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Point(11) = {0, 0, 0, f}; Point(12) = {6, 0, 0, 1}; Point(13) = {6, -4, 0, 1};
Point(14) = {0, -4, 0, 1};
Line(11) = {11, 14}; Line(12) = {14, 13}; Line(13) = {13, 12}; Line(14) = {12, 11};
Curve Loop(11) = {11 : 14}; Plane Surface(11) = {11};
Point(21) = {0, 10, 0, f}; Point(22) = {6, 10, 0, 1}; Point(23) = {6, 14, 0, 1};
Point(24) = {0, 14, 0, 1};
Line(21) = {21, 22}; Line(22) = {22, 23}; Line(23) = {23, 24}; Line(24) = {24, 21};
Curve Loop(21) = {21 : 24}; Plane Surface(21) = {21};
Physical Surface("roller") = {1}; Physical Surface("lower") = {11};
Physical Surface("upper") = {21}; Physical Curve("round") = {1, 2}; Physical Curve("face") = {14};
Physical Curve("ceiling") = {21}; Physical Curve("base") = {12}; Physical Curve("top") = {23};
Physical Curve("axes") = {3, 4, 11, 24};
)";

constexpr const char* scene = R"(
problem = "worn_body"
[mesh]
file = "three.geo"
[[body]]
name = "roller"
young_modulus = 2e5
poisson_ratio = 0.3
[[body]]
name = "lower"
young_modulus = 2e5
poisson_ratio = 0.3
[[body]]
name = "upper"
young_modulus = 2e5
poisson_ratio = 0.3
[[pair]]
bodies = ["roller", "lower"]
[[pair]]
bodies = ["roller", "upper"]
[[motion]]
body = "roller"
velocity = [0.0, 0.0, 100.0]
[[support]]
on = "base"
[[support]]
on = "axes"
directions = ["x"]
[[load]]
on = "top"
force = [0.0, -100.0]
[wear]
on = ["round", "face", "ceiling"]
coefficient = 1e-9
[time]
end = 100.0
)";

class ThreeBodies : public PartScenes {};

// The roller rubs on both plates; each contact is that of Hertz. Two contacts have no common width.
TEST_F(ThreeBodies, ARollerWearsOnBothSides) {
  folder_.write("three.geo", geometry);
  const auto model = this->model(scene, {});
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 100);
  const double work = 100 * 100 * 100;  // of half of the roller
  for (const auto& [body, part] :
       std::map<std::string, double>{{"roller", 2}, {"lower", 1}, {"upper", 1}})
    EXPECT_NEAR(observed(*model, run.last(), "worn_volume_" + body) / (part * 1e-9 * work), 1,
                5e-3);
  const double a = std::sqrt(4 * 200 * 5 * 2 * (1 - 0.09) / (M_PI * 2e5));
  EXPECT_NEAR(observed(*model, run.states.front(), "max_pressure") * M_PI * a / (2 * 200), 1, 0.1);
  EXPECT_FALSE(value_of(model->observe(run.last()), "contact_half_width"));
}

}  // namespace
}  // namespace gnomon::three_bodies_test
