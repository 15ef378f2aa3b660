// A cam with a coating that is bonded to it: what is bonded has one place over the cycle.

#include <cmath>

#include "part/part_scene.hpp"

namespace gnomon::coated_cam_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;

const char* const mesh = R"(
Point(1) = {0, 0, 0, 3}; Point(2) = {0, 3, 0, 3};
Point(3) = {10, 3, 0, 2}; Point(4) = {0, 13, 0, 2}; Point(5) = {-10, 3, 0, 2};
Point(6) = {0, -7, 0, 2};
Circle(1) = {3, 2, 4}; Circle(2) = {4, 2, 5}; Circle(3) = {5, 2, 6}; Circle(4) = {6, 2, 3};
Point(7) = {8, 3, 0, 2}; Point(8) = {0, 11, 0, 2}; Point(9) = {-8, 3, 0, 2};
Point(10) = {0, -5, 0, 2};
Circle(5) = {7, 2, 8}; Circle(6) = {8, 2, 9}; Circle(7) = {9, 2, 10}; Circle(8) = {10, 2, 7};
Point(11) = {3, 0, 0, 3}; Point(12) = {0, 3, 0, 3}; Point(13) = {-3, 0, 0, 3};
Point(14) = {0, -3, 0, 3};
Circle(9) = {11, 1, 12}; Circle(10) = {12, 1, 13}; Circle(11) = {13, 1, 14};
Circle(12) = {14, 1, 11};
Curve Loop(1) = {1, 2, 3, 4}; Curve Loop(2) = {5, 6, 7, 8}; Curve Loop(3) = {9, 10, 11, 12};
Plane Surface(1) = {2, 3}; Plane Surface(2) = {1, 2};
Point(21) = {-6, 13, 0, 2}; Point(22) = {6, 13, 0, 2}; Point(23) = {6, 17, 0, 4};
Point(24) = {-6, 17, 0, 4};
Line(21) = {21, 22}; Line(22) = {22, 23}; Line(23) = {23, 24}; Line(24) = {24, 21};
Curve Loop(4) = {21, 22, 23, 24}; Plane Surface(3) = {4};
Physical Surface("follower") = {3};
Physical Curve("outline") = {1, 2, 3, 4}; Physical Curve("bore") = {9, 10, 11, 12};
Physical Curve("face") = {21}; Physical Curve("stem") = {23}; Physical Curve("guide") = {22, 24};
)";

const char* const rest = R"toml(
[[body]]
name = "follower"
young_modulus = 110e3
poisson_ratio = 0.34
material = "linear"
[shape]
motion = "gap"
[cycle]
period = 0.1
phases = 6
[[support]]
on = "bore"
[[support]]
on = "guide"
directions = ["x"]
[[load]]
on = "stem"
force = [0.0, -50.0]
[wear]
on = ["outline", "face"]
[wear.surfaces.outline]
coefficient = 1e-9
[wear.surfaces.face]
coefficient = 2e-9
[time]
cycles = 1000
)toml";

std::string body(const std::string& name) {
  return "[[body]]\nname = \"" + name +
         "\"\nyoung_modulus = 210e3\npoisson_ratio = 0.3\nmaterial = \"linear\"\n";
}
std::string motion(const std::string& name) {
  return "[[motion]]\nbody = \"" + name +
         "\"\ncenter = [0.0, 0.0]\ncycle = { rotation = \"2*pi*tau\" }\n";
}
std::string pair_of(const std::string& name) {
  return "[[pair]]\nbodies = [\"" + name + "\", \"follower\"]\n";
}
const std::string head = "problem = \"worn_body\"\nmesh.file = \"cam.geo\"\n";

class CoatedCam : public PartScenes {
protected:
  std::map<std::string, double> worn(const std::string& groups, const std::string& bodies) {
    folder_.write("cam.geo", mesh + groups);
    const auto model = this->model(head + bodies + rest);
    const State end = run_model(*model, "esdirk-3", 0, 1e-4, 100).last();
    std::map<std::string, double> result;
    for (const char* name : {"worn_volume", "wear_depth", "contact_force", "max_pressure"})
      result[name] = observed(*model, end, name);
    return result;
  }
  const std::string coated_ =
      "Physical Surface(\"core\") = {1}; Physical Surface(\"coat\") = {2};\n";
};

// A body that is called by two names is the same body, whichever of them moves.
TEST_F(CoatedCam, OfOneMaterialIsTheCam) {
  const auto whole =
      worn("Physical Surface(\"cam\") = {1, 2};\n", body("cam") + pair_of("cam") + motion("cam"));
  for (const char* moved : {"core", "coat"})
    for (const auto& [name, value] :
         worn(coated_, body("core") + body("coat") + pair_of("coat") + motion(moved)))
      EXPECT_NEAR(value / whole.at(name), 1, 1e-6) << name << ", " << moved;
  EXPECT_NEAR(whole.at("worn_volume") / (3e-9 * 50 * 2 * M_PI * 10 * 1000), 1, 2e-3);
}

TEST_F(CoatedCam, HasOneMotion) {
  folder_.write("cam.geo", mesh + coated_);
  EXPECT_THAT(refusal(head + body("core") + body("coat") + pair_of("coat") + motion("core") +
                      motion("coat") + rest),
              HasSubstr("expected one [[motion]] with a cycle for bodies that are bonded: "));
}

}  // namespace
}  // namespace gnomon::coated_cam_test
