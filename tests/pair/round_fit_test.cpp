// A shaft in the bore of a hub: facets are chords of both circles, and of different length where
// the meshes do not match.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>

#include "part/part_scene.hpp"

namespace gnomon::round_fit_test {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// Quarters of rings of radii 5 and 10 + `more`, and 10 and 20, with so many facets along the arc;
/// `height`: 0 in the plane.
std::string rings(double more, int shaft, int hub, double height = 0) {
  std::string text = fmt::format(R"(d = {}; h = {}; e = 1e-3;
Point(1) = {{5, 0, 0}}; Point(2) = {{10 + d, 0, 0}}; Line(1) = {{1, 2}};
Point(3) = {{10, 0, 0}}; Point(4) = {{20, 0, 0}}; Line(2) = {{3, 4}};
Transfinite Curve {{1, 2}} = 4;
A[] = Extrude {{{{0, 0, 1}}, {{0, 0, 0}}, Pi / 2}} {{ Curve{{1}}; Layers{{{}}}; Recombine; }};
B[] = Extrude {{{{0, 0, 1}}, {{0, 0, 0}}, Pi / 2}} {{ Curve{{2}}; Layers{{{}}}; Recombine; }};
)",
                                 more, height, shaft, hub);
  if (height == 0)
    return text + R"(Physical Surface("shaft") = {A[1]}; Physical Surface("hub") = {B[1]};
Physical Curve("xs") = Curve In BoundingBox{-e, -e, -e, e, 21, e};
Physical Curve("ys") = Curve In BoundingBox{-e, -e, -e, 21, e, e};
Physical Curve("seat") = {A[2]}; Physical Curve("bore") = {B[3]};
)";
  return text + R"(C[] = Extrude {0, 0, h} { Surface{A[1]}; Layers{2}; Recombine; };
D[] = Extrude {0, 0, h} { Surface{B[1]}; Layers{2}; Recombine; };
Physical Volume("shaft") = {C[1]}; Physical Volume("hub") = {D[1]};
Physical Surface("xs") = Surface In BoundingBox{-e, -e, -e, e, 21, h + e};
Physical Surface("ys") = Surface In BoundingBox{-e, -e, -e, 21, e, h + e};
Physical Surface("seat") = {C[3]}; Physical Surface("bore") = {D[5]};
Physical Surface("zs") = {A[1], B[1]};
)";
}

constexpr const char* scene = R"(
problem = "worn_body"
mesh.file = "rings.geo"
body = [ { name = "shaft", young_modulus = 210e3, poisson_ratio = 0.3, material = "linear" },
         { name = "hub", young_modulus = 210e3, poisson_ratio = 0.3, material = "linear" } ]
pair = [ { bodies = ["shaft", "hub"] } ]
wear = { on = ["seat", "bore"], coefficient = 0.0 }
time.end = 1.0
[[support]]
on = "xs"
directions = ["x"]
[[support]]
on = "ys"
directions = ["y"]
)";

class RoundFit : public PartScenes {
protected:
  std::vector<std::string> remarks(const std::string& rings, int splits = 0,
                                   const std::string& more = "") const {
    folder_.write("rings.geo", rings);
    return model(scene + more, {fmt::format("mesh.split={}", splits)})->remarks;
  }
};

const auto warning = Contains(HasSubstr("facets of different length are chords"));

/// Whole rings of so many facets a quarter; the shaft of 5 mm to a radius in a hub of 10 to 20 mm.
std::string whole_rings(double radius, int shaft, int hub) {
  return fmt::format(R"(
Macro Ring
 Point(b) = {{0, 0, 0}};
 For k In {{0:3}}
  c = Cos(k * Pi / 2 + 0.1 * b); s = Sin(k * Pi / 2 + 0.1 * b);
  Point(b+1+k) = {{ri * c, ri * s, 0}}; Point(b+11+k) = {{ro * c, ro * s, 0}};
 EndFor
 For k In {{0:3}}
  j = (k + 1) % 4;
  Circle(b+1+k) = {{b+1+k, b, b+1+j}}; Circle(b+11+k) = {{b+11+k, b, b+11+j}};
  Line(b+21+k) = {{b+1+k, b+11+k}};
 EndFor
 For k In {{0:3}}
  Curve Loop(b+1+k) = {{b+1+k, b+21+(k+1)%4, -(b+11+k), -(b+21+k)}}; Plane Surface(b+1+k) = {{b+1+k}};
 EndFor
 Transfinite Curve {{b+1:b+4, b+11:b+14}} = n + 1; Transfinite Curve {{b+21:b+24}} = 4;
 Transfinite Surface {{b+1:b+4}}; Recombine Surface {{b+1:b+4}};
Return
b = 100; ri = 5; ro = {}; n = {}; Call Ring;
b = 200; ri = 10; ro = 20; n = {}; Call Ring;
Physical Surface("shaft") = {{101:104}}; Physical Surface("hub") = {{201:204}};
Physical Curve("seat") = {{111:114}}; Physical Curve("bore") = {{201:204}};
Physical Curve("core") = {{101:104}}; Physical Curve("rim") = {{211:214}};
)",
                     radius, shaft, hub);
}

/// Without its supports.
std::string loose_scene() {
  const std::string text = scene;
  return text.substr(0, text.find("[[support]]"));
}

