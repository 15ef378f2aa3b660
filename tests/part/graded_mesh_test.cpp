// Meshes that are fine where the bodies are expected to touch.

#include "part/graded_mesh.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "part/part_scene.hpp"

namespace gnomon::graded_mesh_test {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

constexpr const char* block = R"(SetFactory("OpenCASCADE");
Rectangle(1) = {-10, -10, 0, 20, 10};
Physical Surface("block") = {1};
b() = Boundary { Surface{1}; };
Physical Curve("bottom") = {b(0)}; Physical Curve("face") = {b(2)};
)";

constexpr const char* roller_on_block = R"(
problem = "worn_body"
mesh = { file = "block.geo", size = 2.0, contact_size = 0.1 }
model.plane = "strain"
body = { young_modulus = 105e3, poisson_ratio = 0.3 }
support = [ { on = "bottom" } ]
[counter_body]
shape = "cylinder"
radius = 20.0
center = [3.0, 20.0]
motion = { velocity = [500.0, 0.0] }
press = { direction = [0.0, -1.0], force = 50.0 }
[wear]
on = ["face"]
coefficient = 2e-9
[time]
end = 2000.0
)";

/// Edges of the contact surface, by their middle.
std::map<double, double> edges_of(const Model& model) {
  Counters counters;
  const ContactSurface surface = model.contact(model.start(counters)).value();
  std::vector<double> x;
  for (const auto& place : surface.initial) x.push_back(place[0]);
  std::ranges::sort(x);
  std::map<double, double> edges;
  for (std::size_t k = 1; k < x.size(); ++k) edges[(x[k] + x[k - 1]) / 2] = x[k] - x[k - 1];
  return edges;
}

class GradedMesh : public PartScenes {};

// The worn segment of the circle has the area k P v t.
TEST_F(GradedMesh, IsFineWhereTheRollerWears) {
  folder_.write("block.geo", block);
  const auto model = this->model(roller_on_block);
  const double a = std::cbrt(1.5 * 20 * 0.1);
  for (const auto& [x, edge] : edges_of(*model)) {
    if (std::abs(x - 3) < a) {
      EXPECT_NEAR(edge, 0.1, 0.02) << x;
    }
    if (std::abs(x - 3) > 5) {
      EXPECT_GT(edge, 0.5) << x;
    }
  }
  EXPECT_THAT(model->remarks, Contains(AllOf(HasSubstr("where the bodies are expected to touch"),
                                             HasSubstr("edges are about 0.09"))));
  const ModelRun run = run_model(*model, "esdirk-3", 0, 1e-3, 2000);
  EXPECT_NEAR(observed(*model, run.last(), "contact_half_width") / a, 1, 0.01);
}

// The zone of fine elements reaches out of a body whose whole face wears.
TEST_F(GradedMesh, TellsNoContactThatIsWiderThanTheBody) {
  folder_.write("block.geo", block);
  EXPECT_THAT(this->model(roller_on_block, {"time.end=2e7", "mesh.contact_size=1"})->remarks,
              Contains(HasSubstr("expected to touch, over 20 mm")));
}

TEST_F(GradedMesh, HasTheFactorOfAllEdges) {
  folder_.write("block.geo", block);
  const auto edges = edges_of(*this->model(roller_on_block, {"mesh.factor=0.5"}));
  EXPECT_NEAR(edges.lower_bound(3)->second, 0.05, 0.01);
}

