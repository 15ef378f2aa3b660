// The paper's balls as parts: on the nodes of the built-in problems their results again.

#include <gnomon/mesh/quarter_ball.hpp>
#include <map>

#include "part/part_scene.hpp"
#include "support/msh_file.hpp"

namespace gnomon::paper_balls_test {
namespace {

using namespace testing;

class PaperBalls : public ::testing::Test {
protected:
  void SetUp() override {
    if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
  }
};

struct Data {
  const char* built_in;
  Overrides values;  ///< of the shipped part, which is that of small deformations
};

const Data small{"ball_on_flat/small_deformation.toml", {}};
const Data finite{"ball_on_flat/finite_deformation.toml",
                  {"body.young_modulus=10.0", "body.poisson_ratio=0.45", "wear.coefficient=4e-7",
                   "counter_body.press.force=12.5"}};

/// The shipped part, on another mesh. All of its sides but the symmetry plane keep their shape.
std::unique_ptr<Model> part_of(const Data& data, const Mesh<3>& mesh) {
  const SceneFolder folder;
  folder.write("ball.msh", msh41(mesh));
  std::string text = text_of(shipped("ball.toml"));
  const std::string geometry = "file = \"ball.geo\"";
  text.replace(text.find(geometry), geometry.size(), "file = \"ball.msh\"");
  return make_model(load_scene(folder.write("ball.toml", text), data.values, key_table));
}

/// Contact nodes by where they are at first.
std::map<std::array<double, 3>, std::size_t> by_place(const ContactSurface& surface) {
  std::map<std::array<double, 3>, std::size_t> places;
  for (std::size_t c = 0; c < surface.node.size(); ++c) places[surface.initial[c]] = c;
  return places;
}

void expect_the_same(const Data& data, double step) {
  const Mesh<3> mesh = quarter_ball({.radius = 5,
                                     .patch_half_width = 2.5,
                                     .contact_radius = 3,
                                     .across = 5,
                                     .height = 2,
                                     .layers = 3});
  const auto part = part_of(data, mesh);
  const auto ball = model_of(data.built_in, {"mesh.elements=[5, 2, 3]", "shape.reach=100.0"});
  const ModelRun expected = run_model(*ball, "backward-euler", step, 1e-4, 300),
                 actual = run_model(*part, "backward-euler", step, 1e-4, 300);
  const ContactSurface built_in = ball->contact(expected.last()).value(),
                       from_file = part->contact(actual.last()).value();
  const auto places = by_place(from_file);
  ASSERT_EQ(places.size(), built_in.node.size());
  EXPECT_GT(observed(*ball, expected.last(), "worn_volume"), 1);
  const double peak = std::ranges::max(built_in.pressure);
  for (std::size_t c = 0; c < built_in.node.size(); ++c) {
    ASSERT_TRUE(places.contains(built_in.initial[c]));
    const std::size_t k = places.at(built_in.initial[c]);
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(from_file.worn[k][i], built_in.worn[c][i], 1e-9) << "node " << c;
    EXPECT_NEAR(from_file.pressure[k], built_in.pressure[c], 1e-9 * peak) << "node " << c;
  }
}

TEST_F(PaperBalls, OnTheSameNodesTheBallAtSmallDeformationsIsTheBuiltInOne) {
  expect_the_same(small, 50);
}

TEST_F(PaperBalls, OnTheSameNodesTheBallAtFiniteDeformationsIsTheBuiltInOne) {
  expect_the_same(finite, 100);
}

}  // namespace
}  // namespace gnomon::paper_balls_test
