// What users do with a part of their own: mesh, new, check, run, resume, scene, history.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gnomon/mesh/mesh_file.hpp>
#include <gnomon/results/results.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/child.hpp"

namespace gnomon::part_commands_test {
namespace {

using test::Outcome;
using ::testing::HasSubstr;

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
  if (!test::can_draw()) GTEST_SKIP() << test::drawing_needs;
  for (const std::string picture : {"mesh.png", "mesh.svg", "mesh.xdmf", "mesh.xdmf"}) {
    const Outcome outcome = gnomon({"mesh", "block_on_ring.geo", "--size", "1", "-o", picture});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("\n" + picture + "\n"));
    EXPECT_THAT(outcome.err, testing::IsEmpty());
  }
  EXPECT_THAT(test::read_text(folder() / "mesh.svg"), HasSubstr("</svg>"));
  EXPECT_EQ(test::read_text(folder() / "mesh.png").substr(1, 3), "PNG");
  const std::string check = "/usr/bin/python3 '" GNOMON_SOURCE_DIR
                            "/tests/app/check_mesh_view.py' '" GNOMON_SOURCE_DIR "/tools/plot' '";
  EXPECT_EQ(std::system((check + (folder() / "mesh.xdmf").string() + "'").c_str()), 0);
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

/// Cells that hold what separates cells are quoted.
TEST_F(PartCommands, NamesWithCommasDoNotShiftColumns) {
  write("two.geo", R"(SetFactory("OpenCASCADE");
Rectangle(1) = {-1, 0, 0, 2, 1}; Rectangle(2) = {-3, -1, 0, 6, 1};
Transfinite Curve "*" = 7; Transfinite Surface "*"; Recombine Surface "*";
Physical Surface("pin, left") = {1}; Physical Surface("base") = {2};
Physical Curve("foot") = {1}; Physical Curve("sides") = {2, 4}; Physical Curve("top") = {3};
Physical Curve("bottom") = {5}; Physical Curve("face") = {7};
)");
  write("two.toml", R"(problem = "worn_body"
mesh.file = "two.geo"
body = [ { name = "pin, left", young_modulus = 1e3, poisson_ratio = 0.3 },
         { name = "base", young_modulus = 1e3, poisson_ratio = 0.3 } ]
pair = [ { bodies = ["base", "pin, left"], friction = 0.0 } ]
motion = [ { body = "base", velocity = [1.0, 0.0] } ]
support = [ { on = "bottom" }, { on = "sides", directions = ["x"] } ]
load = [ { on = "top", force = [0.0, -1.0] } ]
wear = { on = ["foot", "face"], coefficient = 1e-6, surfaces.face.path = 10.0 }
time.end = 1.0
)");
  const Outcome ended = gnomon({"run", "two.toml", "-o", "two.h5", "--quiet"});
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const std::string history = gnomon({"history", "two.h5"}).out;
  const auto cells = [](const std::string& line) {
    bool is_quoted = false;
    return 1 + std::ranges::count_if(line, [&](char c) {
             if (c == '"') is_quoted = !is_quoted;
             return c == ',' && !is_quoted;
           });
  };
  const std::size_t first = history.find('\n'), second = history.find('\n', first + 1);
  EXPECT_THAT(history.substr(0, first), HasSubstr("pin, left"));
  EXPECT_EQ(cells(history.substr(0, first)), cells(history.substr(first + 1, second - first - 1)));
}

TEST_F(PartCommands, SceneAndHistoryComeBackFromAResult) {
  ASSERT_EQ(run(300).exit_code, 0);
  const Outcome scene = gnomon({"scene", "a.h5"});
  EXPECT_EQ(scene.exit_code, 0);
  EXPECT_THAT(scene.out, HasSubstr("file = \"" + (folder() / "block_on_ring.geo").string()));
  const Outcome history = gnomon({"history", "a.h5"});
  ASSERT_EQ(history.exit_code, 0);
  EXPECT_THAT(history.out, testing::StartsWith("t,step,order,newton_iterations,"));
  EXPECT_THAT(history.out, HasSubstr(",worn_volume [mm^2]"));
  const auto json = nlohmann::json::parse(test::read_text(folder() / "s.json"));
  const long lines = std::count(history.out.begin(), history.out.end(), '\n');
  EXPECT_EQ(lines, json["steps"].get<long>() + 2);  // with the header and the start
}

// Somewhere else, with nothing but the result: the mesh is in it.
TEST_F(PartCommands, TheMeshComesBackFromAResult) {
  ASSERT_EQ(run(300).exit_code, 0);
  std::filesystem::create_directory(folder() / "elsewhere");
  std::filesystem::rename(folder() / "a.h5", folder() / "elsewhere/a.h5");
  std::filesystem::remove(folder() / "block_on_ring.geo");
  const Outcome scene = gnomon({"scene", "elsewhere/a.h5"});
  EXPECT_THAT(scene.out, HasSubstr("# The mesh is in the result too: gnomon mesh elsewhere/a.h5 "
                                   "-o PART.msh writes it"));
  const Outcome mesh = gnomon({"mesh", "elsewhere/a.h5", "-o", "again.msh"});
  ASSERT_EQ(mesh.exit_code, 0) << mesh.err;
  EXPECT_THAT(mesh.out, HasSubstr("quadrilaterals, area 32 mm^2"));
  EXPECT_THAT(mesh.out, testing::ContainsRegex("surface +[0-9]+ +3.2 +flat, normal \\[0, 1\\]"));

  std::string text = scene.out;
  const std::size_t begin = text.find("file = "), end = text.find('\n', begin);
  text.replace(begin, end - begin, "file = \"again.msh\"");
  write("again.toml", text);
  const Outcome again = gnomon({"run", "again.toml", "--set", "mesh.factor=1", "-o", "b.h5",
                                "--quiet", "--summary", "t.json"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const auto summary = [&](const char* file) {
    return nlohmann::json::parse(test::read_text(folder() / file));
  };
  const auto first = summary("s.json"), second = summary("t.json");
  EXPECT_EQ(second["unknowns"], first["unknowns"]);
  for (const char* name : {"worn_volume", "max_pressure", "element_quality"})
    EXPECT_NEAR(second[name].get<double>() / first[name].get<double>(), 1, 1e-6) << name;
}

// A file with a mesh does not say that it is a section of a body of revolution; its result does.
TEST_F(PartCommands, TheMeshOfAResultHasTheAxesOfItsPlane) {
  ASSERT_EQ(run(1).exit_code, 0);
  ASSERT_EQ(gnomon({"mesh", "a.h5", "-o", "plane.xdmf"}).exit_code, 0);
  EXPECT_THAT(test::read_text(folder() / "plane.xdmf"), HasSubstr("\"axes\" Value=\"x y\""));
  const Outcome outcome =
      gnomon({"run", (shipped / "hertz_ball_axisymmetric.toml").string(), "--set", "mesh.factor=6",
              "--set", "time.end=1", "--set", "output.times=[]", "-o", "ball.h5", "--quiet"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  ASSERT_EQ(gnomon({"mesh", "ball.h5", "-o", "section.xdmf"}).exit_code, 0);
  EXPECT_THAT(test::read_text(folder() / "section.xdmf"), HasSubstr("\"axes\" Value=\"r z\""));
}

TEST_F(PartCommands, MeshRefusesResultsWithoutAMeshFromAFile) {
  ASSERT_EQ(gnomon({"run", test::pin, "--set", test::coarse, "--set", "time.end=1", "-o", "pin.h5",
                    "--quiet"})
                .exit_code,
            0);
  const Outcome outcome = gnomon({"mesh", "pin.h5"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err,
            "gnomon: pin.h5: expected a result with a mesh from a file; gnomon made the mesh of "
            "this one\n");
  EXPECT_THAT(gnomon({"scene", "pin.h5"}).out, testing::StartsWith("problem = "));
}

TEST_F(PartCommands, CheckTellsAllMistakesOfAPartAtOnce) {
  const auto complaints = [&](const std::vector<std::string>& settings) {
    std::vector<std::string> arguments = {"check", "block_on_ring.toml", "--set", "mesh.factor=5"};
    for (const std::string& setting : settings) {
      arguments.emplace_back("--set");
      arguments.push_back(setting);
    }
    const Outcome outcome = gnomon(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.out;
    return outcome.err;
  };
  // Keys are right, and their values wrong for this mesh.
  const std::string values = complaints(
      {"support.1.on=botom", "wear.on=[\"surfac\"]", "shape.hold=[\"here\"]", "load.1.on=top",
       "load.1.force=[1.0]", "load.2.pressure=3.0", "counter_body.press.times=[1.0]"});
  for (const char* part :
       {"--set support.1.on: ", "--set wear.on: ", "--set shape.hold: ", "--set load.1.on: ",
        "--set load.2.pressure: expected also `on`", "--set counter_body.press.times: "})
    EXPECT_THAT(values, HasSubstr(std::string("gnomon: ") + part));
  EXPECT_EQ(std::count(values.begin(), values.end(), '\n'), 6) << values;
  // A surface's own law is checked as wear.rate is.
  EXPECT_THAT(complaints({"wear.surfaces.surface.rate=\"k * (p + 1) * v\""}),
              HasSubstr("gnomon: --set wear.surfaces.surface.rate: expected no wear without pres"));
  EXPECT_THAT(complaints({"wear.surfaces.surface.rate=\"kk * p * v\""}),
              HasSubstr("gnomon: --set wear.surfaces.surface.rate: column 1: unknown name"));
  // Keys are wrong, and so are names of groups.
  const std::string keys =
      complaints({"body.E=3.0", "time.end=-1", "support.1.on=botom", "wear.on=[\"surfac\"]"});
  for (const char* part : {"body.E: unknown key, did you mean `body.young_modulus`?",
                           "time.end: expected", "support.1.on: ", "wear.on: "})
    EXPECT_THAT(keys, HasSubstr(std::string("gnomon: --set ") + part));
  EXPECT_EQ(std::count(keys.begin(), keys.end(), '\n'), 4) << keys;
}

TEST_F(PartCommands, MeshWritesTheMeshThatARunUses) {
  ASSERT_EQ(gnomon({"mesh", "block_on_ring.geo", "--size", "1", "-o", "b.msh"}).exit_code, 0);
  std::filesystem::rename(folder() / "b.msh", folder() / "first.msh");
  const Outcome again = gnomon({"mesh", "first.msh", "-o", "b.msh"});
  ASSERT_EQ(again.exit_code, 0) << again.err;
  EXPECT_THAT(again.out, testing::ContainsRegex("surface +[0-9]+ +3.2 +flat, normal \\[0, 1\\]"));
  EXPECT_EQ(test::read_text(folder() / "b.msh"), test::read_text(folder() / "first.msh"));
  EXPECT_EQ(gnomon({"mesh", "first.msh", "-o", "b.msh"}).exit_code, 2);
  EXPECT_EQ(gnomon({"mesh", "first.msh", "-o", "c.txt"}).exit_code, 2);
}

std::string replaced(std::string text, const std::string& part, const std::string& by) {
  const std::size_t at = text.find(part);
  EXPECT_NE(at, std::string::npos) << part;
  return text.replace(at, part.size(), by);
}

TEST_F(PartCommands, AMissingMeshIsNamedWithTheLineOfItsKey) {
  std::filesystem::remove(folder() / "block_on_ring.geo");
  EXPECT_THAT(gnomon({"check", "block_on_ring.toml"}).err,
              HasSubstr("block_on_ring.toml:9: key `mesh.file`: block_on_ring.geo: no such"));
  // What can be told without the mesh is told too.
  const std::string all =
      gnomon({"check", "block_on_ring.toml", "--set", "load.1.on=surface", "--set",
              "support.1.times=[0.0]", "--set", "counter_body.major_radius=3.0"})
          .err;
  for (const char* part :
       {"no such file", "one of force, moment, traction", "support.1.factors", "torus"})
    EXPECT_THAT(all, HasSubstr(part));
  EXPECT_EQ(std::count(all.begin(), all.end(), '\n'), 4) << all;
  std::string scene = test::read_text(folder() / "block_on_ring.toml");
  scene.replace(scene.find("file ="), 6, "factor = 2 # ");
  write("without.toml", scene);
  EXPECT_THAT(gnomon({"check", "without.toml"}).err,
              HasSubstr("without.toml: section [mesh]: expected `file`, a mesh, or a geometry"));
}

TEST_F(PartCommands, GroupsOfPointsAreSuggestedAndListed) {
  write("block_on_ring.geo",
        test::read_text(folder() / "block_on_ring.geo") + "Physical Point(\"keel\") = {1};\n");
  EXPECT_THAT(gnomon({"check", "block_on_ring.toml", "--set", "support.2.on=kel"}).err,
              HasSubstr("did you mean \"keel\"?"));
  ASSERT_EQ(gnomon({"new", "block_on_ring.geo", "-o", "mine.toml"}).exit_code, 0);
  EXPECT_THAT(test::read_text(folder() / "mine.toml"), HasSubstr("for supports: keel\n"));
}

TEST_F(PartCommands, ContactNamesTheSurfaceOfEachNode) {
  write("block_on_ring.geo", R"(
Point(1) = {-4, -4, 0, 1}; Point(2) = {4, -4, 0, 1}; Point(3) = {4, 0, 0, 1};
Point(4) = {0, 0, 0, 1}; Point(5) = {-4, 0, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5}; Plane Surface(1) = {1};
Physical Curve("bottom") = {1}; Physical Curve("right, worn") = {3}; Physical Curve("left") = {4};
)");
  ASSERT_EQ(gnomon({"run", "block_on_ring.toml", "--set", "wear.on=[\"right, worn\", \"left\"]",
                    "--set", "time.end=1", "--set", "output.times=[]", "-o", "a.h5", "--quiet"})
                .exit_code,
            0);
  std::istringstream table(gnomon({"contact", "a.h5"}).out);
  std::string line;
  std::getline(table, line);
  EXPECT_THAT(line, testing::EndsWith(",pressure [MPa],wear_depth [mm],active,surface"));
  int rows = 0;
  for (; std::getline(table, line); ++rows) {
    const double x = std::stod(line.substr(line.find(',') + 1));
    EXPECT_THAT(line, testing::EndsWith(x > -1e-9 ? ",\"right, worn\"" : ",left"));
  }
  EXPECT_GE(rows, 9);
}

TEST_F(PartCommands, SizesThatMeanNothingAreRefused) {
  for (const std::string command : {"mesh", "new"})
    for (const char* size : {"0", "-1"}) {
      const std::string output = command == "mesh" ? "sized.msh" : "sized.toml";
      const Outcome outcome = gnomon({command, "block_on_ring.geo", "--size", size, "-o", output});
      EXPECT_EQ(outcome.exit_code, 2) << command << size;
      EXPECT_THAT(outcome.err, HasSubstr(": expected a positive length"));
    }
}

TEST_F(PartCommands, WithoutAnyLoadCheckSaysWhatCouldPress) {
  write("free.toml", replaced(test::read_text(folder() / "block_on_ring.toml"),
                              "[0.0, -1.0], force = 10.8333", "[0.0, -1.0]"));
  const Outcome outcome = gnomon({"check", "free.toml", "--set", "mesh.factor=5"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_THAT(outcome.err, HasSubstr("free.toml: expected something that presses"));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
}

// Of a ring that is pressed, that is moved, and that turns about a point beside its centre, the
// stored surface is where the nodes in contact are.
TEST_F(PartCommands, TheStoredCounterBodyTouchesTheNodesInContact) {
  const std::string scene = test::read_text(folder() / "block_on_ring.toml");
  const std::string motion = "velocity = [500.0, 0.0]", force = "force = 10.8333";
  const double rate = 1e-3, off = 0.1;  // rad/s, mm
  write("pressed.toml", scene);
  write("moved.toml", replaced(scene, force, "approach = [1e-3, 2e-3], times = [0.0, 300.0]"));
  write("turns.toml", replaced(scene, motion, "rotation = 1e-3, center = [0.0, 19.9]"));
  for (const std::string name : {"pressed", "moved", "turns"}) {
    const Outcome outcome =
        gnomon({"run", name + ".toml", "--set", "mesh.factor=4", "--set", "time.end=300", "--set",
                "output.times=[100]", "-o", name + ".h5", "--quiet"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    const ResultReader reader(folder() / (name + ".h5"));
    const std::vector<double> times = reader.stored_times();
    ASSERT_EQ(times.size(), 3u);
    for (std::size_t step = 0; step < times.size(); ++step) {
      const double x = name == "turns" ? -off * std::sin(rate * times[step]) : 0;
      const auto centre = [&](const std::array<double, 3>& point) {
        return point[1] + std::sqrt(400 - (point[0] - x) * (point[0] - x));
      };
      const auto surface = reader.counter_surface(step);
      ASSERT_TRUE(surface);
      const double y = centre(surface->points.front());
      for (const auto& point : surface->points) EXPECT_NEAR(centre(point), y, 1e-12);
      const ContactSurface contact = reader.contact(times[step]);
      int active = 0;
      for (std::size_t i = 0; i < contact.node.size(); ++i)
        if (contact.active[i]) {
          EXPECT_NEAR(centre(contact.current[i]), y, 1e-9) << name;
          ++active;
        }
      EXPECT_GT(active, 0);
    }
  }
}

// A held group that contains the wearing one; without wear it is a contact analysis.
TEST_F(PartCommands, WearOfNodesThatAreAllHeldIsRefused) {
  write("block_on_ring.geo",
        test::read_text(folder() / "block_on_ring.geo") + "Physical Curve(\"top\") = {3, 4, 5};\n");
  const std::vector<std::string> held = {"check", "block_on_ring.toml", "--set",
                                         "shape.hold=[\"top\"]", "--set"};
  const auto check = [&](std::string setting) {
    std::vector<std::string> arguments = held;
    arguments.push_back(std::move(setting));
    return gnomon(arguments);
  };
  EXPECT_THAT(check("mesh.factor=4").err, HasSubstr("expected surfaces that can wear"));
  EXPECT_EQ(check("wear.coefficient=0").exit_code, 0);
}

// At rest there is no wear to be lost, and below rounding errors of the volume it cannot be seen.
TEST_F(PartCommands, WearThatCannotBeSeenIsNotMissed) {
  const auto summary = [&](const std::string& setting) {
    const Outcome outcome = gnomon({"run",     "block_on_ring.toml",
                                    "--set",   "mesh.factor=4",
                                    "--set",   "time.end=300",
                                    "--set",   "output.times=[]",
                                    "--set",   "integrator.name=backward-euler",
                                    "--set",   "integrator.step=100",
                                    "--set",   setting,
                                    "-o",      "a.h5",
                                    "--quiet", "--summary",
                                    "s.json",  "--force"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(test::read_text(folder() / "s.json"));
  };
  const auto resting = summary("counter_body.motion.velocity=[0.0, 0.0]");
  EXPECT_EQ(resting["worn_volume"].get<double>(), 0);
  EXPECT_THAT(resting["remarks"].dump(), HasSubstr("does not slide"));
  EXPECT_THAT(resting["warnings"].dump(), Not(HasSubstr("worn volume")));
  const auto little = summary("wear.coefficient=1e-30");
  EXPECT_THAT(little["warnings"].dump(), HasSubstr("is lost in the rounding"));
}

TEST_F(PartCommands, GroupsWithoutElementsAreTold) {
  ASSERT_EQ(gnomon({"mesh", "block_on_ring.geo", "--size", "1", "-o", "b.msh"}).exit_code, 0);
  std::string mesh = test::read_text(folder() / "b.msh");
  const std::size_t names = mesh.find("$PhysicalNames\n") + 15, end = mesh.find('\n', names);
  const int count = std::stoi(mesh.substr(names, end - names));
  mesh.replace(names, end - names, std::to_string(count + 1) + "\n1 77 \"left\"");
  write("named.msh", mesh);
  const Outcome outcome = gnomon({"mesh", "named.msh"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("\n\"left\" has no elements\n"));
  std::string scene = test::read_text(folder() / "block_on_ring.toml");
  const std::string geometry = "file = \"block_on_ring.geo\"";
  write("mesh.toml", scene.replace(scene.find(geometry), geometry.size(), "file = \"named.msh\""));
  EXPECT_THAT(gnomon({"check", "mesh.toml"}).out, HasSubstr("# \"left\" has no elements\n"));
  EXPECT_THAT(gnomon({"check", "mesh.toml", "--set", "support.1.on=left"}).err,
              HasSubstr("--set support.1.on: named.msh: \"left\" has no elements\n"));
}

// In a scene, by --set, and in the scene that a result has.
TEST_F(PartCommands, NamesOfGroupsMayHaveBlanksDotsAndQuotes) {
  write("named.geo",
        "Point(1) = {-1, -1, 0, 0.5}; Point(2) = {1, -1, 0, 0.5}; Point(3) = {1, 0, 0, 0.5};\n"
        "Point(4) = {-1, 0, 0, 0.5}; Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4};\n"
        "Line(4) = {4, 1}; Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};\n"
        "Physical Curve(\"bottom side\") = {1}; Physical Curve(\"worn no. 1\") = {3};\n");
  ASSERT_EQ(gnomon({"new", "named.geo"}).exit_code, 0);
  const std::vector<std::string> run = {"run",        "named.toml", "--set",
                                        "time.end=1", "--set",      "wear.rate=0.5 * k * p * v",
                                        "--quiet",    "-o"};
  const auto worn = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--summary", "s.json"});
    std::filesystem::remove(folder() / "s.json");
    const Outcome outcome = gnomon(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    const auto json = nlohmann::json::parse(test::read_text(folder() / "s.json"));
    return json["worn_volume"].get<double>();
  };
  std::vector<std::string> half = run, whole = run;
  half.emplace_back("half.h5");
  whole.insert(whole.end(), {"whole.h5", "--set", "wear.surfaces.\"worn no. 1\".rate=k * p * v"});
  const double expected = 1e-8 * 100 * 1000 * 1;  // k P v t
  EXPECT_NEAR(worn(half), expected / 2, 1e-3 * expected);
  EXPECT_NEAR(worn(whole), expected, 1e-3 * expected);
  EXPECT_NEAR(worn({"resume", "whole.h5", "--end", "2", "--quiet"}), 2 * expected, 2e-3 * expected);
  write("named.toml", test::read_text(folder() / "named.toml") +
                          "[wear.surfaces.\"worn no. 2\"]\nrate = \"k * p * v\"\n");
  EXPECT_THAT(gnomon({"check", "named.toml"}).err,
              HasSubstr("expected one of wear.on, \"worn no. 1\", in the place of \"worn no. 2\""));
}

TEST_F(PartCommands, ConflictsOfGroupsAreNamed) {
  const auto check = [&](const std::vector<std::string>& settings) {
    std::vector<std::string> arguments = {"check", "block_on_ring.toml", "--set", "mesh.factor=5"};
    for (const std::string& setting : settings) {
      arguments.emplace_back("--set");
      arguments.push_back(setting);
    }
    return gnomon(arguments);
  };
  EXPECT_THAT(check({"shape.hold=[\"bottom\"]", "shape.slide=[\"bottom\"]"}).err,
              HasSubstr("--set shape.slide: expected groups that are not held, but \"bottom\" is"));
  write("block_on_ring.geo",
        test::read_text(folder() / "block_on_ring.geo") + "Physical Curve(\"both\") = {3, 4};\n");
  EXPECT_THAT(check({"wear.on=[\"surface\", \"both\"]"}).err,
              HasSubstr("share no facet, but \"surface\" and \"both\" do"));
  const Outcome loads = check({"load.1.on=bottom", "load.1.force=[1.0, 0.0]", "load.2.on=bottom",
                               "load.2.force=[2.0, 0.0]"});
  EXPECT_EQ(loads.exit_code, 0) << loads.err;
  EXPECT_THAT(loads.out,
              HasSubstr("# \"bottom\" has several loads, [[load]] number 1, 2: they add"));
  EXPECT_THAT(check({"load.1.on=surface", "load.1.pressure=3.0"}).out,
              HasSubstr("# [[load]] number 1 acts on \"surface\", which wears"));
  EXPECT_EQ(loads.out.find("which wears"), std::string::npos);
  // Along the surface it may be held.
  EXPECT_EQ(check({"support.2.on=surface", "support.2.directions=[\"x\"]"}).exit_code, 0);
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
  EXPECT_THAT(refusal("wear.on=[\"surface\", \"surface\"]"),
              HasSubstr("expected each group once, got \"surface\" twice"));
  EXPECT_THAT(refusal("wear.surfaces.surface.coefficient=1e-8"),
              HasSubstr("`wear.coefficient`: expected none"));
  EXPECT_THAT(refusal("wear.surfaces.bottom.rate=\"k * p\""), HasSubstr("one of wear.on"));
  EXPECT_THAT(refusal("support.1.on=botom"), HasSubstr("bottom"));
  EXPECT_THAT(refusal("support.1.directions=[\"q\"]"), HasSubstr("\"x\", \"y\""));
  EXPECT_THAT(refusal("support.1.directions=[\"x\"]"), HasSubstr("in 2 ways"));
  EXPECT_THAT(refusal("support.1.value=[0.1]"), HasSubstr("one number for each direction, 2"));
  EXPECT_THAT(refusal("support.1.times=[0.0]"), HasSubstr("support.1.factors"));
  EXPECT_THAT(refusal("support.2.on=bottom"), HasSubstr("\"bottom\" is already held along x"));
  EXPECT_THAT(refusal("support.1.directions=[\"x\", \"y\", \"x\"]"),
              HasSubstr("\"bottom\" is already held along x"));
  EXPECT_THAT(refusal("support.1.on=surface"), HasSubstr("would have no contact pressure"));
  EXPECT_THAT(refusal("shape.hold=[\"surface\"]"), HasSubstr("\"surface\" is in wear.on"));
  EXPECT_THAT(refusal("shape.slide=[\"surface\"]"), HasSubstr("\"surface\" is in wear.on"));
  EXPECT_THAT(refusal("support.2.directions=[\"x\"]"), HasSubstr("missing key `on`"));
  EXPECT_THAT(refusal("load.1.on=surface"), HasSubstr("one of force, moment, traction"));
  EXPECT_THAT(refusal("load.1.force=[1.0, 2.0]"), HasSubstr("expected also `on`"));
  EXPECT_THAT(refusal("load.1.acceleration=[0.0, -9810.0]"), HasSubstr("body.density"));
  EXPECT_THAT(refusal("counter_body.shape=sphere"), HasSubstr("ball"));
  EXPECT_THAT(refusal("counter_body.center=[0.0, 20.0, 0.0]"), HasSubstr("2 numbers"));
  EXPECT_THAT(refusal("counter_body.major_radius=3.0"), HasSubstr("torus"));
  EXPECT_THAT(refusal("counter_body.press.factors=[1.0]"),
              HasSubstr("also counter_body.press.times"));
  EXPECT_THAT(refusal("counter_body.press.direction=[0.0, 0.0]"), HasSubstr("length zero"));
  EXPECT_THAT(
      refusal("counter_body.press.direction=[0.0, 1.0]"),
      HasSubstr("a direction into the body, but the surfaces of wear.on face the same way"));
  EXPECT_THAT(refusal("counter_body.press.direction=[1.0, 0.0]"),
              HasSubstr("it lies in the surfaces of wear.on"));
  EXPECT_THAT(refusal("wear.coefficient=-1e-7"), ::testing::Not(HasSubstr("missing")));
  EXPECT_THAT(refusal("shape.slide=[\"nowhere\"]"), HasSubstr("surface"));
  EXPECT_THAT(refusal("mesh.file=none.geo"),
              HasSubstr("gnomon: --set mesh.file: none.geo: no such file"));
  EXPECT_THAT(refusal("counter_body.center=[30.0, 20.0]"), HasSubstr("it passes by: change"));
}

}  // namespace
}  // namespace gnomon::part_commands_test
