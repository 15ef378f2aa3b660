// Explicit methods in closed contact, where stability limits their steps.
#include <gmock/gmock.h>

#include "part/part_scene.hpp"

namespace gnomon::explicit_steps_test {
namespace {

using namespace testing;

class ExplicitSteps : public PartScenes {};

// Of a law with a threshold, the mean rate of pressures that oscillate about it is larger than that
// of their mean. All 4 mm wear above it: by 5 k v t (F - 4 p0) altogether.
TEST_F(ExplicitSteps, DoNotLetPressuresOscillateAboutAThreshold) {
  folder_.write("block.geo", R"(Point(1) = {-2, 0, 0}; Point(2) = {2, 0, 0};
Point(3) = {2, 2, 0}; Point(4) = {-2, 2, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 17; Transfinite Curve {2, 4} = 9;
Transfinite Surface {1}; Recombine Surface {1};
Physical Curve("sole") = {1}; Physical Curve("top") = {3}; Physical Surface("block") = {1};
)");
  const auto block = model(R"(problem = "worn_body"
mesh.file = "block.geo"
body = { young_modulus = 2000.0, poisson_ratio = 0.35, material = "linear" }
shape.motion = "gap"
support = [ { on = "top" } ]
wear = { on = ["sole"], coefficient = 1e-8, rate = "k*max(p-18,0)*v*5" }
time.end = 20000.0
[counter_body]
shape = "plane"
normal = [0.0, 1.0]
motion = { velocity = [0.0, 0.0, 100.0] }
press = { direction = [0.0, 1.0], force = 84.0 }
)");
  const double worn = 5e-8 * 100 * 20000 * (84 - 4 * 18);
  for (const auto& [method, rtol] : {std::pair{"erk-2", 1e-2}, {"erk-3", 1e-3}, {"erk-4", 1e-2}}) {
    SCOPED_TRACE(method);
    const ModelRun run = run_model(*block, method, 0, rtol, 20000);
    EXPECT_NEAR(observed(*block, run.last(), "worn_volume") / worn, 1, 0.01);
  }
}

}  // namespace
}  // namespace gnomon::explicit_steps_test
