// What users do with a part of their own: mesh, new, check, run, resume, scene, history.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <gnomon/mesh/mesh_file.hpp>
#include <nlohmann/json.hpp>

#include "app/child.hpp"

namespace gnomon {
namespace {

using test::Outcome;
using testing::HasSubstr;

const std::filesystem::path shipped = GNOMON_SOURCE_DIR "/problems/worn_body";

class PartCommands : public test::ProgramTest {
protected:
  void SetUp() override {
    if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
    for (const char* file : {"block_on_ring.geo", "block_on_ring.toml"})
      std::filesystem::copy_file(shipped / file, folder() / file);
  }
  Outcome run(double end) const {
    return gnomon({"run", "block_on_ring.toml", "--set", "mesh.factor=4", "--set",
                   "time.end=" + std::to_string(end), "--set", "output.times=[]", "-o", "a.h5",
                   "--quiet", "--summary", "s.json"});
  }
};

TEST_F(PartCommands, MeshTellsWhatAGeometryHas) {
  const Outcome outcome = gnomon({"mesh", "block_on_ring.geo"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("quadrilaterals, area 32 mm^2"));
  EXPECT_THAT(outcome.out, testing::ContainsRegex("bottom +[0-9]+ +8 +flat, normal \\[0, -1\\]"));
  EXPECT_THAT(outcome.out, testing::ContainsRegex("surface +[0-9]+ +3.2 +flat, normal \\[0, 1\\]"));
}

TEST_F(PartCommands, MeshDrawsTheNamedPartsAndWritesThemForParaView) {
  for (const std::string picture : {"mesh.png", "mesh.svg", "mesh.xdmf", "mesh.xdmf"}) {
    const Outcome outcome = gnomon({"mesh", "block_on_ring.geo", "--size", "1", "-o", picture});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("\n" + picture + "\n"));
    EXPECT_THAT(outcome.err, testing::IsEmpty());
  }
  EXPECT_THAT(test::read_text(folder() / "mesh.svg"), HasSubstr("</svg>"));
  EXPECT_EQ(test::read_text(folder() / "mesh.png").substr(1, 3), "PNG");
  const std::string view = test::read_text(folder() / "mesh.xdmf");
  for (const char* name : {"body", "bottom", "surface"})
    EXPECT_THAT(view, HasSubstr(std::string("<Grid Name=\"") + name + "\""));
}

TEST_F(PartCommands, MeshRefusesOtherPicturesAndOtherFiles) {
  write("mine.xdmf", "<Xdmf/>");
  for (const char* picture : {"mesh.pdf", "mesh", "mine.xdmf", "nowhere/mesh.png"}) {
    const Outcome outcome = gnomon({"mesh", "block_on_ring.geo", "-o", picture});
    EXPECT_EQ(outcome.exit_code, 2) << picture;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  }
  EXPECT_EQ(test::read_text(folder() / "mine.xdmf"), "<Xdmf/>");
}

TEST_F(PartCommands, NewWritesASceneThatChecksAndNeverReplacesOne) {
  const Outcome outcome = gnomon({"new", "block_on_ring.geo", "-o", "mine.toml"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  // A plane that meets the surface from above.
  EXPECT_THAT(test::read_text(folder() / "mine.toml"),
              HasSubstr("press = { direction = [0.0, -1.0]"));
  const Outcome check = gnomon({"check", "mine.toml", "--set", "mesh.factor=3"});
  EXPECT_EQ(check.exit_code, 0) << check.err;
  EXPECT_THAT(check.out, HasSubstr("rigid_motion"));
  const std::string before = test::read_text(folder() / "mine.toml");
  const Outcome again = gnomon({"new", "block_on_ring.geo", "-o", "mine.toml"});
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("mine.toml exists"));
  EXPECT_EQ(test::read_text(folder() / "mine.toml"), before);
}

TEST_F(PartCommands, AResultNeedsNeitherSceneNorGeometryToGoOn) {
  ASSERT_EQ(run(300).exit_code, 0);
  for (const char* file : {"block_on_ring.geo", "block_on_ring.toml"})
    std::filesystem::remove(folder() / file);
  const Outcome outcome =
      gnomon({"resume", "a.h5", "--end", "600", "--quiet", "--summary", "later.json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = nlohmann::json::parse(test::read_text(folder() / "later.json"));
  const double worn = 2e-9 * 10.8333 * 500 * 600;  // k P s
  EXPECT_NEAR(json["worn_volume"].get<double>() / worn, 1, 1e-5);
}

TEST_F(PartCommands, SceneAndHistoryComeBackFromAResult) {
  ASSERT_EQ(run(300).exit_code, 0);
  const Outcome scene = gnomon({"scene", "a.h5"});
  EXPECT_EQ(scene.exit_code, 0);
  EXPECT_THAT(scene.out, HasSubstr("geometry = \"block_on_ring.geo\""));
  const Outcome history = gnomon({"history", "a.h5"});
  ASSERT_EQ(history.exit_code, 0);
  EXPECT_THAT(history.out, testing::StartsWith("t,step,order,newton_iterations,"));
  EXPECT_THAT(history.out, HasSubstr(",worn_volume [mm^2]"));
  const auto json = nlohmann::json::parse(test::read_text(folder() / "s.json"));
  const long lines = std::count(history.out.begin(), history.out.end(), '\n');
  EXPECT_EQ(lines, json["steps"].get<long>() + 2);  // with the header and the start
}

// One line, exit code 2, with the names that the mesh does have.
TEST_F(PartCommands, BadScenesOfPartsAreRefusedInOneLine) {
  const auto refusal = [&](const std::string& setting) {
    const Outcome outcome =
        gnomon({"check", "block_on_ring.toml", "--set", "mesh.factor=5", "--set", setting});
    EXPECT_EQ(outcome.exit_code, 2) << setting << "\n" << outcome.out;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    return outcome.err;
  };
  EXPECT_THAT(refusal("wear.on=[\"surfaces\"]"), HasSubstr("surface"));
  EXPECT_THAT(refusal("wear.on=[]"), HasSubstr("one group of the mesh or more"));
  EXPECT_THAT(refusal("wear.on=[\"surface\", \"surface\"]"), HasSubstr("share no facet"));
  EXPECT_THAT(refusal("wear.surfaces.bottom.rate=\"k * p\""), HasSubstr("one of wear.on"));
  EXPECT_THAT(refusal("support.1.on=botom"), HasSubstr("bottom"));
  EXPECT_THAT(refusal("support.1.directions=[\"q\"]"), HasSubstr("\"x\", \"y\""));
  EXPECT_THAT(refusal("support.1.directions=[\"x\"]"), HasSubstr("in 2 ways"));
  EXPECT_THAT(refusal("support.1.value=[0.1]"), HasSubstr("one number for each direction, 2"));
  EXPECT_THAT(refusal("support.1.times=[0.0]"), HasSubstr("support.1.factors"));
  EXPECT_THAT(refusal("support.2.directions=[\"x\"]"), HasSubstr("missing key `on`"));
  EXPECT_THAT(refusal("load.1.on=surface"), HasSubstr("one of force, traction"));
  EXPECT_THAT(refusal("load.1.force=[1.0, 2.0]"), HasSubstr("expected also `on`"));
  EXPECT_THAT(refusal("load.1.acceleration=[0.0, -9810.0]"), HasSubstr("body.density"));
  EXPECT_THAT(refusal("counter_body.shape=sphere"), HasSubstr("ball"));
  EXPECT_THAT(refusal("counter_body.center=[0.0, 20.0, 0.0]"), HasSubstr("2 numbers"));
  EXPECT_THAT(refusal("counter_body.major_radius=3.0"), HasSubstr("torus"));
  EXPECT_THAT(refusal("counter_body.press.direction=[0.0, 0.0]"), HasSubstr("length zero"));
  EXPECT_THAT(refusal("counter_body.press.direction=[0.0, 1.0]"),
              HasSubstr("a direction into the body"));
  EXPECT_THAT(refusal("shape.slide=[\"nowhere\"]"), HasSubstr("surface"));
  EXPECT_THAT(refusal("mesh.geometry=none.geo"), HasSubstr("none.geo"));
  EXPECT_THAT(refusal("mesh.file=a.msh"), HasSubstr("both"));
}

}  // namespace
}  // namespace gnomon
