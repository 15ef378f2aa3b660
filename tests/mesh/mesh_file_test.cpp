// Files through Gmsh's library: meshes in all its formats, geometries, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/flat_part.hpp>
#include <gnomon/mesh/imported_body.hpp>
#include <gnomon/mesh/mesh_file.hpp>
#include <numbers>
#include <set>
#include <sstream>

#include "support/hexahedra.hpp"
#include "support/imported.hpp"

namespace gnomon::mesh_file_test {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

class MeshFile : public ::testing::Test {
protected:
  void SetUp() override {
    if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
    folder_ = fs::temp_directory_path() / ("gnomon-mesh-" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  /// What Gmsh does with a script that ends without a mesh, as one that saves files does.
  void run_script(const std::string& text) const {
    EXPECT_THROW(read_mesh_file(put("script.geo", text + "\nExit;\n")), InputError);
  }
  std::string refusal(const fs::path& file, const MeshFileOptions& options = {}) const {
    try {
      const ImportedMesh mesh = read_mesh_file(file, options);
      if (mesh.dimension == 3)
        check_mesh<3>(mesh);
      else
        check_mesh<2>(mesh);
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_EQ(message.find('\n'), message.npos) << message;
      EXPECT_THAT(message, ::testing::StartsWith(file.string() + ": "));
      return message.substr(file.string().size() + 2);
    }
    return "accepted";
  }

  fs::path folder_;
};

const char* block = R"(
Point(1) = {0, 0, 0, 0.5}; Point(2) = {4, 0, 0, 0.5}; Point(3) = {4, 1, 0, 0.1};
Point(4) = {0, 1, 0, 0.1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Curve("bottom") = {1}; Physical Curve("wear") = {3};
Physical Surface("block") = {1}; Physical Point("corner") = {1};
)";

template <int dim>
void expect_same(const ImportedBody<dim>& one, const ImportedBody<dim>& other) {
  ASSERT_EQ(one.mesh.nodes.size(), other.mesh.nodes.size());
  for (std::size_t n = 0; n < one.mesh.nodes.size(); ++n)
    EXPECT_NEAR((one.mesh.nodes[n] - other.mesh.nodes[n]).norm(), 0, 1e-14);
  EXPECT_EQ(one.mesh.cells, other.mesh.cells);
  EXPECT_EQ(one.mesh.boundary, other.mesh.boundary);
  EXPECT_EQ(one.cell_groups, other.cell_groups);
}

TEST_F(MeshFile, IsTheSameInAllFormats) {
  std::string script = std::string(block) +
                       "Extrude {0, 0, 2} {Surface{1}; Layers{3}; Recombine;}\n"
                       "Physical Volume(\"body\") = {1}; Physical Surface(\"top\") = {26};\n"
                       "Mesh.RecombineAll = 1; Mesh 3;\n";
  std::string plane = std::string(block) + "Mesh 2;\n";
  for (std::string* text : {&script, &plane})
    for (const char* version : {"4.1", "2.2"})
      for (const char* binary : {"0", "1"})
        *text += fmt::format("Mesh.MshFileVersion = {}; Mesh.Binary = {};\nSave \"{}{}{}.msh\";\n",
                             version, binary, text == &script ? "space" : "plane", version, binary);
  run_script(script);
  run_script(plane);
  const auto body = [this]<int dim>(std::integral_constant<int, dim>, const std::string& name) {
    return check_mesh<dim>(read_mesh_file(folder_ / name));
  };
  const auto flat = body(std::integral_constant<int, 2>(), "plane4.10.msh");
  EXPECT_EQ(flat.mesh.boundary.size(), 2u);
  EXPECT_GT(flat.mesh.boundary.at("wear").size(), 2 * flat.mesh.boundary.at("bottom").size());
  const auto solid = body(std::integral_constant<int, 3>(), "space4.10.msh");
  EXPECT_NEAR(volume(solid.mesh), 8, 1e-12);
  for (const char* other : {"4.11", "2.20", "2.21"}) {
    SCOPED_TRACE(other);
    expect_same(flat, body(std::integral_constant<int, 2>(), fmt::format("plane{}.msh", other)));
    expect_same(solid, body(std::integral_constant<int, 3>(), fmt::format("space{}.msh", other)));
  }
}

TEST_F(MeshFile, WrittenByHandIsReadAsItStands) {
  const ImportedMesh there = square(3);
  const ImportedMesh read = read_mesh_file(put("part.msh", msh22(there)));
  EXPECT_EQ(read.dimension, 2);
  EXPECT_EQ(read.nodes, there.nodes);
  EXPECT_EQ(read.node_tags, there.node_tags);
  EXPECT_EQ(read.cells.nodes, there.cells.nodes);
  EXPECT_EQ(read.cells.tags, there.cells.tags);
  EXPECT_EQ(read.facets.tags, there.facets.tags);
  EXPECT_EQ(check_mesh<2>(read).mesh.boundary.at("top").size(), 3u);
}

TEST_F(MeshFile, OfAGeometryInThePlaneIsOfQuadrilateralsOfTheSizeAskedFor) {
  const fs::path file = put("block.geo", block);
  std::size_t before = 0;
  for (double factor : {1.0, 0.5}) {
    const ImportedBody<2> body = check_mesh<2>(read_mesh_file(file, {.factor = factor}));
    EXPECT_THAT(body.remarks, ::testing::Each(HasSubstr("twice the size")));
    EXPECT_TRUE(flat_part(body.mesh, boundary_part(body, "wear")).flat);
    ASSERT_EQ(body.point_groups.at("corner").size(), 1u);
    EXPECT_EQ(body.mesh.nodes[body.point_groups.at("corner")[0]], Vector<2>(0, 0));
    const std::size_t wear = body.mesh.boundary.at("wear").size();
    EXPECT_NEAR(wear * factor * 0.1, 4, 0.25);  // the size at its ends
    EXPECT_NEAR(body.mesh.boundary.at("bottom").size() * factor * 0.5, 4, 0.6);
    EXPECT_GT(wear, before);
    before = wear;
  }
  // `size` is the largest edge; the geometry's smaller ones stay.
  const ImportedBody<2> body = check_mesh<2>(read_mesh_file(file, {.size = 0.2}));
  EXPECT_NEAR(body.mesh.boundary.at("bottom").size() * 0.2, 4, 0.5);
  EXPECT_NEAR(body.mesh.boundary.at("wear").size() * 0.1, 4, 0.25);
}

TEST_F(MeshFile, OfFarTooManyCellsIsRefusedBeforeItIsMade) {
  const fs::path plane = put("block.geo", block);
  // An area of 4 mm^2 has 4e8 cells of 1e-4 mm, and 4e16 of 1e-8 mm.
  const std::string refused = refusal(plane, {.size = 1e-4});
  EXPECT_THAT(refused, ::testing::MatchesRegex(
                           "size 0.0001 asks for about [3-9](.[0-9])?e\\+08 quadrilaterals, .*"));
  EXPECT_THAT(refusal(plane, {.size = 1e-8}), HasSubstr("size 1e-08 asks for about"));
  const fs::path space = put("cube.geo", std::string(block) + "Extrude {0, 0, 2} {Surface{1};}\n");
  EXPECT_THAT(refusal(space, {.size = 1e-4}), HasSubstr("hexahedra"));
  // The area is that of the ring, 62.8 mm^2, not of the box around it.
  const fs::path ring = put("ring.geo", R"(
SetFactory("OpenCASCADE");
Disk(1) = {0, 0, 0, 100}; Disk(2) = {0, 0, 0, 99.9};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
)");
  EXPECT_THAT(refusal(ring, {.size = 1e-5}), HasSubstr("about 6.3e+11 quad"));
  // Sizes do not change a structured mesh.
  const fs::path structured =
      put("structured.geo", std::string(block) +
                                "Transfinite Curve {1, 3} = 9; Transfinite Curve {2, 4} = 5;\n"
                                "Transfinite Surface {1}; Recombine Surface {1};\n");
  EXPECT_EQ(check_mesh<2>(read_mesh_file(structured, {.size = 1e-6})).mesh.cells.size(), 32u);
}

TEST_F(MeshFile, MembersOfGroupsThatTheGeometryDoesNotHaveAreTold) {
  const fs::path file =
      put("block.geo", std::string(block) +
                           "Physical Curve(\"side\", 7) = {2, -4, 17,\n 18};\n"
                           "// Physical Curve(\"no group\") = {19};\n"
                           "/* Physical Curve(\"none\") = {20}; */ n = 2;\n"
                           "Physical Surface(8) = {5}; Physical Point(\"other\") = {n, 3};\n");
  std::vector<std::string> told;
  for (const std::string& remark : read_mesh_file(file).remarks)
    if (remark.find("does not have") != remark.npos) told.push_back(remark);
  EXPECT_THAT(told,
              ElementsAre("group \"side\" names curve 17, 18, which the geometry does not have",
                          "group 8 names surface 5, which the geometry does not have"));
}

TEST_F(MeshFile, OfAGeometryIsTheSameEveryTime) {
  const fs::path file = put("block.geo", block);
  expect_same(check_mesh<2>(read_mesh_file(file)), check_mesh<2>(read_mesh_file(file)));
}

TEST_F(MeshFile, OfAStructuredGeometryIsNotRefined) {
  const fs::path file = put("structured.geo", R"(
    Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Line(1) = {1, 2}; Transfinite Curve{1} = 6;
    s[] = Extrude {0, 1, 0} {Line{1}; Layers{4}; Recombine;};
    v[] = Extrude {0, 0, 1} {Surface{s[1]}; Layers{3}; Recombine;};
    Physical Volume("body") = {v[1]}; Physical Surface("base") = {s[1]};
)");
  const ImportedBody<3> body = check_mesh<3>(read_mesh_file(file));
  EXPECT_EQ(body.mesh.cells.size(), 5u * 4 * 3);
  EXPECT_EQ(body.mesh.boundary.at("base").size(), 5u * 4);
  EXPECT_EQ(body.remarks, std::vector<std::string>());
}

/// A block with a groove about the axis y = 1, z = 2.5, radius 2.
const char* grooved = R"(
SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 2, 2, 1};
Cylinder(2) = {-1, 1, 2.5, 4, 0, 0, 2};
BooleanDifference(3) = {Volume{1}; Delete;} {Volume{2}; Delete;};
Save "part.step";
)";

TEST_F(MeshFile, OfAStepFileHasItsNodesOnTheTrueSurface) {
  run_script(grooved);
  // Of the section: the box up to the axis of the groove less what the circle covers of it.
  const double exact = 2 * (2 * 2.5 - std::sqrt(3) - 2 * std::numbers::pi / 3);
  double before = 1;
  for (double size : {0.2, 0.1}) {
    const ImportedBody<3> body =
        check_mesh<3>(read_mesh_file(folder_ / "part.step", {.size = size}));
    expect_sound(body.mesh);
    ASSERT_EQ(body.mesh.boundary.size(), 6u);
    EXPECT_THAT(body.remarks, ::testing::Contains(HasSubstr("Physical Surface")));
    int curved = 0;
    for (const auto& [name, facets] : body.mesh.boundary) {
      if (flat_part(body.mesh, facets).flat) continue;
      ++curved;
      for (int node : body.mesh.boundary_nodes(name)) {
        const Vector<3>& X = body.mesh.nodes[node];
        EXPECT_NEAR(std::hypot(X[1] - 1, X[2] - 2.5), 2, 1e-9);
      }
    }
    EXPECT_EQ(curved, 1);
    const double error = std::abs(volume(body.mesh) - exact);
    EXPECT_LT(error, before / 2);
    before = error;
  }
  EXPECT_LT(before, 2e-3);
}

TEST_F(MeshFile, OfFoldedCellsIsMadeAgainALittleFiner) {
  const fs::path file = put("foot.geo", R"(
SetFactory("OpenCASCADE");
Box(1) = {-4, -3, 2, 8, 6, 6}; Cylinder(2) = {0, 0, -1, 0, 0, 3.5, 3}; Sphere(3) = {0, 0, 10, 10};
BooleanIntersection(4) = { Volume{2}; Delete; }{ Volume{3}; Delete; };
BooleanUnion(5) = { Volume{1}; Delete; }{ Volume{4}; Delete; };
Mesh.MeshSizeFromCurvature = 24;
)");
  for (const double factor : {2.0, 2.2}) {
    EXPECT_EQ(refusal(file, {.size = 2, .factor = factor}), "accepted") << factor;
    EXPECT_THAT(read_mesh_file(file, {.size = 2, .factor = factor}).remarks,
                ::testing::Contains(HasSubstr("is folded")));
  }
}

TEST_F(MeshFile, WithoutNamedSurfacesNamesThemByTheirNumbers) {
  ImportedMesh mesh = square(2);
  mesh.groups.clear();
  const ImportedBody<2> body = check_mesh<2>(read_mesh_file(put("part.msh", msh22(mesh))));
  EXPECT_THAT(body.remarks, ElementsAre(HasSubstr("has no physical groups of curves")));
  EXPECT_EQ(body.mesh.boundary.at("curve1").size(), 8u);
}

TEST_F(MeshFile, RefusesWhatIsNoMesh) {
  EXPECT_EQ(refusal(folder_ / "none.msh"), "no such file");
  fs::create_directories(folder_ / "a.msh");
  EXPECT_THAT(refusal(folder_ / "a.msh"), HasSubstr("is a folder"));
  EXPECT_THAT(refusal(put("part.inp", "*NODE\n")), HasSubstr("meshio convert"));
  EXPECT_THAT(refusal(put("part.vtk", "#")), HasSubstr(".vtk are not read, expected .msh"));
  EXPECT_THAT(refusal(put("part", "x")), HasSubstr("has no ending"));
  EXPECT_EQ(refusal(put("empty.msh", "")), "is empty");
  EXPECT_EQ(refusal(put("empty.geo", " \n")), "is empty");
  EXPECT_THAT(refusal(put("line.geo", "Point(1) = {0, 0, 0};")), HasSubstr("end of its last line"));
  EXPECT_THAT(refusal(put("old.msh", "$NOD\n0\n$ENDNOD\n")), HasSubstr("begin with $MeshFormat"));
  EXPECT_THAT(refusal(put("new.msh", "$MeshFormat\n5.0 0 8\n$EndMeshFormat\n")),
              HasSubstr("format \"5.0\""));
  EXPECT_THAT(refusal(put("cut.msh", "$MeshFormat")), HasSubstr("is cut off"));
  EXPECT_THAT(refusal(put("bare.msh", "$MeshFormat\n$EndMeshFormat")), HasSubstr("format \"$End"));
}

TEST_F(MeshFile, RefusesDamagedMeshes) {
  const std::string sound = msh22(square(2));
  const auto damaged = [&](const std::string& from, const std::string& to) {
    std::string text = sound;
    text.replace(text.find(from), from.size(), to);
    return refusal(put("part.msh", text));
  };
  for (std::size_t tenths : {1, 3, 6, 9})
    EXPECT_THAT(refusal(put("part.msh", sound.substr(0, tenths * sound.size() / 10))),
                HasSubstr("is cut off"));
  EXPECT_THAT(damaged("$Nodes\n9", "$Nodes\n2000000000"), HasSubstr("Gmsh"));
  EXPECT_THAT(damaged("\n501 3 2 5 5 1 2 5 4", "\n501 3 2 5 5 1 2 5 400"),
              HasSubstr("Gmsh complains"));
  EXPECT_THAT(damaged("\n501 3 ", "\n501 333 "), HasSubstr("Gmsh complains"));
  EXPECT_THAT(damaged("\n5 0.5 0.5 0\n", "\n5 0.5 nan 0\n"), HasSubstr("expected finite"));
  EXPECT_THAT(refusal(put("part.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n")),
              HasSubstr("has no"));
}

TEST_F(MeshFile, RefusesSecondOrderWithTheOptionThatHelps) {
  run_script(std::string(block) + "Mesh.ElementOrder = 2; Mesh 2; Save \"part.msh\";");
  EXPECT_THAT(refusal(folder_ / "part.msh"), HasSubstr("order 2 (Triangle 6), expected the first "
                                                       "order; in Gmsh: Mesh.ElementOrder = 1"));
}

TEST_F(MeshFile, RefusesABodyThatGmshDidNotSave) {
  std::string script = block;
  script.erase(script.find("Physical Surface"),
               script.find("Physical Point") - script.find("Physical Surface"));
  run_script(script + "Mesh 2; Save \"part.msh\";");
  EXPECT_THAT(refusal(folder_ / "part.msh"), HasSubstr("has no cells, only points or curves"));
  // Meshed on the spot there is no such trap.
  EXPECT_EQ(refusal(put("block.geo", script)), "accepted");
}

TEST_F(MeshFile, RefusesGeometriesThatGmshCannotMesh) {
  EXPECT_THAT(refusal(put("a.geo", "Point(1) = {0, 0;\n")), HasSubstr("Gmsh complains: "));
  EXPECT_THAT(refusal(put("b.geo", "Point(1) = {0, 0, 0};\n")),
              HasSubstr("no surface and no volume"));
  EXPECT_THAT(refusal(put("c.geo", "Merge \"none.step\";\n")), HasSubstr("Gmsh complains: "));
  EXPECT_THAT(refusal(put("d.geo", "Exit;\n")), HasSubstr("ended before there was a mesh"));
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = block;
    return refusal(put("f.geo", text.replace(text.find(from), from.size(), to)));
  };
  EXPECT_THAT(changed("{1, 2, 3, 4}; Plane", "{1, 2, 3}; Plane"),
              HasSubstr("expected curves of a loop that end where the next begins"));
  EXPECT_THAT(changed("Line(2) = {2, 3}", "Line(2) = {3, 2}"),
              HasSubstr("-2 for curve 2 backwards"));
  EXPECT_THAT(changed("{4, 1, 0, 0.1}", "{4, 1, 0, -0.1}"), HasSubstr("expected positive sizes"));
  EXPECT_THAT(changed("Point(2) = {4, 0,", "Point(2) = {4, 3,"), HasSubstr("may cross itself"));
  EXPECT_THAT(refusal(put("e.step", "ISO-10303-21;\nHEADER;\n")), HasSubstr("Gmsh"));
}

