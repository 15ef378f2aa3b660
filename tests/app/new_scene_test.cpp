// Scenes that gnomon new proposes: groups that exist, by what their names say.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <gnomon/mesh/mesh_file.hpp>

#include "app/child.hpp"

namespace gnomon::new_scene_test {
namespace {

using test::Outcome;
using ::testing::HasSubstr;

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

}  // namespace
}  // namespace gnomon::new_scene_test
