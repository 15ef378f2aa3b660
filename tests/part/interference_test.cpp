// Bodies that nothing presses but their overlap with a counter-body at rest.
#include <gmock/gmock.h>

#include "part/part_scene.hpp"

namespace gnomon::interference_test {
namespace {

using namespace testing;

class Interference : public PartScenes {};

// A round lip that is hardly compressible: all of the overlap at once inverts elements. It comes to
// where an approach from the first touch comes.
TEST_F(Interference, ComesGraduallyWithFiniteStrains) {
  folder_.write("lip.geo", R"(f = 0.3; c = 0.9;
Point(1) = {1.8, -2, 0, f}; Point(2) = {-0.2, 0, 0, f}; Point(3) = {1.8, 2, 0, f};
Point(4) = {5, 2, 0, c}; Point(5) = {5, -2, 0, c}; Point(6) = {1.8, 0, 0};
Circle(1) = {1, 6, 2}; Circle(2) = {2, 6, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};
Curve Loop(1) = {1:5}; Plane Surface(1) = {1}; Recombine Surface {1};
Physical Curve("lip") = {1, 2}; Physical Curve("out") = {4}; Physical Surface("b") = {1};
)");
  const auto force = [this](const std::string& place) {
    const auto model = this->model(R"(problem = "worn_body"
mesh.file = "lip.geo"
body = { young_modulus = 20.0, poisson_ratio = 0.48, material = "neo-hookean" }
shape.motion = "mesh"
support = [ { on = "out" } ]
wear = { on = ["lip"], coefficient = 1e-8 }
time.end = 1.0
[counter_body]
shape = "plane"
normal = [1.0, 0.0]
motion = { velocity = [0.0, 50.0] }
)" + place);
    Counters counters;
    return observed(*model, model->start(counters), "contact_force");
  };
  const double approached =
      force("center = [-0.2, 0.0]\npress = { direction = [1.0, 0.0], approach = 0.6 }\n");
  EXPECT_GT(approached, 5);
  EXPECT_NEAR(force("center = [0.4, 0.0]\n"), approached, 1e-6 * approached);
}

}  // namespace
}  // namespace gnomon::interference_test