TEST_F(MeshFile, SaysThatAFactorOrASizeChangesNothing) {
  const auto remarks = [&](const std::string& count, double factor, double size = 0) {
    const fs::path file = put(
        "square.geo",
        "Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {1, 1, 0}; Point(4) = {0, 1, 0};\n"
        "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};\n"
        "Curve Loop(1) = {1:4}; Plane Surface(1) = {1};\nTransfinite Curve{1:4} = " +
            count +
            ";\nTransfinite Surface{1};\nPhysical Curve(\"edge\") = {1:4};\nPhysical "
            "Surface(\"all\") = {1};\n");
    return read_mesh_file(file, {.size = size, .factor = factor}).remarks;
  };
  EXPECT_THAT(remarks("5", 1), ::testing::IsEmpty());
  EXPECT_THAT(remarks("5", 1 + 1e-15), ::testing::IsEmpty());
  EXPECT_THAT(remarks("5", 0.5), ElementsAre(HasSubstr("elements on no curve")));
  EXPECT_THAT(remarks("4 / Mesh.MeshSizeFactor + 1", 0.5), ::testing::IsEmpty());
  EXPECT_THAT(remarks("5", 1, 0.1),
              ElementsAre(HasSubstr("its size changes the number of elements on no curve")));
  const fs::path free = put("free.geo",
                            "Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {0, 1, 0};\n"
                            "Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 1};\n"
                            "Curve Loop(1) = {1:3}; Plane Surface(1) = {1};\n");
  for (const std::string& remark : read_mesh_file(free, {.size = 0.3}).remarks)
    EXPECT_THAT(remark, ::testing::Not(HasSubstr("on no curve")));
}

