// Friction that may stick: what presses beside tangential forces, planes of symmetry, units.
#include "stick/stick_scenes.hpp"
#include "support/fretting_loop.hpp"

namespace gnomon::loads_of_a_path_test {
namespace {

using namespace testing;
using ::testing::Contains;
using ::testing::HasSubstr;

constexpr const char* swinging = "cycle = \"sin(2*pi*tau)\"\n";

class LoadsOfAPath : public Fretting {
protected:
  /// The block on its bed, pressed as `tables` say.
  static std::string pressed(const std::string& tables) {
    std::string text = bed("");
    const std::string press = "press = { direction = [0.0, -1.0], force = 20.0 }\n";
    return text.replace(text.find(press), press.size(), tables);
  }
  static std::string along(double force, const std::string& cycle) {
    return fmt::format("[[counter_body.press]]\ndirection = [1.0, 0.0]\nforce = {}\n{}", force,
                       cycle);
  }
  double at_start(const std::string& name, const std::string& text,
                  const Overrides& overrides = {}) const {
    const auto model = this->model(text, overrides);
    Counters counters;
    return observed(*model, model->start(counters), name);
  }
  void expect_friction(double force, const std::string& tables,
                       const Overrides& overrides = {}) const {
    EXPECT_NEAR(at_start("friction_force", pressed(tables), overrides), force, 1e-6) << tables;
  }
};

/// A normal force that swings, an approach, an overlap, a load.
TEST_F(LoadsOfAPath, AnythingMayPressBesideAForceAlongTheSurface) {
  const std::string down = "[[counter_body.press]]\ndirection = [0.0, -1.0]\n";
  expect_friction(8, along(8, "") + down + "force = 20.0\ncycle = \"1 + 0.1*sin(2*pi*tau)\"\n");
  expect_friction(8, along(8, swinging) + down + "approach = 0.002\n");
  expect_friction(4, along(4, swinging), {"counter_body.center=[0.0, 0.099]"});
  const std::string load = "[[load]]\non = \"bottom\"\nforce = [0.0, 20.0]\n";
  expect_friction(8, along(8, swinging) + load, {"support.1.directions=[\"x\"]"});
  expect_refused(pressed(along(8, swinging)), {}, "expected something that presses the bodies");
}

TEST_F(LoadsOfAPath, AConstantForceIsWhatFrictionCarries) {
  expect_friction(8,
                  "[[counter_body.press]]\ndirection = [0.0, -1.0]\nforce = 20.0\n" + along(8, ""));
}

/// All around, the normals have no mean, whichever way the force points.
TEST_F(LoadsOfAPath, ABoreIsPressedOnAnySide) {
  folder_.write("bore.geo", R"(SetFactory("OpenCASCADE");
Disk(1) = {0, 0, 0, 3, 3}; Disk(2) = {0, 0, 0, 1, 1};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Mesh.MeshSizeMax = 0.3;
Physical Surface("ring") = {3};
c() = Boundary{ Surface{3}; };
Physical Curve("outer") = {c(0)}; Physical Curve("bore") = {c(1)};
)");
  for (const double degrees : {0.0, 27.0, 207.0}) {
    const double c = std::cos(degrees * M_PI / 180), s = std::sin(degrees * M_PI / 180);
    EXPECT_NEAR(at_start("friction_force", fmt::format(R"toml(
problem = "worn_body"
mesh.file = "bore.geo"
body = {{ young_modulus = 1e5, poisson_ratio = 0.3, material = "linear" }}
support = [ {{ on = "outer" }} ]
friction = {{ coefficient = 0.6, stick = true }}
wear = {{ on = ["bore"], coefficient = 2.9e-8 }}
time.cycles = 1000
cycle = {{ period = 1.0, phases = 4 }}
counter_body = {{ shape = "cylinder", radius = 0.99, center = [0.0, 0.0], press = [
  {{ direction = [{0}, {1}], force = 20.0 }},
  {{ direction = [{2}, {0}], force = 5.0, cycle = "sin(2*pi*tau)" }} ] }}
)toml",
                                                       c, s, -s)),
                5, 1e-6)
        << degrees;
  }
}

/// Its other side is no mirror image.
TEST_F(LoadsOfAPath, AClampedEdgeIsNoPlaneOfSymmetry) {
  folder_.write("pad.geo", R"(SetFactory("OpenCASCADE");
Rectangle(1) = {0, -1, 0, 3, 1}; Rectangle(2) = {0, 0, 0, 1, 0.5};
Transfinite Curve {1, 3} = 10; Transfinite Curve {2, 4} = 4;
Transfinite Curve {5, 7} = 5; Transfinite Curve {6, 8} = 3;
Transfinite Surface "*"; Recombine Surface "*";
Physical Curve("bottom") = {1}; Physical Curve("face") = {3}; Physical Curve("left") = {4};
Physical Curve("feet") = {5}; Physical Curve("top") = {7};
Physical Surface("flat") = {1}; Physical Surface("pad") = {2};
)");
  const std::string text = R"toml(
problem = "worn_body"
mesh.file = "pad.geo"
body = [ { name = "flat", young_modulus = 1e5, poisson_ratio = 0.3, material = "linear" },
         { name = "pad", young_modulus = 1e5, poisson_ratio = 0.3, material = "linear" } ]
support = [ { on = "top", directions = ["x"], stiffness = 1e-3 }, { on = "bottom" },
            { on = "left" } ]
pair = [ { bodies = ["pad", "flat"], surfaces = ["feet", "face"] } ]
load = [ { on = "top", force = [0.0, -20.0] },
         { on = "top", force = [4.0, 0.0], cycle = "sin(2*pi*tau)" } ]
friction = { coefficient = 0.5, stick = true }
wear = { on = ["face", "feet"], coefficient = 1e-8 }
time.cycles = 100
cycle = { period = 1.0, phases = 4 }
)toml";
  EXPECT_NEAR(at_start("friction_force", text), 4, 1e-3);
}

