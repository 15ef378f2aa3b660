// The coupled Jacobian in three dimensions: friction, streaming, the rigid motion, the shape of a
// cross-section.

#include "ball/coarse.hpp"
#include "support/rough_state.hpp"

namespace gnomon::jacobian_test {
namespace {

using namespace testing;

/// A rough state with closed and open contact nodes in turn; lengths of the order of `size`.
std::vector<double> rough_state(const Model& model, double size) {
  const auto& wear = dynamic_cast<const WearModel<3>&>(model);
  const double stress = 30 * wear.assembly().interface.rho * size;
  return testing::rough_state(wear, {.size = size, .closed = -4 * stress, .open = stress});
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

/// Jacobians of a coarse ball at a rough state, and a part of them that is kept.
class SlowPartOfTheBall : public ::testing::Test {
protected:
  const std::unique_ptr<Model> model =
      model_of(ball_finite, ball_mesh(2, 1, 1) + Overrides{"contact.radius=2"});
  const System& system = model->system();
  const Structure& structure = system.structure();
  const std::vector<double> y = rough_state(*model, 0.01);
  const std::vector<double> rest = std::vector<double>(structure.size);
  SlowPart slow;
  std::vector<double> J = jacobian(y, 0.2, nullptr, &slow);

  std::vector<double> jacobian(const std::vector<double>& at, double alpha,
                               const ActiveSet* branch = nullptr, SlowPart* kept = nullptr) const {
    std::vector<double> values(structure.pattern.nonzeros());
    system.jacobian({.y = at, .ydot = rest, .branch = branch, .slow = kept}, alpha, values);
    return values;
  }
};

TEST_F(SlowPartOfTheBall, LeavesBranchAndWeightOfTheRatesExact) {
  EXPECT_TRUE(slow.known);
  EXPECT_EQ(J, jacobian(y, 0.2));
  ActiveSet other = active_set(system, 0, y);
  for (char& closed : other) closed = !closed;
  system.jacobian({.y = y, .ydot = rest, .branch = &other, .slow = &slow}, 0.7, J);
  EXPECT_EQ(J, jacobian(y, 0.7, &other));
}

TEST_F(SlowPartOfTheBall, IsThatOfTheOldPointAndNothingElseIs) {
  const std::vector<double> old = J;
  std::vector<double> near = y;
  for (double& value : near) value *= 1.01;
  system.jacobian({.y = near, .ydot = rest, .slow = &slow}, 0.2, J);
  const std::vector<double> exact = jacobian(near, 0.2);
  long kept = 0, moved = 0;
  for (int j = 0; j < structure.pattern.size(); ++j)
    for (int k = structure.pattern.column_start[j]; k < structure.pattern.column_start[j + 1]; ++k)
      if (const Role row = structure.block_of(structure.pattern.row_index[k]).role;
          row == Role::extension) {
        EXPECT_EQ(J[k], old[k]);
        kept += exact[k] != old[k];
      } else if (row != Role::stiffness) {
        EXPECT_EQ(J[k], exact[k]);
        moved += exact[k] != old[k];
      }
  EXPECT_GT(kept, 0);
  EXPECT_GT(moved, 0);
}

TEST_F(SlowPartOfTheBall, IsMadeAnewWhereStrainsHaveChanged) {
  std::vector<double> stretched = y;
  for (std::size_t i = 0; i < y.size(); ++i)
    if (structure.block_of(i).role == Role::stiffness)
      stretched[i] += 0.2 * structure.position[structure.group[i]][structure.component[i]];
  system.jacobian({.y = stretched, .ydot = rest, .slow = &slow}, 0.2, J);
  EXPECT_EQ(J, jacobian(stretched, 0.2));
}

}  // namespace
}  // namespace gnomon::jacobian_test