/// A whole ring overlaps along its approach by far more than along its normals.
TEST_F(RoundFit, OfAWholeRingIsTold) {
  folder_.write("rings.geo", whole_rings(10.01, 10, 7));
  for (const std::string held : {"", ", stiffness = 1.0"}) {
    const std::string supports = "support = [ { on = \"core\"" + held + " }, { on = \"rim\" } ]\n";
    EXPECT_THAT(model(loose_scene() + supports)->remarks, Contains(HasSubstr("about 3.1 times")))
        << held;
  }
}

/// Nodes of a shaft that fills its bore lie between the chords of it, on all sides: this is no fit
/// that holds it, and a load presses it on one side.
TEST_F(RoundFit, AShaftWithoutClearanceIsPressedByItsLoad) {
  folder_.write("rings.geo", whole_rings(10, 12, 15));
  for (const double force : {5.0, 2e4}) {
    SCOPED_TRACE(force);
    const auto model = this->model(
        loose_scene() +
        fmt::format("support = [ {{ on = \"rim\" }}, {{ on = \"core\", directions = [\"x\"] }} ]\n"
                    "load = [ {{ on = \"core\", force = [0.0, {}] }} ]\n",
                    -force));
    Counters counters;
    const State start = model->start(counters);
    EXPECT_NEAR(std::abs(model->examine(start).pairs.front().force[1]) / force, 1, 1e-6);
  }
}

/// A journal is pressed into a bush that the hub holds by their interference; the springs are weak.
TEST_F(RoundFit, AJournalComesToABushThatFits) {
  folder_.write("rings.geo", whole_rings(10.01, 10, 10) + R"(
b = 300; ri = 2; ro = 4.95; n = 10; Call Ring;
Physical Surface("journal") = {301:304}; Physical Curve("pin") = {311:314};
Physical Curve("axle") = {301:304};
)");
  const auto model = this->model(R"(problem = "worn_body"
mesh.file = "rings.geo"
body = [ { name = "journal", young_modulus = 210e3, poisson_ratio = 0.3, material = "linear" },
         { name = "shaft", young_modulus = 3e3, poisson_ratio = 0.4, material = "linear" },
         { name = "hub", young_modulus = 210e3, poisson_ratio = 0.3, material = "linear" } ]
pair = [ { bodies = ["journal", "shaft"] }, { bodies = ["shaft", "hub"] } ]
support = [ { on = "rim" }, { on = "axle", directions = ["x"] },
            { on = "axle", directions = ["y"], stiffness = 0.01 },
            { on = "core", stiffness = 1e-3 } ]
load = [ { on = "axle", force = [0.0, -100.0] } ]
wear = { on = ["core"], coefficient = 0.0 }
time.end = 1.0
)");
  Counters counters;
  const Examination facts = model->examine(model->start(counters));
  for (const auto& pair : facts.pairs) EXPECT_NEAR(std::abs(pair.force[1]) / 100, 1, 0.02);
}

// Chords of 7 and 10 facets lie by two thirds of their sagittas, 0.0629 and 0.0308 mm, off the
// circles in the mean. Lame: the pressure is 69.2 MPa, that of the meshes 217.4 MPa.
TEST_F(RoundFit, ChordsThatChangeTheOverlapAreTold) {
  EXPECT_THAT(
      remarks(rings(0.01, 10, 7)),
      Contains(HasSubstr("overlap by 0.0313 mm in the mean, their round surfaces by "
                         "0.00999 mm, since facets of different length are chords of these: "
                         "the pressure that this causes is about 3.1 times that of round "
                         "bodies")));
  EXPECT_THAT(remarks(rings(0.01, 20, 14)), Contains(HasSubstr("about 1.5 times")));
  EXPECT_THAT(remarks(rings(0.01, 10, 7), 1), Contains(HasSubstr("about 1.5 times")));
  EXPECT_THAT(remarks(rings(0.01, 40, 28)), Contains(HasSubstr("about 1.1 times")));
  EXPECT_THAT(remarks(rings(0.05, 7, 10)), Contains(HasSubstr("about 0.57 times")));
}

TEST_F(RoundFit, ChordsThatMatchOrHardlyCountAreNot) {
  EXPECT_THAT(remarks(rings(0.01, 10, 10)), Not(warning));
  EXPECT_THAT(remarks(rings(0.2, 9, 10)), Not(warning));
  EXPECT_THAT(remarks(rings(0.01, 10, 7), 3), Not(warning));
}

TEST_F(RoundFit, ChordsInSpaceAreTold) {
  const std::string held = "[[support]]\non = \"zs\"\ndirections = [\"z\"]\n";
  EXPECT_THAT(remarks(rings(0.01, 10, 7, 3), 0, held), Contains(HasSubstr("about 3.1 times")));
  EXPECT_THAT(remarks(rings(0.01, 10, 10, 3), 0, held), Not(warning));
}

// Its bodies lie apart, and a load brings them together.
TEST_F(RoundFit, OfBodiesThatALoadPressesIsNone) {
  const auto shoe = make_model(load_scene(shipped("shoe_on_drum.toml"), {}, key_table));
  EXPECT_THAT(shoe->remarks, Not(warning));
}

TEST_F(RoundFit, AClearanceIsTold) {
  folder_.write("rings.geo", rings(-0.02, 10, 10));
  EXPECT_THAT(refusal(scene), HasSubstr("or meshes that overlap: \"shaft\" and \"hub\" are 0.02"));
}

}  // namespace
}  // namespace gnomon::round_fit_test
