// A counter-body that moves along the normal of its surface alone wears nothing, which is told.
#include <gmock/gmock.h>

#include "part/part_scene.hpp"

namespace gnomon::normal_motion_test {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// A block whose lower side is round: its nodes have normals of their own.
constexpr const char* nose = R"(Point(1) = {-3, 0.5, 0, 1}; Point(2) = {0, 0, 0, 1};
Point(3) = {3, 0.5, 0, 1}; Point(4) = {3, 4, 0, 2}; Point(5) = {-3, 4, 0, 2};
Spline(1) = {1, 2, 3}; Line(2) = {3, 4}; Line(3) = {4, 5}; Line(4) = {5, 1};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Physical Surface("block") = {1}; Physical Curve("nose") = {1}; Physical Curve("top") = {3};
)";

constexpr const char* scene = R"(
problem = "worn_body"
mesh.file = "nose.geo"
body = { young_modulus = 1500.0, poisson_ratio = 0.4 }
support = [ { on = "top" } ]
wear = { on = ["nose"], coefficient = 1e-8 }
time.end = 100.0
[counter_body]
press = { direction = [0.0, 1.0], force = 30.0 }
)";

class NormalMotion : public PartScenes {
protected:
  std::vector<std::string> remarks(const std::string& shape, double vx, double vy) const {
    folder_.write("nose.geo", nose);
    return model(fmt::format("{}{}\nmotion.velocity = [{}, {}]\n", scene, shape, vx, vy))->remarks;
  }
};

const auto idle = Contains(HasSubstr("the counter-body does not slide on the surfaces of wear.on"));

TEST_F(NormalMotion, OfAPlaneIsTold) {
  const std::string flat = "shape = \"plane\"\ncenter = [0.0, 0.0]\nnormal = [0.0, 1.0]";
  EXPECT_THAT(remarks(flat, 0, 0), idle);
  EXPECT_THAT(remarks(flat, 0, 300), idle);
  EXPECT_THAT(remarks(flat, 1e-3, 300), Not(idle));
  const std::string inclined = "shape = \"plane\"\ncenter = [0.0, 0.0]\nnormal = [0.1, 1.0]";
  EXPECT_THAT(remarks(inclined, 30, 300), idle);
  EXPECT_THAT(remarks(inclined, 0, 300), Not(idle));
}

TEST_F(NormalMotion, OfACylinderSlidesBesideItsMiddle) {
  const std::string round = "shape = \"cylinder\"\ncenter = [0.0, -20.0]\nradius = 20.0";
  EXPECT_THAT(remarks(round, 0, 0), idle);
  EXPECT_THAT(remarks(round, 0, 300), Not(idle));
}

}  // namespace
}  // namespace gnomon::normal_motion_test