TEST_F(MeshFile, RefusesSizesThatMeanNothing) {
  const fs::path mesh = put("part.msh", msh22(square(2))), geometry = put("block.geo", block);
  EXPECT_THAT(refusal(mesh, {.size = 1}), HasSubstr("is meshed already, so it takes no size"));
  EXPECT_THAT(refusal(geometry, {.size = -1}), HasSubstr("size -1: expected a positive length"));
  EXPECT_THAT(refusal(geometry, {.size = std::nan("")}), HasSubstr("expected a positive length"));
  EXPECT_THAT(refusal(geometry, {.factor = 0}), HasSubstr("factor 0: expected a positive number"));
  EXPECT_THAT(refusal(put("m.geo", std::string(block) + "Mesh 2;\n"), {.factor = 2}),
              HasSubstr("commands that mesh"));
}

TEST_F(MeshFile, LeavesSignalsAndStreamsAlone) {
  struct sigaction before {
  }, after{};
  sigaction(SIGINT, nullptr, &before);
  ::testing::internal::CaptureStdout();
  ::testing::internal::CaptureStderr();
  refusal(put("a.geo", "Printf(\"seen\"); Error(\"wrong\");\n"));
  EXPECT_EQ(::testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  sigaction(SIGINT, nullptr, &after);
  EXPECT_EQ(before.sa_handler, after.sa_handler);
}

template <int dim>
void expect_comes_back(const ImportedBody<dim>& body, const fs::path& file) {
  const ImportedBody<dim> again = check_mesh<dim>(read_mesh_file(file));
  ASSERT_EQ(again.mesh.nodes.size(), body.mesh.nodes.size());
  const auto places = [](const ImportedBody<dim>& b, const auto& facets) {
    std::multiset<std::vector<double>> result;  // numbers of nodes may differ
    for (const auto& facet : facets) {
      std::vector<double> place;
      for (int node : facet)
        for (int i = 0; i < dim; ++i) place.push_back(b.mesh.nodes[node][i]);
      result.insert(place);
    }
    return result;
  };
  EXPECT_EQ(places(again, again.mesh.cells), places(body, body.mesh.cells));
  ASSERT_EQ(again.mesh.boundary.size(), body.mesh.boundary.size());
  for (const auto& [name, facets] : body.mesh.boundary)
    EXPECT_EQ(again.mesh.boundary.at(name).size(), facets.size()) << name;
  ASSERT_EQ(again.point_groups.size(), body.point_groups.size());
  EXPECT_EQ(again.cell_groups.size(), body.cell_groups.size());
}

/// Of this process.
std::vector<pid_t> children() {
  std::vector<pid_t> result;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::ifstream file(entry.path() / "stat");
    std::string stat;
    if (!std::getline(file, stat)) continue;
    std::istringstream fields(stat.substr(stat.rfind(')') + 1));
    char state = 0;
    pid_t parent = 0;
    if (fields >> state >> parent && parent == getpid())
      result.push_back(std::stoi(entry.path().filename().string()));
  }
  return result;
}

