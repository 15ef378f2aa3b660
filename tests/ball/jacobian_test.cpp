// The coupled Jacobian in three dimensions: friction, streaming, the rigid motion, the shape of a
// cross-section.

#include <gnomon/model/wear_model.hpp>
#include <random>

#include "ball/coarse.hpp"

namespace gnomon {
namespace {

using namespace testing;

/// A rough state with closed and open contact nodes in turn; lengths of the order of `size`.
std::vector<double> rough_state(const Model& model, double size) {
  const auto& wear = dynamic_cast<const WearModel<3>&>(model);
  const Structure& structure = wear.system().structure();
  std::mt19937 generator(7);
  std::uniform_real_distribution<double> uniform(-size, size);
  std::vector<double> y(structure.size);
  for (double& value : y) value = uniform(generator);
  const double stress = 30 * wear.body().contact.rho * size;
  const auto& lambda = wear.system().numbering().numbers(wear.equations().fields().lambda);
  for (Eigen::Index c = 0; c < lambda.size(); ++c) y[lambda(c)] = c % 2 ? -4 * stress : stress;
  return y;
}

void check(const std::string& scene, const Overrides& overrides, double size) {
  SCOPED_TRACE(scene);
  const auto model = model_of(scene, overrides);
  const System& system = model->system();
  const std::vector<double> y = rough_state(*model, size);
  ActiveSet active = active_set(system, 0, y);
  const auto closed = std::count(active.begin(), active.end(), 1);
  ASSERT_GT(closed, 0);
  ASSERT_LT(closed, static_cast<long>(active.size()));
  // Rows of the stiff body lose digits to its size.
  check_jacobian(system, 0, y, 0.2, nullptr, 1e-4);
  for (const AlgebraicStage& stage : system.algebraic_stages()) {
    stage.freeze(0, y);
    std::vector<double> part;
    for (int unknown : stage.unknowns) part.push_back(y[unknown]);
    check_jacobian(*stage.system, 0, part, 0, nullptr, 1e-4);
  }
}

TEST(Ball, JacobianEqualsCentralDifferences) {
  check(ball_finite, ball_mesh(2, 1, 1) + Overrides{"contact.radius=2"}, 0.01);
}

TEST(Groove, JacobianEqualsCentralDifferences) {
  check(groove_finite, block_mesh(2, 3, 2, 1), 0.01);
}

}  // namespace
}  // namespace gnomon
