// Slender bodies that stand on narrow surfaces, which softer ones would let fall over.

#include <fmt/format.h>

#include <algorithm>

#include "part/part_scene.hpp"

namespace gnomon::standing_test {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// A column of width 1.5 and height 6, guided at its top, on a plate; its foot is flat, or round.
std::string column(double bulge) {
  return "bulge = " + std::to_string(bulge) + R"(;
Point(1) = {-0.75, 0, 0, 0.3}; Point(2) = {0.75, 0, 0, 0.3}; Point(3) = {0.75, 6, 0, 0.5};
Point(4) = {-0.75, 6, 0, 0.5}; Point(5) = {0, -bulge, 0, 0.3};
Spline(1) = {1, 5, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Point(11) = {-3, -0.4, 0, 0.4}; Point(12) = {3, -0.4, 0, 0.4}; Point(13) = {3, -3, 0, 1};
Point(14) = {-3, -3, 0, 1};
Line(11) = {11, 14}; Line(12) = {14, 13}; Line(13) = {13, 12}; Line(14) = {12, 11};
Curve Loop(11) = {11 : 14}; Plane Surface(11) = {11};
Physical Surface("column") = {1}; Physical Surface("plate") = {11};
Physical Curve("foot") = {1}; Physical Curve("top") = {3}; Physical Curve("base") = {12};
)";
}

constexpr const char* scene = R"(
problem = "worn_body"
[mesh]
file = "column.geo"
[[body]]
name = "column"
young_modulus = 1e5
poisson_ratio = 0.3
[[body]]
name = "plate"
young_modulus = 2e5
poisson_ratio = 0.3
[[pair]]
bodies = ["column", "plate"]
[[motion]]
body = "plate"
velocity = [0.0, 0.0, 100.0]
[[support]]
on = "base"
[[support]]
on = "top"
directions = ["x"]
[[load]]
on = "top"
force = [0.0, -100.0]
[wear]
on = "foot"
coefficient = 1e-8
[time]
end = 100.0
)";

class Standing : public PartScenes {};

// A foundation under a width w gives way by c: it holds the column upright where w^2 / (12 c) is
// more than the height.
TEST_F(Standing, AColumnStandsOnItsFlatFoot) {
  folder_.write("column.geo", column(0));
  const auto model = this->model(scene);
  Counters counters;
  const State start = model->start(counters);
  EXPECT_NEAR(observed(*model, start, "contact_force"), 100, 0.01);
  EXPECT_GE(observed(*model, start, "contact_nodes"), 5);
}

/// Their other ends move by 4 mm, of which the gap of 0.4 mm takes a part.
TEST_F(Standing, SoftSpringsPressAColumnByTheirForce) {
  folder_.write("column.geo", column(0));
  std::string pressed = scene;
  const std::string load = "[[load]]\non = \"top\"\nforce = [0.0, -100.0]\n";
  pressed.replace(pressed.find(load), load.size(),
                  "[[support]]\non = \"top\"\ndirections = [\"y\"]\n"
                  "stiffness = 0.15\nvalue = [-4.0]\n");
  const auto model = this->model(pressed);
  EXPECT_THAT(model->remarks, Not(Contains(HasSubstr("are moduli given in MPa"))));
  Counters counters;
  EXPECT_NEAR(observed(*model, model->start(counters), "contact_force"), 0.15 * 3.6 * 1.5, 1e-4);
}

/// A stiff block of 6 mm on a soft one of the same width, pressed at `off` from its middle.
std::string eccentric(double off, int below, int above) {
  return fmt::format(R"(
problem = "worn_body"
mesh.file = "blocks_{1}_{2}.geo"
wear = {{ on = ["face", "sole"], coefficient = 0.0 }}
time.end = 1.0
pair = [ {{ bodies = ["upper", "lower"] }} ]
body = [ {{ name = "upper", young_modulus = 1e7, poisson_ratio = 0.0, material = "linear" }},
         {{ name = "lower", young_modulus = 1e4, poisson_ratio = 0.0, material = "linear" }} ]
support = [ {{ on = "base" }}, {{ on = "pivot", directions = ["x"] }} ]
load = [ {{ on = "top", force = [0.0, -60.0] }}, {{ on = "top", moment = {0} }} ]
)",
                     -60 * off, below, above);
}

std::string blocks(int below, int above) {
  return fmt::format(R"(Point(1) = {{-3, -2, 0}}; Point(2) = {{3, -2, 0}}; Point(3) = {{3, 0, 0}};
Point(4) = {{-3, 0, 0}}; Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}};
Line(4) = {{4, 1}}; Curve Loop(1) = {{1 : 4}}; Plane Surface(1) = {{1}};
Point(11) = {{-3, 0, 0}}; Point(12) = {{3, 0, 0}}; Point(13) = {{3, 2, 0}};
Point(14) = {{-3, 2, 0}}; Point(15) = {{0, 2, 0}}; Line(11) = {{11, 12}}; Line(12) = {{12, 13}};
Line(13) = {{13, 15}}; Line(15) = {{15, 14}}; Line(14) = {{14, 11}};
Curve Loop(11) = {{11, 12, 13, 15, 14}}; Plane Surface(11) = {{11}};
Transfinite Curve {{1, 3}} = {0}; Transfinite Curve {{2, 4, 12, 14}} = 4;
Transfinite Curve {{11}} = {1}; Transfinite Curve {{13, 15}} = {2};
Transfinite Surface {{1}}; Transfinite Surface {{11}} = {{11, 12, 13, 14}};
Recombine Surface {{1, 11}};
Physical Surface("lower") = {{1}}; Physical Surface("upper") = {{11}};
Physical Curve("base") = {{1}}; Physical Curve("face") = {{3}}; Physical Curve("sole") = {{11}};
Physical Curve("top") = {{13, 15}}; Physical Point("pivot") = {{15}};
)",
                     below + 1, above + 1, above / 2 + 1);
}