TEST_F(MeshFile, IsReadByOneProcessUntilThatEnds) {
  const fs::path script = put("block.geo", block);
  const std::size_t nodes = read_mesh_file(script).nodes.size();
  const std::vector<pid_t> first = children();
  ASSERT_EQ(first.size(), 1u);
  run_script("");  // ends a fork
  EXPECT_EQ(read_mesh_file(script).nodes.size(), nodes);
  EXPECT_EQ(children(), first);
  for (const int signal : {SIGINT, SIGTERM}) {
    kill(first.front(), signal);
    EXPECT_EQ(read_mesh_file(script).nodes.size(), nodes);
    EXPECT_EQ(children(), first);
  }
  kill(first.front(), SIGKILL);
  EXPECT_EQ(read_mesh_file(script).nodes.size(), nodes);
  ASSERT_EQ(children().size(), 1u);
  EXPECT_NE(children(), first);
  // Names are relative to where gnomon is.
  const fs::path before = fs::current_path();
  fs::current_path(folder_);
  EXPECT_EQ(read_mesh_file("block.geo").nodes.size(), nodes);
  fs::current_path(before);
  // A fork of gnomon has a process of its own.
  const pid_t fork_of_this = fork();
  if (fork_of_this == 0) _exit(read_mesh_file(script).nodes.size() == nodes ? 0 : 1);
  int status = 1;
  waitpid(fork_of_this, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(read_mesh_file(script).nodes.size(), nodes);
}

TEST_F(MeshFile, AWrittenMeshComesBackToTheLastDigit) {
  const ImportedBody<2> plane = check_mesh<2>(read_mesh_file(put(
      "p.geo",
      "SetFactory(\"OpenCASCADE\"); Disk(1) = {0.1, 0.2, 0, 1.3, 0.7}; Point(9) = {0.1, 0.2, 0};"
      "Physical Surface(\"all\") = {1}; Physical Curve(\"rim\") = {1}; Mesh.MeshSizeMax = "
      "0.3;\n")));
  expect_comes_back(plane, put("p.msh", gmsh_text(plane)));
  const ImportedBody<3> space = check_mesh<3>(read_mesh_file(put(
      "s.geo",
      "SetFactory(\"OpenCASCADE\"); Box(1) = {0, 0, 0, 1, 1.1, 0.7}; Physical Volume(\"all\") = "
      "{1}; Physical Surface(\"one\") = {1}; Physical Surface(\"both\") = {1, 2}; "
      "Physical Point(\"tip\") = {1}; Mesh.MeshSizeMax = 0.5;\n")));
  ASSERT_EQ(space.point_groups.size(), 1u);
  expect_comes_back(space, put("s.msh", gmsh_text(space)));
}

}  // namespace
}  // namespace gnomon::mesh_file_test
