// A counter-body that follows an inclined surface over a cycle.
#include <cmath>

#include "part/part_scene.hpp"

namespace gnomon::followed_slope_test {
namespace {

using namespace testing;

class FollowedSlope : public PartScenes {};

/// A block with its top inclined by 25 degrees, against a plane that goes to and fro.
constexpr const char* slope = R"scene(
problem = "worn_body"
mesh.file = "block.geo"
body = { young_modulus = 1e4, poisson_ratio = 0.3, material = "linear" }
support = [ { on = "bottom" } ]
wear = { on = ["face"], coefficient = 1e-5 }
cycle = { period = 1.0, phases = 32, x = "0.3*sin(2*pi*tau)" }
time.cycles = 10
[counter_body]
shape = "plane"
center = [0.0, 0.0]
normal = [0.4663076581549986, -1.0]
press = { direction = [0.0, -1.0], force = 10.0 }
)scene";

constexpr const char* block = R"(T = 0.4663076581549986;
Point(1) = {-2, -4, 0}; Point(2) = {2, -4, 0}; Point(3) = {2, 2 * T, 0}; Point(4) = {-2, -2 * T, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 13; Transfinite Curve {2, 4} = 9;
Transfinite Surface {1}; Recombine Surface {1};
Physical Surface("block") = {1}; Physical Curve("bottom") = {1}; Physical Curve("face") = {3};
)";

// It moves by x tan(a): of the sliding speed cos(a) x' the part tan(a)^2 is left out, but for what
// the cycle gives with x.
TEST_F(FollowedSlope, IsToldByThePartThatWearLeavesOut) {
  folder_.write("block.geo", block);
  const auto part = [&](const Overrides& overrides) {
    const auto model = this->model(slope, overrides);
    Counters counters;
    return model->examine(model->start(counters)).unseen_sliding.value().part;
  };
  const double whole = std::pow(0.4663076581549986, 2);
  EXPECT_NEAR(part({}), whole, 0.02 * whole);
  EXPECT_LT(part({"cycle.y=0.4663076581549986*0.3*sin(2*pi*tau)"}), 0.005);
}

}  // namespace
}  // namespace gnomon::followed_slope_test
