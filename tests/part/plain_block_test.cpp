// A block that a plane wears evenly: laws by position, rates of one surface, the end of the block.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <gnomon/run/run.hpp>

#include "part/part_scene.hpp"

namespace gnomon::plain_block_test {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

const char* geometry = R"(
Point(1) = {-10, 0, 0}; Point(2) = {10, 0, 0}; Point(3) = {10, 5, 0}; Point(4) = {-10, 5, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve{1, 3} = 21; Transfinite Curve{2, 4} = 6;
Transfinite Surface{1}; Recombine Surface{1};
Physical Curve("bottom") = {1}; Physical Curve("top") = {3}; Physical Surface("block") = {1};
)";

/// 1 MPa and 100 mm/s on 20 mm, which wear 1e-4 mm/s with k = 1e-6.
const std::string scene = R"toml(
problem = "worn_body"
mesh.file = "block.geo"
[body]
young_modulus = 1000.0
poisson_ratio = 0.0
[[support]]
on = "bottom"
[counter_body]
shape = "plane"
point = [0.0, 5.0]
normal = [0.0, -1.0]
motion = { velocity = [100.0, 0.0] }
press = { direction = [0.0, -1.0], force = 20.0 }
[time]
end = 1000.0
[integrator]
name = "esdirk-3"
[wear]
on = ["top"]
)toml";

class PlainBlock : public PartScenes {
protected:
  PlainBlock() { folder_.write("block.geo", geometry); }
  RunOutcome outcome_of(const Model& model, double end) const {
    return run(model, Integrators::find("esdirk-3", "integrator"),
               controlled_settings(model, 1e-4, end), {}, nullptr, {});
  }
};

// At its middle, one of many places, where a coordinate is zero but for rounding.
TEST_F(PlainBlock, ALawMayVanishSomewhere) {
  const auto worn = [&](const std::string& factor) {
    const auto block = model(scene + "coefficient = 1e-6\nrate = \"k*p*v*" + factor + "\"\n");
    EXPECT_THAT(block->remarks, Not(Contains(HasSubstr("the wear law is 0")))) << factor;
    const RunOutcome outcome = outcome_of(*block, 1000);
    EXPECT_EQ(outcome.status, RunOutcome::Status::finished) << outcome.diagnosis;
    return observed(*block, *outcome.state, "worn_volume");
  };
  EXPECT_NEAR(worn("abs(x0)/5"), worn("(abs(x0)+1e-6)/5"), 1e-5);
  EXPECT_NEAR(worn("x0^2/25"), worn("(x0^2+1e-6)/25"), 1e-5);
  EXPECT_GT(worn("sin(pi*(x0+10)/20)"), 0.1);  // zero at the ends
  // Of two places the first is worn through at a fifth of the depth of the other.
  EXPECT_GT(worn("max(1-h/(0.01*(1+4*(x0+10)/20)),0)"), 0.2);
}

TEST_F(PlainBlock, ASurfaceWithARateOfItsOwnNeedsNoCoefficientThatItDoesNotRead) {
  const std::string own = "rate = \"k*p*v\"\n[wear.surfaces.top]\n";
  const auto block = model(scene + own + "rate = \"1e-6*p*v\"\n");
  EXPECT_NEAR(observed(*block, *outcome_of(*block, 1000).state, "worn_volume"), 2, 1e-4);
  EXPECT_THAT(refusal(scene + own + "rate = \"2*k*p*v\"\n"), HasSubstr("`wear.coefficient`"));
}

// The last, long step would wear off all but 0.004 of it.
TEST_F(PlainBlock, EndsWhereItIsWornAwayAndNotBefore) {
  const double end = 49800;
  const auto block =
      model(scene + "coefficient = 1e-6\nrate = \"k*p*v\"\n", {fmt::format("time.end={}", end)});
  const RunOutcome outcome = outcome_of(*block, end);
  ASSERT_EQ(outcome.status, RunOutcome::Status::failed);
  EXPECT_THAT(outcome.diagnosis, HasSubstr("worn away"));
  const double left = observed(*block, *outcome.state, "element_volume");
  EXPECT_GT(left, 0.01);
  EXPECT_LT(left, 0.02);
}

}  // namespace
}  // namespace gnomon::plain_block_test
