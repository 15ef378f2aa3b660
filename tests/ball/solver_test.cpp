// Both linear solvers on the balls: friction, the rigid motion, the shape of a cross-section.

#include <gnomon/linear/inner_solver.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/model/wear_scene.hpp>

#include "ball/coarse.hpp"

namespace gnomon::solver_test {
namespace {

using namespace testing;

void check(const std::string& scene, const Overrides& mesh, double end) {
  SCOPED_TRACE(scene);
  const auto direct = model_of(scene, mesh + Overrides{"solver.method=direct"});
  const ModelRun a = run_model(*direct, "backward-euler", end / 4, 1e-2, end);
  EXPECT_EQ(a.counters.krylov_iterations, 0);
  const Structure& structure = direct->system().structure();
  for (const std::string inside : {"factor", "multigrid"}) {
    if (inside == "multigrid" && !has_multigrid()) continue;
    SCOPED_TRACE(inside);
    const auto block =
        model_of(scene, mesh + Overrides{"solver.method=block", "solver.preconditioner=" + inside});
    const ModelRun b = run_model(*block, "backward-euler", end / 4, 1e-2, end);
    EXPECT_GT(b.counters.krylov_iterations, 0);
    EXPECT_LT(b.counters.krylov_iterations, 20 * b.counters.linear_solves);
    for (long i = 0; i < structure.size; ++i)
      ASSERT_NEAR(a.last().y[i], b.last().y[i], 1e-6 * structure.unknown_scale[i]) << i;
  }
}

/// Where steps follow the error, solvers may choose them apart by rounding.
void check_with_error_control(const std::string& scene, const Overrides& mesh) {
  SCOPED_TRACE(scene);
  for (const char* integrator : {"esdirk-3", "bdf"}) {
    const auto direct = model_of(scene, mesh + Overrides{"solver.method=direct"});
    const auto block = model_of(scene, mesh + Overrides{"solver.method=block"});
    const ModelRun a = run_model(*direct, integrator, 0, 1e-2, 200);
    const ModelRun b = run_model(*block, integrator, 0, 1e-2, 200);
    EXPECT_GT(b.counters.krylov_iterations, 0);
    const auto& differential = direct->system().structure().differential;
    for (std::size_t i = 0; i < differential.size(); ++i)
      if (differential[i]) {
        ASSERT_NEAR(a.last().y[i], b.last().y[i], 1e-3 * direct->differential_scale)
            << integrator << " " << i;
      }
  }
}

TEST(Ball, BlockAndDirectSolversAgreeUnderErrorControl) {
  check_with_error_control(ball_finite, ball_mesh(4, 2, 1));
}

TEST(Groove, BlockAndDirectSolversAgreeUnderErrorControl) {
  check_with_error_control(groove_small, block_mesh(6, 10, 4, 0.08));
}

TEST(Ball, BlockAndDirectSolversAgree) {
  check(ball_small, ball_mesh(4, 2, 1), 200);
  check(ball_finite, ball_mesh(4, 2, 1), 200);
}

TEST(Groove, BlockAndDirectSolversAgree) {
  check(groove_small, block_mesh(6, 10, 4, 0.08), 100);
  check(groove_finite, block_mesh(6, 8, 4, 0.8), 200);
}

// Nodes that share a surface have a rank-one term for their common wear: here there is none.
TEST(Groove, BlockSolverBearsThatNothingWears) {
  check(groove_small, block_mesh(6, 10, 4, 0.08) + Overrides{"friction.coefficient=0"}, 100);
}

Scene scene_of(const std::string& scene, const Overrides& overrides) {
  return load_scene(std::string(GNOMON_SOURCE_DIR "/problems/") + scene, overrides, key_table);
}

std::string chosen(const Scene& scene, const MeshSize& mesh) {
  return linear_solver_kind(scene).make(scene, mesh).keys.at("solver.preconditioner");
}

std::string chosen_for(double nodes, bool grid_lines, const Overrides& overrides) {
  return chosen(scene_of(groove_small, overrides),
                {.dim = 3, .nodes = nodes, .grid_lines = grid_lines});
}

const std::string factor = "factor", multigrid = "multigrid",
                  multigrid_if_built = has_multigrid() ? multigrid : factor;

TEST(Solver, LargeBodiesAskForMultigridUnlessToldOtherwise) {
  EXPECT_EQ(chosen_for(99'999, false, {}), factor);
  EXPECT_EQ(chosen_for(100'000, false, {}), multigrid_if_built);
  EXPECT_EQ(chosen_for(100'000, false, {"solver.preconditioner=factor"}), factor);
  EXPECT_EQ(chosen_for(10, false, {"solver.preconditioner=multigrid"}), multigrid);
}

TEST(Solver, AlongGridLinesSmallerBodiesAskForMultigrid) {
  EXPECT_EQ(chosen_for(32 * 32 * 32, true, {}), factor);              // 98,304 displacements
  EXPECT_EQ(chosen_for(32 * 32 * 33, true, {}), multigrid_if_built);  // 101,376
}

// The estimate of the memory needs the choice before there is a mesh.
TEST(Solver, IsChosenByTheKeysAsByTheMesh) {
  const auto by_keys = [](const std::string& scene, const Overrides& overrides) {
    const Scene keys = scene_of(scene, overrides);
    return chosen(keys, Problems::find(keys.text("problem"), "").mesh_size(keys));
  };
  EXPECT_EQ(by_keys(groove_small, {"mesh.elements=[30, 31, 31]"}), factor);
  EXPECT_EQ(by_keys(groove_small, {"mesh.elements=[32, 31, 31]"}), multigrid_if_built);
  EXPECT_EQ(by_keys(ball_small, {}), factor);
  EXPECT_EQ(by_keys(ball_small, {"mesh.elements=[27, 9, 12]"}), multigrid_if_built);
  EXPECT_EQ(by_keys("pin_on_flat/small_deformation.toml", {"mesh.elements=[400, 400]"}), factor);
}

}  // namespace
}  // namespace gnomon::solver_test
