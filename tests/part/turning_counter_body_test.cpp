// A counter-body that changes its place as it turns.
#include <cmath>
#include <gnomon/run/run.hpp>
#include <string>

#include "part/part_scene.hpp"

namespace gnomon::turning_counter_body_test {
namespace {

using namespace testing;

class TurningCounterBody : public PartScenes {};

constexpr const char* block = R"(
Point(1) = {-1, -1, 0}; Point(2) = {1, -1, 0}; Point(3) = {1, 0, 0}; Point(4) = {-1, 0, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 21; Transfinite Curve {2, 4} = 5;
Transfinite Surface {1}; Recombine Surface {1};
Physical Surface("block") = {1}; Physical Curve("bottom") = {1}; Physical Curve("top") = {3};
)";

/// A cylinder that turns about an axis beside its own, once in 2 s, and touches for a part of each
/// turn.
std::string cam(const std::string& motion, const std::string& more) {
  return R"(problem = "worn_body"
mesh.file = "block.geo"
body = { young_modulus = 1000, poisson_ratio = 0.3, material = "linear" }
support = [ { on = "bottom" } ]
wear = { on = "top", coefficient = 1e-5 }
time.end = 4
[counter_body]
shape = "cylinder"
radius = 5
center = [0.0, 5.0]
press = { direction = [0, -1], approach = -0.035 }
)" + motion +
         more;
}

// Against the mean over the turn, which is another model; an error estimate alone steps over all
// contact.
TEST_F(TurningCounterBody, StepsDoNotPassOverItsContact) {
  folder_.write("block.geo", block);
  const auto worn = [&](const std::string& scene, const char* integrator) {
    const auto model = this->model(scene);
    const RunOutcome end = run(*model, Integrators::find(integrator, "integrator"),
                               controlled_settings(*model, 1e-4, 4), {}, nullptr, {});
    EXPECT_EQ(end.status, RunOutcome::Status::finished) << end.diagnosis;
    return end.last ? value_of(end.last->scalars, "worn_volume").value() : 0;
  };
  const double mean = worn(cam("motion = { center = [0.0, 4.98] }\n",
                               "[cycle]\nperiod = 2\nphases = 128\nrotation = \"2*pi*tau\"\n"),
                           "esdirk-3");
  const std::string turns =
      cam("motion = { center = [0.0, 4.98], rotation = 3.141592653589793 }\n", "");
  for (const char* integrator : {"esdirk-3", "bdf", "erk-3", "theta"})
    EXPECT_NEAR(worn(turns, integrator) / mean, 1, 0.03) << integrator;
}

TEST_F(TurningCounterBody, FixedStepsAreThatShort) {
  folder_.write("block.geo", block);
  const std::string turns =
      cam("motion = { center = [0.0, 4.98], rotation = 3.141592653589793 }\n", "");
  EXPECT_THAT(refusal(turns, {"integrator.step=0.2"}),
              ::testing::HasSubstr("integrator.step: expected at most 0.125 s"));
}

}  // namespace
}  // namespace gnomon::turning_counter_body_test