// The mesh of each body is in the coordinates of its file.
TEST_F(GradedMesh, OfTwoBodiesIsFineOnBoth) {
  folder_.write("block.geo", block);
  folder_.write("cap.geo", R"(SetFactory("OpenCASCADE");
Disk(1) = {0, 6, 0, 6}; Rectangle(2) = {-6.5, 0, 0, 13, 4};
BooleanIntersection(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Physical Surface("cap") = {3};
b() = Boundary { Surface{3}; };
Physical Curve("top") = {b(0)}; Physical Curve("round") = {b(1), b(2)};
)");
  const auto model = this->model(R"(
problem = "worn_body"
mesh = { size = 1.5, contact_size = 0.1 }
model.plane = "strain"
body = [ { name = "flat", mesh = "block.geo", young_modulus = 2e5, poisson_ratio = 0.3 },
         { name = "cap", mesh = "cap.geo", shift = [3.0, 0.0], young_modulus = 2e5, poisson_ratio = 0.3 } ]
pair = [ { bodies = ["cap", "flat"] } ]
motion = [ { body = "cap", velocity = [0.0, 0.0, 100.0] } ]
support = [ { on = "bottom" }, { on = "top", directions = ["x"] } ]
load = [ { on = "top", force = [0.0, -185.0] } ]
[wear]
on = ["face"]
coefficient = 1e-8
[time]
end = 2000.0
)");
  std::map<double, int> near;  // contact nodes of both bodies, by their height
  Counters counters;
  const ContactSurface surface = model->contact(model->start(counters)).value();
  for (const auto& place : surface.initial)
    if (std::abs(place[0] - 3) < 1) ++near[place[1] == 0 ? 0 : 1];
  EXPECT_NEAR(near[0], 20, 4);
  EXPECT_NEAR(near[1], 20, 4);
}

TEST_F(GradedMesh, SaysWhereTheGeometryGivesTheNumberOfElements) {
  std::string transfinite = block;
  transfinite +=
      "Transfinite Curve {b(0), b(2)} = 21; Transfinite Curve {b(1), b(3)} = 11;\n"
      "Transfinite Surface {1};\n";
  folder_.write("block.geo", transfinite);
  EXPECT_THAT(this->model(roller_on_block)->remarks,
              Contains(HasSubstr("asks for 0.1, but the geometry gives their number")));
}

TEST_F(GradedMesh, MistakesAreRefused) {
  folder_.write("block.geo", block);
  EXPECT_THAT(refusal(roller_on_block, {"mesh.contact_size=1e-5"}),
              HasSubstr("mesh.contact_size: expected a size that is not so small"));
  EXPECT_THAT(refusal(roller_on_block, {"mesh.contact_size=0"}), HasSubstr("mesh.contact_size"));
  std::string meshed = roller_on_block;
  meshed.replace(meshed.find("block.geo\", size = 2.0"), 22, "block.msh\"");
  EXPECT_THAT(refusal(meshed), HasSubstr("expected a geometry (.geo, .step or .stp)"));
}

Scene scaled(const Scene& scene, double factor) {
  const std::vector<Key> keys = scene.controlling_keys();
  return *std::ranges::find(keys, "mesh.factor", &Key::name)->controls->scaled(scene, factor);
}

// A plan for an accuracy begins with a twentieth of the contact.
// Of a size that a plan has chosen: the contact is divided, and the rest by the square root.
TEST_F(GradedMesh, IsScaledAwayFromTheContactByTheSquareRoot) {
  folder_.write("block.geo", "");
  folder_.write("roller.toml", roller_on_block);
  const Scene given = load_scene(folder_.path() / "roller.toml", {}, key_table);
  const Scene chosen = given.without("mesh.contact_size").with("mesh.contact_size", 0.1);
  const auto quarter = [](const Scene& scene) { return scaled(scene, 0.25); };
  EXPECT_EQ(quarter(given).real("mesh.factor"), 0.25);
  EXPECT_EQ(quarter(given).real("mesh.contact_size"), 0.1);
  EXPECT_EQ(quarter(chosen).real("mesh.factor"), 0.5);
  EXPECT_EQ(quarter(chosen).real("mesh.contact_size"), 0.05);
}

// Whatever sizes the geometry has itself, and from whatever scene it is scaled.
TEST_F(GradedMesh, IsScaledWhereTheGeometryIsFineItself) {
  folder_.write("block.geo", R"(
Point(1) = {-10, -10, 0, 2}; Point(2) = {10, -10, 0, 2}; Point(3) = {10, 0, 0, 2};
Point(4) = {7, 0, 0, 0.1}; Point(5) = {-1, 0, 0, 0.1}; Point(6) = {-10, 0, 0, 2};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6}; Plane Surface(1) = {1};
Physical Surface("block") = {1};
Physical Curve("bottom") = {1}; Physical Curve("face") = {3, 4, 5};
)");
  folder_.write("roller.toml", roller_on_block);
  const Scene chosen = load_scene(folder_.path() / "roller.toml", {}, key_table)
                           .without("mesh.contact_size")
                           .with("mesh.contact_size", 0.1);
  const auto edge = [](const Scene& scene) {  // in the mean of those near x = 3
    double sum = 0;
    int count = 0;
    for (const auto& [x, length] : edges_of(*make_model(scene)))
      if (std::abs(x - 3) < 1) sum += length, ++count;
    return sum / count;
  };
  for (const double factor : {4.0, 2.0, 0.5})
    EXPECT_NEAR(edge(scaled(chosen, factor)), factor * 0.1, 0.15 * factor * 0.1);
  EXPECT_NEAR(edge(scaled(scaled(chosen, 4), 0.125)), 0.05, 0.005);
  EXPECT_NEAR(edge(scaled(scaled(chosen, 0.5), 4)), 0.2, 0.02);
}

TEST_F(GradedMesh, IsChosenForAStepFile) {
  const Scene bushing = load_scene(shipped("bushing.toml"), {}, key_table);
  EXPECT_FALSE(
      part::with_contact_size(load_scene(shipped("bushing.toml"), {"mesh.factor=1"}, key_table)))
      << "it gives a factor";
  const std::optional<Scene> chosen =
      part::with_contact_size(bushing.without("mesh.size").without("mesh.factor"));
  ASSERT_TRUE(chosen);
  EXPECT_NEAR(chosen->real("mesh.contact_size"), 1, 0.5);
}

// The fourth entry of a point would be its size; those of groups are points.
TEST_F(GradedMesh, IsChosenForAScript) {
  const std::string of_points = R"(h = 10;
Point(1) = {-10, -10, 0}; Point(2) = {h * Cos(0), -h, 0}; Point(3) = {Max(h, 2), 0, 0};
Point(4) = {-10, 0, 0 /* , 0.1 */};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Surface("block") = {1}; Physical Curve("bottom") = {1}; Physical Curve("face") = {3};
Physical Point("corners") = {1, 2, 3, 4};
)";
  const auto chosen = [&](const std::string& script) {
    folder_.write("block.geo", script);
    folder_.write("roller.toml", roller_on_block);
    return part::with_contact_size(load_scene(folder_.path() / "roller.toml", {}, key_table)
                                       .without("mesh.size")
                                       .without("mesh.contact_size"));
  };
  const std::optional<Scene> free = chosen(of_points);
  ASSERT_TRUE(free);
  EXPECT_NEAR(free->real("mesh.contact_size"), 2 * std::cbrt(1.5 * 20 * 0.1) / 20, 0.1);
  const std::optional<Scene> finer =
      chosen(of_points + "MeshSize {:} = 2; MeshSize {3, 4} = 0.1;\n");
  ASSERT_TRUE(finer);
  EXPECT_NEAR(finer->real("mesh.contact_size"), 0.1, 0.02) << "that of the script is smaller";
  EXPECT_FALSE(chosen(of_points + "Transfinite Curve {3} = 21;\n")) << "it fixes their number";
}

}  // namespace
}  // namespace gnomon::graded_mesh_test