/// It stands wherever the force meets its foot, on any mesh, and touches about three times as far
/// as the force is from the edge, as on a bed of springs.
TEST_F(Standing, ABlockStandsWhereverTheForceMeetsItsFoot) {
  for (const auto& [below, above] : {std::pair{4, 6}, {6, 4}, {6, 12}, {12, 24}}) {
    folder_.write(fmt::format("blocks_{}_{}.geo", below, above), blocks(below, above));
    for (const double off : {1.5, 2.0, 2.2, 2.4, 2.6}) {
      SCOPED_TRACE(fmt::format("{} and {} elements, {}", below, above, off));
      const auto model = this->model(eccentric(off, below, above));
      Counters counters;
      const State start = model->start(counters);
      EXPECT_NEAR(observed(*model, start, "contact_force"), 60, 0.01);
      const double width = observed(*model, start, "contact_half_width") / (1.5 * (3 - off));
      EXPECT_NEAR(width, 1, below == 12 ? 0.15 : 0.4);
    }
  }
  EXPECT_THAT(refusal(eccentric(3.2, 12, 24)), HasSubstr("\"upper\" can turn about"));
}

TEST_F(Standing, ARoundFootRollsOver) {
  folder_.write("column.geo", column(0.3));
  EXPECT_THAT(refusal(scene), HasSubstr("\"column\" can turn about"));
}

/// A pin of 8 mm with a nose of radius 12, whose guide along its top lets it rock.
constexpr const char* pin_on_plate = R"(
Point(1) = {0, 0, 0, 0.25}; Point(2) = {-4, 12 - Sqrt(128), 0, 0.4}; Point(9) = {0, 12, 0};
Point(3) = {4, 12 - Sqrt(128), 0, 0.4}; Point(4) = {4, 8, 0, 1.5}; Point(5) = {-4, 8, 0, 1.5};
Circle(1) = {2, 9, 1}; Circle(2) = {1, 9, 3};
Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 2};
Curve Loop(1) = {1 : 5}; Plane Surface(1) = {1};
Point(11) = {-10, -8, 0, 2}; Point(12) = {10, -8, 0, 2}; Point(13) = {10, 0, 0, 1.5};
Point(14) = {4, 0, 0, 0.35}; Point(15) = {-4, 0, 0, 0.35}; Point(16) = {-10, 0, 0, 1.5};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 15};
Line(15) = {15, 16}; Line(16) = {16, 11};
Curve Loop(2) = {11 : 16}; Plane Surface(2) = {2}; Recombine Surface {1, 2};
Physical Surface("pin") = {1}; Physical Surface("plate") = {2};
Physical Curve("nose") = {1, 2}; Physical Curve("top") = {4}; Physical Curve("base") = {11};
)";

TEST_F(Standing, ARockerThatFindsNoRestIsNamed) {
  folder_.write("pin.geo", pin_on_plate);
  const std::string failure = failed_start(R"(
problem = "worn_body"
mesh.file = "pin.geo"
body = [ { name = "pin", young_modulus = 2000.0, poisson_ratio = 0.35 },
         { name = "plate", young_modulus = 6000.0, poisson_ratio = 0.3 } ]
pair = [ { bodies = ["pin", "plate"], friction = 0.1 } ]
motion = [ { body = "plate", velocity = [100.0, 0.0] } ]
support = [ { on = "top", directions = ["x"] }, { on = "base" } ]
load = [ { on = "top", force = [0.0, -30.0] } ]
wear = { on = ["nose"], coefficient = 1e-8 }
time.end = 1.0
)");
  EXPECT_THAT(failure, AllOf(HasSubstr("\"pin\" can turn about ("),
                             HasSubstr(", 8), which contact alone resists")));
}

// Friction tilts it on a rigid cylinder, where no rest is looked for.
TEST_F(Standing, WhatIsFreeOnACounterBodyIsNamed) {
  folder_.write("block.geo", R"(
Point(1) = {-0.75, 0, 0, 0.3}; Point(2) = {0.75, 0, 0, 0.3}; Point(3) = {0.75, 6, 0, 0.5};
Point(4) = {-0.75, 6, 0, 0.5};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Physical Surface("block") = {1}; Physical Curve("foot") = {1}; Physical Curve("top") = {3};
)");
  const std::string failure = failed_start(R"(
problem = "worn_body"
mesh.file = "block.geo"
body = { young_modulus = 2e4, poisson_ratio = 0.3 }
support = [ { on = "top", directions = ["x"] } ]
load = [ { on = "top", force = [0.0, -20.0] } ]
counter_body = { shape = "cylinder", center = [0.0, -20.0], radius = 20.0, motion = { rotation = 10.0 } }
friction.coefficient = 0.2
wear = { on = ["foot"], coefficient = 1e-8 }
time.end = 100.0
)");
  EXPECT_THAT(failure, HasSubstr("supports leave the body free to move along y and turn"));
}

}  // namespace
}  // namespace gnomon::standing_test