/// The other half pushes back across the plane of symmetry, as no friction does.
TEST_F(LoadsOfAPath, FrictionOfAHalfIsHalfOfTheWhole) {
  folder_.write("half.geo", half_block);
  const std::string text = R"toml(problem = "worn_body"
mesh.file = "half.geo"
body = { young_modulus = 1e5, poisson_ratio = 0.3, material = "linear" }
support = [ { on = "bottom" }, { on = "symmetry", directions = ["y"] } ]
friction = { coefficient = 0.6, stick = true }
wear = { on = ["surface"], coefficient = 2.9e-8 }
time.cycles = 1000
cycle = { period = 1.0, phases = 4 }
[counter_body]
shape = "ball"
radius = 5.0
center = [0.0, 0.0, 5.0]
[[counter_body.press]]
direction = [0.0, 0.0, -1.0]
force = 25.0
)toml" + along(5, swinging);
  std::string in_space = text;
  in_space.replace(in_space.find("[1.0, 0.0]"), 10, "[1.0, 0.0, 0.0]");
  EXPECT_NEAR(at_start("friction_force", in_space), 5, 1e-6);
}

/// The same scene a thousand times smaller; forces are by thickness.
TEST_F(LoadsOfAPath, ExpectedDepthsScaleWithTheBody) {
  std::string small = half_plane(4, 4, 3);
  small.replace(small.find("b = 0.045; w = 2;"), 17, "b = 45e-6; w = 2e-3;");
  folder_.write("small.geo", small);
  const auto expected = [this](const Overrides& overrides) {
    const auto model = this->model(cylinder(), overrides);
    for (const std::string& proposal : model->proposals)
      if (const auto at = proposal.find("a depth of"); at != std::string::npos)
        return proposal.substr(at);
    return std::string("none");
  };
  const std::string depth = expected({"mesh.file=coarse.geo"});
  EXPECT_THAT(depth, HasSubstr(" times the body's size"));
  EXPECT_EQ(depth, expected({"mesh.file=small.geo", "counter_body.radius=6e-3",
                             "counter_body.center=[0.0, 6e-3]", "counter_body.press.1.force=0.0185",
                             "counter_body.press.2.force=0.00666"}));
}

/// Of a factor that reads the depth it is known in the run alone.
TEST_F(LoadsOfAPath, FrictionThatFallsBelowTheForceIsTold) {
  const auto remarks = [this](const std::string& factor) {
    return model(cylinder(), {"friction.factor=\"" + factor + "\""})->remarks;
  };
  const auto told = ::testing::Contains(HasSubstr("becomes more than friction holds"));
  EXPECT_THAT(remarks("1-0.8*t/1000"), ::testing::Contains(HasSubstr("at t = 500 s")));
  EXPECT_THAT(remarks("1-0.3*t/1000"), ::testing::Not(told));
  EXPECT_THAT(remarks("1-0.8*t/1000-h"), ::testing::Not(told));
}

TEST_F(LoadsOfAPath, FrictionMayVanish) {
  const std::string drive = bed();
  const auto force = [&](const std::string& factor) {
    return at_start("friction_force", drive, {"friction.factor=\"" + factor + "\""});
  };
  EXPECT_NEAR(force("min(1, t/500)"), 0, 1e-9);
  EXPECT_NEAR(force("if(x0 < 0.4, 0, 1)"), 0.5 * 20 * 0.625,
              0.4);  // three nodes in five; the block tilts
}

