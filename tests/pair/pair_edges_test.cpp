// A wearing surface that ends at an edge: the side behind it faces the other body, too.

#include <algorithm>

#include "part/part_scene.hpp"

namespace gnomon::pair_edges_test {
namespace {

using namespace testing;

/// A pad of width 6 that widens upwards, with sides at an angle to the plate, on a plate.
std::string pad(double degrees) {
  return "b = 3 + 4 / Tan(" + std::to_string(degrees) + R"( * Pi / 180);
Point(1) = {-3, 0, 0}; Point(2) = {3, 0, 0}; Point(3) = {b, 4, 0}; Point(4) = {-b, 4, 0};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1};
Transfinite Curve {1, 3} = 7; Transfinite Curve {2, 4} = 7; Transfinite Surface {1};
Point(11) = {-12.3, -4, 0}; Point(12) = {12.3, -4, 0}; Point(13) = {12.3, 0, 0};
Point(14) = {-12.3, 0, 0};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(11) = {11 : 14}; Plane Surface(11) = {11};
Transfinite Curve {11, 13} = 61; Transfinite Curve {12, 14} = 5; Transfinite Surface {11};
Recombine Surface {1, 11};
Physical Surface("pad") = {1}; Physical Surface("plate") = {11}; Physical Curve("sole") = {1};
Physical Curve("top") = {3}; Physical Curve("face") = {13}; Physical Curve("base") = {11};
)";
}

constexpr const char* scene = R"(
problem = "worn_body"
[mesh]
file = "pad.geo"
[[body]]
name = "pad"
young_modulus = 200
poisson_ratio = 0.3
[[body]]
name = "plate"
young_modulus = 200
poisson_ratio = 0.3
[[pair]]
bodies = ["pad", "plate"]
[[motion]]
body = "pad"
velocity = [0.0, 0.0, 30.0]
[[support]]
on = "base"
[[support]]
on = "top"
directions = ["x"]
[[load]]
on = "top"
force = [0.0, -3.0]
[wear]
on = ["sole", "face"]
coefficient = 1e-5
[time]
end = 20.0
)";

class PairEdges : public PartScenes {};

// Without friction pressures are vertical: nodes at the edges have the normal of the sole.
TEST_F(PairEdges, SidesDoNotTurnTheNormalsOfTheSole) {
  for (const double degrees : {20.0, 45.0, 60.0, 75.0, 80.0, 88.0}) {
    SCOPED_TRACE(degrees);
    folder_.write("pad.geo", pad(degrees));
    const auto model = this->model(scene, {});
    const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 20);
    EXPECT_NEAR(observed(*model, run.last(), "contact_force"), 3, 1e-4);
    for (const char* volume : {"worn_volume_pad", "worn_volume_plate"})
      EXPECT_NEAR(observed(*model, run.last(), volume) / (1e-5 * 3 * 30 * 20), 1, 1e-4);
  }
}

/// A ring on a wider one whose nodes lie at both of its edges, where pressures are high: strains
/// move the edges over these nodes.
TEST_F(PairEdges, MayLieAtNodesOfTheSlave) {
  folder_.write("pad.geo", R"(Point(1) = {4, 0, 0}; Point(2) = {6, 0, 0}; Point(3) = {6, 2, 0};
Point(4) = {4, 2, 0}; Point(11) = {2, -2, 0}; Point(12) = {8, -2, 0}; Point(13) = {8, 0, 0};
Point(14) = {2, 0, 0}; Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(11) = {11, 12}; Line(12) = {12, 13}; Line(13) = {13, 14}; Line(14) = {14, 11};
Curve Loop(1) = {1 : 4}; Plane Surface(1) = {1}; Curve Loop(11) = {11 : 14};
Plane Surface(11) = {11};
Transfinite Curve {1, 3} = 17; Transfinite Curve {2, 4} = 9; Transfinite Curve {11, 13} = 37;
Transfinite Curve {12, 14} = 9; Transfinite Surface {1, 11}; Recombine Surface {1, 11};
Physical Surface("pad") = {1}; Physical Surface("plate") = {11}; Physical Curve("sole") = {1};
Physical Curve("top") = {3}; Physical Curve("face") = {13}; Physical Curve("base") = {11};
)");
  const auto model = this->model(R"(
problem = "worn_body"
mesh.file = "pad.geo"
model.plane = "axisymmetric"
body = [ { name = "pad", young_modulus = 1e3, poisson_ratio = 0.3 },
         { name = "plate", young_modulus = 2e3, poisson_ratio = 0.3 } ]
pair = [ { bodies = ["pad", "plate"], friction = 0.2 } ]
support = [ { on = "base" }, { on = "top", directions = "r" } ]
load = [ { on = "top", force = [0.0, -200.0] } ]
motion = [ { body = "plate", rotation = 10.0 },
           { body = "pad", rotation = -5.0, velocity = [0.0, 0.0, 30.0] } ]
wear = { on = ["sole", "face"], coefficient = 1e-7, surfaces.face.coefficient = 2e-7 }
time.end = 100.0
)");
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 100);
  const double pad = observed(*model, run.last(), "worn_volume_pad");
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume_plate") / pad, 2, 1e-4);
  EXPECT_NEAR(pad / (1e-7 * 200 * (15 * 5 - 30) * 100), 1, 0.01);  // at a radius of 5
}

TEST_F(PairEdges, SurfacesThatMeetAtAnEdgeAreToldOf) {
  const auto told = [&](const char* on) {
    std::string geometry = pad(60);
    geometry += "Physical Curve(\"side\") = {2};\n";
    folder_.write("pad.geo", geometry);
    const auto model = this->model(scene, {std::string("wear.on=") + on});
    return std::ranges::any_of(model->remarks, [](const std::string& remark) {
      return remark.find("\"side\" wear and meet at an edge") != std::string::npos;
    });
  };
  EXPECT_TRUE(told(R"(["sole", "side", "face"])"));
  EXPECT_FALSE(told(R"(["sole", "face"])"));
}

}  // namespace
}  // namespace gnomon::pair_edges_test
