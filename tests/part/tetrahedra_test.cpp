// Parts of tetrahedra, subdivided into hexahedra: pressures, and holes in a wearing surface.

#include "part/part_scene.hpp"

namespace gnomon::tetrahedra_test {
namespace {

using namespace testing;

class Tetrahedra : public ::testing::Test {
protected:
  void SetUp() override {
    if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
  }
};

/// A block of 2 mm x 2 mm x 1 mm, in the upper side of which there may be a hole.
constexpr const char* block = R"(
SetFactory("OpenCASCADE");
Box(1) = {0, 0, -1, 2, 2, 1};
If (hole)
  Cylinder(2) = {1, 1, -0.6, 0, 0, 1, 0.4};
  BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }
EndIf
e = 1e-3;
x[] = Surface In BoundingBox {-e, -e, -1 - e, e, 2 + e, e};
y[] = Surface In BoundingBox {-e, -e, -1 - e, 2 + e, e, e};
base[] = Surface In BoundingBox {-e, -e, -1 - e, 2 + e, 2 + e, -1 + e};
top[] = Surface In BoundingBox {-e, -e, -e, 2 + e, 2 + e, e};
sides[] = Boundary{ Volume{:}; };
sides[] -= {x[], y[], base[], top[]};
Physical Surface("x") = {x[]};
Physical Surface("y") = {y[]};
Physical Surface("base") = {base[]};
Physical Surface("surface") = {top[]};
Physical Surface("sides") = {sides[]};
all[] = Volume{:};
Physical Volume("block") = {all[]};
Mesh.MeshSizeMax = 0.4;
)";

/// A flat, pressed on the block with 8 N, slides over it.
constexpr const char* scene = R"(
problem = "worn_body"
mesh.file = "block.geo"
body = { young_modulus = 1000.0, poisson_ratio = 0.3 }
support = [{ on = "base", directions = ["z"] }, { on = "x", directions = ["x"] },
           { on = "y", directions = ["y"] }]
wear = { on = ["surface"], coefficient = 1e-6, rate = "k * p * v" }
time.end = 1000.0
integrator.name = "backward-euler"
[counter_body]
shape = "plane"
normal = [0.0, 0.0, -1.0]
motion = { velocity = [50.0, 0.0, 0.0] }
press = { direction = [0.0, 0.0, -1.0], force = 8.0 }
)";

std::unique_ptr<Model> block_with(const std::string& hole) {
  const SceneFolder folder;
  folder.write("block.geo", "hole = " + hole + ";\n" + block);
  return make_model(load_scene(folder.write("block.toml", scene), {}, key_table));
}

// The quadrilaterals of a subdivided triangle are no parallelograms, and their nodes have unequal
// parts of them: a pressure must not show that.
TEST_F(Tetrahedra, PressedByAFlatHaveOnePressure) {
  const auto model = block_with("0");
  Counters counters;
  const ContactSurface surface = model->contact(model->start(counters)).value();
  ASSERT_GT(surface.node.size(), 50u);
  for (const double p : surface.pressure) EXPECT_NEAR(p, 2, 1e-6);
}

// The wall of a hole is curved, but along its axis the edge of the wearing surface moves.
TEST_F(Tetrahedra, WearAtTheEdgeOfAHoleAsElsewhere) {
  const auto model = block_with("1");
  const ModelRun run = run_model(*model, "backward-euler", 250, 1e-4, 1000);
  const double worn = 1e-6 * 8 * 50 * 1000;  // k F v t
  EXPECT_NEAR(observed(*model, run.last(), "worn_volume") / worn, 1, 1e-3);
  const ContactSurface surface = model->contact(run.last()).value();
  const auto [least, most] = std::ranges::minmax(surface.wear_depth);
  EXPECT_NEAR(least / most, 1, 0.05);
}

}  // namespace
}  // namespace gnomon::tetrahedra_test
