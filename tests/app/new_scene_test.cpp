// Scenes that gnomon new proposes: groups that exist, by what their names say.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/mesh/mesh_file.hpp>

#include "app/child.hpp"

namespace gnomon::new_scene_test {
namespace {

using test::Outcome;
using ::testing::HasSubstr;
using ::testing::Not;

class NewScene : public test::ProgramTest {
protected:
  void SetUp() override {
    if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
  }
  /// The scene of a geometry.
  std::string scene(const std::string& geometry) const {
    write("part.geo", geometry);
    const Outcome outcome = gnomon({"new", "part.geo", "-o", "part.toml"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return test::read_text(folder() / "part.toml");
  }
};

// A bush has no flat side: its housing is held, and a shaft turns in its bore.
TEST_F(NewScene, OfABushHasAShaftInItsBore) {
  const std::string text = scene(R"(Point(1) = {0, 0, 0};
Point(2) = {5, 0, 0}; Point(3) = {0, 5, 0}; Point(4) = {-5, 0, 0}; Point(5) = {0, -5, 0};
Point(6) = {8, 0, 0}; Point(7) = {0, 8, 0}; Point(8) = {-8, 0, 0}; Point(9) = {0, -8, 0};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 4}; Circle(3) = {4, 1, 5}; Circle(4) = {5, 1, 2};
Circle(5) = {6, 1, 7}; Circle(6) = {7, 1, 8}; Circle(7) = {8, 1, 9}; Circle(8) = {9, 1, 6};
Curve Loop(1) = {5, 6, 7, 8}; Curve Loop(2) = {1, 2, 3, 4};
Plane Surface(1) = {1, 2};
Mesh.MeshSizeMax = 1;
Physical Curve("zone 1") = {5, 6, 7, 8}; Physical Curve("bore") = {1, 2, 3, 4};
Physical Surface("bush") = {1};
)");
  EXPECT_THAT(text, HasSubstr("[[support]]  # may be several\non = \"zone 1\""));
  EXPECT_THAT(text, HasSubstr("on = [\"bore\"]"));
  EXPECT_THAT(text, HasSubstr("shape = \"cylinder\"\ncenter = [0.0, 0.0]  # mm\nradius = 4.995"));
  const Outcome check = gnomon({"check", "part.toml"});
  EXPECT_EQ(check.exit_code, 0) << check.err;
  const Outcome run = gnomon({"run", "part.toml", "--set", "time.end=1", "--quiet"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

// A bush as a body of its own turns around its shaft, of whatever clearance.
TEST_F(NewScene, OfAShaftInABushTurnsTheBush) {
  std::string geometry = "Point(1) = {0, 0, 0};\nMesh.MeshSizeMax = 1;\n";
  const double radii[] = {8, 5, 4.99, 2};
  for (int ring = 0; ring < 4; ++ring) {
    const int at = 10 * (ring + 1);
    for (int k = 0; k < 4; ++k)
      geometry += fmt::format("Point({}) = {{{}, {}, 0}};\n", at + k,
                              k % 2 == 0 ? (1 - k) * radii[ring] : 0,
                              k % 2 == 0 ? 0 : (2 - k) * radii[ring]);
    for (int k = 0; k < 4; ++k)
      geometry += fmt::format("Circle({}) = {{{}, 1, {}}};\n", at + k, at + k, at + (k + 1) % 4);
    geometry += fmt::format("Curve Loop({0}) = {{{0}:{1}}};\n", at, at + 3);
  }
  const std::string text = scene(geometry + R"(Plane Surface(1) = {10, 20};
Plane Surface(2) = {30, 40};
Physical Surface("bush") = {1}; Physical Surface("shaft") = {2};
Physical Curve("outside") = {10:13}; Physical Curve("left") = {21, 22};
Physical Curve("right") = {20, 23}; Physical Curve("skin") = {30:33};
Physical Curve("core") = {40:43};
)");
  EXPECT_THAT(text, HasSubstr("\nbody = \"bush\"\nrotation = 10.0  # rad/s\ncenter = [0.0, 0.0]"));
  EXPECT_THAT(text, HasSubstr("\non = \"core\"\ndirections = [\"x\"]\n"));
  EXPECT_THAT(text, HasSubstr("\non = \"core\"\nforce = [0.0, -100.0]"));
  EXPECT_THAT(text, HasSubstr("[wear]\non = [\"left\", \"right\", \"skin\"]\n"));
  const Outcome check = gnomon({"check", "part.toml"});
  EXPECT_EQ(check.exit_code, 0) << check.err;
}

// The shaft is where the centre of the half circle is, and is pressed into it.
TEST_F(NewScene, OfHalfABushHasAShaftInItsBore) {
  const std::string text = scene(R"(Point(1) = {0, 0, 0};
Point(2) = {5, 0, 0}; Point(3) = {-5, 0, 0}; Point(4) = {0, -5, 0};
Point(5) = {8, 0, 0}; Point(6) = {-8, 0, 0}; Point(7) = {0, -8, 0};
Circle(1) = {3, 1, 4}; Circle(2) = {4, 1, 2}; Line(3) = {2, 5}; Circle(4) = {5, 1, 7};
Circle(5) = {7, 1, 6}; Line(6) = {6, 3};
Curve Loop(1) = {1, 2, 3, 4, 5, 6}; Plane Surface(1) = {1};
Mesh.MeshSizeMax = 1;
Physical Curve("zone 1") = {4, 5}; Physical Curve("bore") = {1, 2};
)");
  EXPECT_THAT(text, HasSubstr("shape = \"cylinder\"\ncenter = [0.0, 0.0]  # mm\nradius = 4.995"));
  EXPECT_THAT(text, HasSubstr("press = { direction = [0.0, -1.0]"));
  const Outcome check = gnomon({"check", "part.toml"});
  EXPECT_EQ(check.exit_code, 0) << check.err;
}

// The side that looks away from the sole is not the one whose name says that it is held.
TEST_F(NewScene, GuessesByNames) {
  const std::string block = R"(Point(1) = {0, 0, 0, 1}; Point(2) = {4, 0, 0, 1};
Point(3) = {4, 4, 0, 1}; Point(4) = {0, 4, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Curve("my sole") = {1};
)";
  EXPECT_THAT(scene(block), HasSubstr("on = \"...\""));  // nothing else has a name
  std::filesystem::remove(folder() / "part.toml");
  const std::string text =
      scene(block + "Physical Curve(\"away\") = {3}; Physical Curve(\"clamped\") = {4};\n");
  EXPECT_THAT(text, HasSubstr("on = \"clamped\""));
  EXPECT_THAT(text, HasSubstr("on = [\"my sole\"]"));
}

/// Of a mesh in another folder than the scene.
TEST_F(NewScene, FindsItsMesh) {
  std::filesystem::create_directory(folder() / "parts");
  write("parts/plate.geo", R"geo(SetFactory("OpenCASCADE"); Rectangle(1) = {0, 0, 0, 4, 4};
Mesh.MeshSizeMax = 1;
Physical Curve("face") = {3}; Physical Curve("base") = {1}; Physical Surface("plate") = {1};
)geo");
  const std::string mesh = (folder() / "parts/plate.geo").string();
  ASSERT_EQ(gnomon({"new", mesh, "-o", "plate.toml"}).exit_code, 0);
  EXPECT_THAT(test::read_text(folder() / "plate.toml"), HasSubstr("file = \"parts/plate.geo\""));
  const Outcome check = gnomon({"check", "plate.toml"});
  EXPECT_EQ(check.exit_code, 0) << check.err;
}

constexpr const char* pin_on_disc = R"(Point(1) = {0, 0, 0, 0.05}; Point(2) = {0, 5, 0};
Point(3) = {3, 1, 0, 0.5}; Point(4) = {3, 6, 0, 1}; Point(5) = {0, 6, 0, 1};
Circle(1) = {1, 2, 3}; Line(2) = {3, 4}; Line(3) = {4, 5}; Line(4) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Point(11) = {0, 0, 0, 0.07}; Point(12) = {4, 0, 0, 0.8}; Point(13) = {4, -4, 0, 1};
Point(14) = {0, -4, 0, 1};
Line(11) = {14, 13}; Line(12) = {13, 12}; Line(13) = {12, 11}; Line(14) = {11, 14};
Curve Loop(11) = {11, 12, 13, 14}; Plane Surface(11) = {11};
Physical Surface("pin") = {1}; Physical Surface("the disc") = {11};
Physical Curve("tip") = {1}; Physical Curve("pin side") = {2}; Physical Curve("top") = {3};
Physical Curve("pin axis") = {4}; Physical Curve("track") = {13}; Physical Curve("under") = {11};
Physical Curve("disc axis") = {14};
)";

// The lower body is held and moves, and both are held on their plane of symmetry.
TEST_F(NewScene, OfTwoBodiesPressesOneOnTheOther) {
  const std::string text = scene(pin_on_disc);
  EXPECT_THAT(text, HasSubstr("[[body]]\nname = \"pin\"\n"));
  EXPECT_THAT(text, HasSubstr("[[body]]\nname = \"the disc\"\n"));
  EXPECT_THAT(text, HasSubstr("\nbodies = [\"pin\", \"the disc\"]\n"));
  EXPECT_THAT(text, HasSubstr("\nbody = \"the disc\"\nvelocity = [1000.0, 0.0]"));
  EXPECT_THAT(text, HasSubstr("\non = \"under\"\ndirections = [\"x\", \"y\"]\n"));
  EXPECT_THAT(text, HasSubstr("\non = \"disc axis\"\ndirections = [\"x\"]\n"));
  EXPECT_THAT(text, HasSubstr("\non = \"pin axis\"\ndirections = [\"x\"]\n"));
  EXPECT_THAT(text, HasSubstr("\non = \"top\"\nforce = [0.0, -100.0]"));
  EXPECT_THAT(text, HasSubstr("[wear]\non = [\"tip\", \"track\"]\n"));
  EXPECT_THAT(text, Not(HasSubstr("[counter_body]")));
  const Outcome check = gnomon({"check", "part.toml"});
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_THAT(check.out, HasSubstr("may touch"));
}

// Names say more than places: the upper body is held where it is clamped.
TEST_F(NewScene, OfTwoBodiesHoldsTheOneThatSoundsHeld) {
  std::string geometry = pin_on_disc;
  geometry.replace(geometry.find("\"top\""), 5, "\"clamped\"");
  const std::string text = scene(geometry);
  EXPECT_THAT(text, HasSubstr("\nbody = \"pin\"\nvelocity = "));
  EXPECT_THAT(text, HasSubstr("\non = \"clamped\"\ndirections = [\"x\", \"y\"]\n"));
  EXPECT_THAT(text, HasSubstr("\non = \"under\"\nforce = [0.0, 100.0]"));
  const Outcome check = gnomon({"check", "part.toml"});
  EXPECT_EQ(check.exit_code, 0) << check.err;
}

// Without a name of what touches or what could be held the user is asked for one.
TEST_F(NewScene, OfTwoBodiesLeavesWhatHasNoNameOpen) {
  const std::string geometry = pin_on_disc;
  const std::string text = scene(geometry.substr(0, geometry.find("Physical Curve")) +
                                 "Physical Curve(\"top\") = {3};\n");
  EXPECT_THAT(text, HasSubstr("[wear]\non = [\"...\"]\n"));
  EXPECT_THAT(text, HasSubstr("# holds \"the disc\"; may be several\non = \"...\"\n"));
  EXPECT_THAT(text, HasSubstr("\non = \"top\"\ndirections = [\"x\"]\n"));
  EXPECT_THAT(text, HasSubstr("\non = \"top\"\nforce = [0.0, -100.0]"));
  const Outcome check = gnomon({"check", "part.toml"});
  EXPECT_EQ(check.exit_code, 2);
  EXPECT_THAT(check.err, HasSubstr("\"...\""));
}

constexpr const char* stack = R"(SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 6, 6, 2}; Box(2) = {1, 1, 2, 4, 4, 2}; Box(3) = {2, 2, 4, 2, 2, 2};
Physical Volume("low") = {1}; Physical Volume("mid") = {2}; Physical Volume("high") = {3};
For v In {1:3}
  b() = Boundary{ Volume{v}; };
  For i In {0:5}
    Physical Surface(Sprintf("%g_%g", v, i)) = {b(i)};
  EndFor
EndFor
Mesh.MeshSizeMax = 2;
)";

// Sides whose planes differ guide: none is one of symmetry. The first does not face the last.
TEST_F(NewScene, OfAStackHasEachBodyOnTheOneBelow) {
  const std::string text = scene(stack);
  EXPECT_THAT(text, HasSubstr("\nbodies = [\"low\", \"mid\"]\n"));
  EXPECT_THAT(text, HasSubstr("\nbodies = [\"mid\", \"high\"]\n"));
  EXPECT_THAT(text, Not(HasSubstr("\nbodies = [\"low\", \"high\"]\n")));
  EXPECT_THAT(text, Not(HasSubstr("plane of symmetry")));
  EXPECT_THAT(text, HasSubstr("# presses \"mid\" on \"low\"\n"));
  EXPECT_THAT(text, HasSubstr("# presses \"high\" on \"mid\"\non = \"3_5\"\n"));
  EXPECT_THAT(text, HasSubstr("\non = \"1_4\"\ndirections = [\"x\", \"y\", \"z\"]\n"));
  EXPECT_THAT(text, HasSubstr("[wear]\non = [\"1_5\", \"2_4\", \"2_5\", \"3_4\"]\n"));
  const Outcome check = gnomon({"check", "part.toml"});
  EXPECT_EQ(check.exit_code, 0) << check.err;
}

// The pads share the line between them, which bonds them.
TEST_F(NewScene, OfBondedBodiesOnAnotherOneHasThemAll) {
  const std::string text = scene(R"(SetFactory("OpenCASCADE");
Rectangle(1) = {-2, 0, 0, 2, 1}; Rectangle(2) = {0, 0, 0, 2, 1}; BooleanFragments{ Surface{1, 2}; Delete; }{}
Rectangle(3) = {-3, -1, 0, 6, 1};
Physical Surface("left") = {1}; Physical Surface("right") = {2}; Physical Surface("base") = {3};
Mesh.MeshSizeMax = 0.4;
)");
  EXPECT_THAT(text, HasSubstr("\nbodies = [\"left\", \"base\"]\n"));
  EXPECT_THAT(text, HasSubstr("\nbodies = [\"right\", \"base\"]\n"));
  EXPECT_THAT(text, Not(HasSubstr("\nbodies = [\"left\", \"right\"]\n")));
}

constexpr const char* apart = R"(SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 1, 1}; Rectangle(2) = {2, 2, 0, 1, 1};
Physical Surface("a") = {1}; Physical Surface("b") = {2};
)";

TEST_F(NewScene, OfBodiesThatDoNotFaceEachOtherIsRefused) {
  write("part.geo", apart);
  const Outcome outcome = gnomon({"new", "part.geo"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("part.geo: expected bodies that face each other"));
  EXPECT_FALSE(std::filesystem::exists(folder() / "part.toml"));
}

}  // namespace
}  // namespace gnomon::new_scene_test
