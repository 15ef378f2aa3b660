// Several pairs over one cycle: each divides it where it reverses.

#include <cmath>

#include "part/part_scene.hpp"

namespace gnomon::reversals_test {
namespace {

using namespace testing;

class Reversals : public PartScenes {};

/// Three flat bodies on each other; the upper one moves to and fro once in the cycle, the lower one
/// twice, by half as much.
constexpr const char* scene = R"scene(
problem = "worn_body"
mesh.file = "three.geo"
body = [ { name = "top", young_modulus = 1e5, poisson_ratio = 0.3, material = "linear" },
         { name = "mid", young_modulus = 1e5, poisson_ratio = 0.3, material = "linear" },
         { name = "low", young_modulus = 1e5, poisson_ratio = 0.3, material = "linear" } ]
pair = [ { bodies = ["top", "mid"] }, { bodies = ["low", "mid"] } ]
support = [ { on = "floor" }, { on = "lid", directions = ["x"] },
            { on = "sides", directions = ["x"] } ]
load = [ { on = "lid", force = [0.0, -30.0] } ]
cycle = { period = 0.5, phases = 16 }
time.cycles = 10
[[motion]]
body = "top"
cycle = { x = "4*sin(2*pi*tau)" }
[[motion]]
body = "low"
cycle = { x = "2*sin(4*pi*tau)" }
[wear]
on = ["under", "face"]
coefficient = 1e-7
)scene";

constexpr const char* three = R"(
Macro Slab
 Point(b+1) = {-w,y,0,1}; Point(b+2) = {w,y,0,1}; Point(b+3) = {w,y+2,0,1};
 Point(b+4) = {-w,y+2,0,1};
 Line(b+1) = {b+1,b+2}; Line(b+2) = {b+2,b+3}; Line(b+3) = {b+3,b+4}; Line(b+4) = {b+4,b+1};
 Curve Loop(b+1) = {b+1:b+4}; Plane Surface(b+1) = {b+1};
Return
b = 0; w = 15; y = -2; Call Slab;
b = 10; w = 8; y = 0; Call Slab;
b = 20; w = 15; y = 2; Call Slab;
Physical Surface("low") = {1}; Physical Surface("mid") = {11}; Physical Surface("top") = {21};
Physical Curve("floor") = {1}; Physical Curve("lid") = {23}; Physical Curve("sides") = {12};
Physical Curve("under") = {13}; Physical Curve("face") = {3};
)";

// k F times the mean speed: the path is 16 mm a cycle on both. Gauss's formula with 4 phases from
// one reversal to the next is right to 1e-4.
TEST_F(Reversals, OfAllPairsDivideTheCycle) {
  folder_.write("three.geo", three);
  const auto model = this->model(scene);
  Counters counters;
  const State start = model->start(counters);
  const double by_hand = 1e-7 * 30 * 16 / 0.5;
  EXPECT_NEAR(observed(*model, start, "wear_flux_mid"), by_hand, 1e-3 * by_hand);
  EXPECT_NEAR(observed(*model, start, "wear_flux_low"), by_hand, 1e-3 * by_hand);
}

}  // namespace
}  // namespace gnomon::reversals_test
