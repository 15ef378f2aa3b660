// Half a body under a counter-body that moves across its plane of symmetry is told.

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "part/part_scene.hpp"

namespace gnomon::symmetry_test {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

class HalfBlock : public PartScenes {
protected:
  void SetUp() override {
    PartScenes::SetUp();
    folder_.write("half.geo", R"geo(
Point(1) = {0, 0, 0}; Point(2) = {8, 0, 0}; Point(3) = {8, 4, 0}; Point(4) = {0, 4, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 17; Transfinite Curve {2, 4} = 9; Transfinite Surface {1}; Recombine Surface {1};
Physical Curve("bottom") = {1}; Physical Curve("top") = {3}; Physical Curve("middle") = {4};
Physical Surface("block") = {1};
)geo");
  }
  /// A cylinder above x = place.
  std::vector<std::string> remarks(const std::string& motion, double friction = 0.3,
                                   double place = 0, const std::string& more = "") const {
    return model(fmt::format(R"(problem = "worn_body"
mesh.file = "half.geo"
time.end = 100.0
[body]
young_modulus = 2e5
poisson_ratio = 0.3
[counter_body]
shape = "cylinder"
radius = 20.0
center = [{}, 24.0]
motion = {{ {} }}
[[counter_body.press]]
direction = [0.0, -1.0]
force = 50.0
[friction]
coefficient = {}
[wear]
on = ["top"]
coefficient = 1e-8
[[support]]
on = "bottom"
[[support]]
on = "middle"
directions = ["x"]
{})",
                             place, motion, friction, more))
        ->remarks;
  }
};

const auto told = Contains(HasSubstr("support_2 holds x where the contact ends, at x = 0 mm"));

TEST_F(HalfBlock, IsToldWhereFrictionActsAcrossThePlane) {
  const std::string across = "velocity = [10.0, 0.0]", out = "velocity = [0.0, 0.0, 10.0]";
  EXPECT_THAT(remarks(across), told);
  EXPECT_THAT(remarks(out, 0.3, 0, "[[counter_body.press]]\ndirection = [1.0, 0.0]\nforce = 5.0\n"),
              told);
  EXPECT_THAT(remarks(across, 0), Not(told));       // pressures are alike on both sides
  EXPECT_THAT(remarks(out), Not(told));             // nothing acts across
  EXPECT_THAT(remarks(across, 0.3, 5), Not(told));  // far from the contact
}

/// A quarter of a ball and a block that slides along x: its plane x = 0 is none of symmetry where
/// friction acts, y = 0 is one.
TEST(QuarterOfAPair, IsToldWhereFrictionActsAcrossThePlane) {
  if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
  const auto remarks = [](const std::string& friction) {
    return make_model(load_scene(shipped("ball_on_block.toml"),
                                 {"mesh.factor=3.5", "pair.1.friction=" + friction}, key_table))
        ->remarks;
  };
  const auto of = [](const char* axis) {
    return Contains(HasSubstr(
        std::string(" = 0 mm, and 100 % of the partner's motion or force is along ") + axis));
  };
  EXPECT_THAT(remarks("0.1"), of("x"));
  EXPECT_THAT(remarks("0.1"), Not(of("y")));
  EXPECT_THAT(remarks("0"), Not(of("x")));
}

}  // namespace
}  // namespace gnomon::symmetry_test