/// A strip is stretched to and fro under a plane on its middle; its half has a plane of symmetry.
TEST_F(LoadsOfAPath, LoadsThatPullAgainstEachOtherHaveTheLoopOfBothHalves) {
  const auto loop_of = [this](double left, const std::string& name, const std::string& end) {
    folder_.write(name, fmt::format(R"(SetFactory("OpenCASCADE");
Rectangle(1) = {{{}, 0, 0, {}, 1}};
Transfinite Curve {{1, 3}} = {}; Transfinite Curve {{2, 4}} = 4;
Transfinite Surface "*"; Recombine Surface "*";
Physical Curve("bottom") = {{1}}; Physical Curve("right") = {{2}};
Physical Curve("surface") = {{3}}; Physical Curve("left") = {{4}}; Physical Surface("strip") = {{1}};
)",
                                    left, 1 - left, left < 0 ? 13 : 7));
    const auto model = this->model(fmt::format(R"(problem = "worn_body"
mesh.file = "{}"
body = {{ young_modulus = 1e5, poisson_ratio = 0.3, material = "linear" }}
friction = {{ coefficient = 0.5, stick = true }}
wear = {{ on = ["surface"], coefficient = 1e-8 }}
time.cycles = 1000
cycle = {{ period = 1.0, phases = 8 }}
counter_body = {{ shape = "plane", center = [0.0, 1.0], normal = [0.0, -1.0], press = {{ direction = [0.0, -1.0], force = {} }} }}
[[support]]
on = "bottom"
directions = ["y"]
[[load]]
on = "right"
traction = [80.0, 0.0]
{}{}
)",
                                               name, left < 0 ? 20 : 10, swinging, end));
    Counters counters;
    const State start = model->start(counters);
    return std::array{observed(*model, start, "stroke"), observed(*model, start, "friction_force"),
                      enclosed_by_loop(model->contact(start).value())};
  };
  const std::string weak = "[[support]]\non = \"bottom\"\ndirections = [\"x\"]\nstiffness = 1e-3\n";
  const auto half = loop_of(0, "half.geo", "[[support]]\non = \"left\"\ndirections = [\"x\"]\n");
  const auto whole = loop_of(
      -1, "whole.geo",
      fmt::format("[[load]]\non = \"left\"\ntraction = [-80.0, 0.0]\n{}{}", swinging, weak));
  EXPECT_GT(half[0], 1e-4);
  EXPECT_NEAR(whole[0] / half[0], 1, 1e-4);
  EXPECT_EQ(half[1], 0);
  EXPECT_NEAR(whole[1], 0, 1e-6);
  EXPECT_NEAR(whole[2] / half[2], 2, 1e-3);
}

TEST_F(LoadsOfAPath, OfSeveralPairsARemarkSaysWhoseForceItIs) {
  folder_.write("pads.geo", R"(SetFactory("OpenCASCADE");
Rectangle(1) = {0, -1, 0, 3, 1}; Rectangle(2) = {0, 0, 0, 1, 0.5}; Rectangle(3) = {2, 0, 0, 1, 0.5};
Transfinite Curve {1, 3} = 7; Transfinite Curve {2, 4} = 3;
Transfinite Curve {5, 7, 9, 11} = 4; Transfinite Curve {6, 8, 10, 12} = 2;
Transfinite Surface "*"; Recombine Surface "*";
Physical Curve("bottom") = {1}; Physical Curve("face") = {3};
Physical Curve("feet1") = {5}; Physical Curve("feet2") = {9};
Physical Curve("top1") = {7}; Physical Curve("top2") = {11};
Physical Curve("sides") = {6, 8, 10, 12};
Physical Surface("flat") = {1}; Physical Surface("pad1") = {2}; Physical Surface("pad2") = {3};
)");
  std::string text = R"toml(problem = "worn_body"
mesh.file = "pads.geo"
friction = { coefficient = 0.5, stick = true }
wear = { on = ["face", "feet1", "feet2"], coefficient = 1e-8 }
time.cycles = 100
cycle = { period = 1.0, phases = 4 }
support = [ { on = "bottom" }, { on = "sides", directions = ["x"] } ]
motion = [ { body = "flat", cycle = { x = "1e-2 * sin(2*pi*tau)" } } ]
)toml";
  for (const char* name : {"flat", "pad1", "pad2"})
    text += fmt::format(
        "[[body]]\nname = \"{}\"\nyoung_modulus = 1e5\npoisson_ratio = 0.3\nmaterial = "
        "\"linear\"\n",
        name);
  for (const int pad : {1, 2})
    text += fmt::format(
        "[[pair]]\nbodies = [\"pad{0}\", \"flat\"]\nsurfaces = [\"feet{0}\", \"face\"]\n"
        "[[load]]\non = \"top{0}\"\nforce = [0.0, -20.0]\n",
        pad);
  EXPECT_THAT(model(text)->remarks, Contains(HasSubstr("are those of the first [[pair]]")));
  EXPECT_EQ(at_start("friction_work", text, {"friction.factor=\"0*t\""}), 0);
}

}  // namespace
}  // namespace gnomon::loads_of_a_path_test
