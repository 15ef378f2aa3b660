// The shipped scenes in space against the data of the paper's secs. 4.2 and 4.3.

#include <gnomon/mesh/quarter_ball.hpp>

#include "ball/coarse.hpp"

namespace gnomon::paper_data_test {
namespace {

using namespace testing;

struct PaperData {
  const char* scene;
  double young_modulus, poisson_ratio, force;  // MPa, -, N
  double coefficient;                          // K [1/MPa]
  double cycle;                                // L [mm]; 0: the ball on the flat
  double elements, nearly;                     // number, and allowed difference of the mesh
};

double elements_of(const Scene& scene, bool groove) {
  const std::vector<long>& n = scene.integers("mesh.elements");
  if (groove) return double(n[0] * n[1] * n[2]);
  QuarterBall ball;
  ball.across = int(n[0]), ball.height = int(n[1]), ball.layers = int(n[2]);
  return ball.elements();
}

class PaperScene : public ::testing::TestWithParam<PaperData> {};

TEST_P(PaperScene, HasThePapersData) {
  const PaperData& paper = GetParam();
  const Scene scene =
      load_scene(std::string(GNOMON_SOURCE_DIR "/problems/") + paper.scene, {}, key_table);
  EXPECT_EQ(scene.real("ball.radius"), 5);
  EXPECT_EQ(scene.real("body.young_modulus"), paper.young_modulus);
  EXPECT_EQ(scene.real("body.poisson_ratio"), paper.poisson_ratio);
  EXPECT_EQ(scene.real("load.force"), paper.force);
  EXPECT_EQ(scene.real("friction.coefficient"), 0.5);
  EXPECT_EQ(scene.real("wear.coefficient"), paper.coefficient);
  EXPECT_EQ(scene.real("wear.velocity"), 1000);
  EXPECT_EQ(scene.real("time.end"), 1000);
  if (paper.cycle > 0) {
    EXPECT_EQ(scene.real("path.length"), paper.cycle);
  }
  EXPECT_NEAR(elements_of(scene, paper.cycle > 0), paper.elements, paper.nearly);
}

INSTANTIATE_TEST_SUITE_P(
    , PaperScene,
    ::testing::Values(PaperData{ball_small, 1e5, 0.3, 100, 1e-7, 0, 16384, 200},
                      PaperData{ball_finite, 10, 0.45, 25, 4e-7, 0, 16384, 200},
                      PaperData{groove_small, 1e5, 0.3, 100, 4e-7, 70, 65600, 0},
                      PaperData{groove_finite, 10, 0.45, 50, 2e-7, 100, 43200, 0}));

}  // namespace
}  // namespace gnomon::paper_data_test
