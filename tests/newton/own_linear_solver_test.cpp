// A user's linear solver in one file and without other changes: a scene chooses it by
// solver.method, with a key that the registration adds.

#include <gmock/gmock.h>

#include <Eigen/LU>
#include <gnomon/base/error.hpp>
#include <gnomon/newton/linear_solver_kind.hpp>

#include "support/pin.hpp"

namespace gnomon::own_linear_solver_test {
namespace {

using namespace testing;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// Dense LU of the Jacobian, whose rows are divided by their scales.
class DenseSolver : public LinearSolver {
public:
  DenseSolver(const Structure& structure, Counters& counters)
      : structure_(structure), counters_(counters) {}

  void set_up(std::span<const double> J) override {
    Eigen::MatrixXd scaled = Eigen::MatrixXd::Zero(structure_.size, structure_.size);
    const SparsePattern& pattern = structure_.pattern;
    for (int j = 0; j < pattern.size(); ++j)
      for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k) {
        const int i = pattern.row_index[k];
        scaled(i, j) = J[k] / structure_.row_scale[i];
      }
    ++counters_.factorizations;
    lu_.compute(scaled);
  }
  void solve(std::span<const double> b, std::span<double> x, double) override {
    Eigen::VectorXd right(structure_.size);
    for (long i = 0; i < structure_.size; ++i) right[i] = b[i] / structure_.row_scale[i];
    right = lu_.solve(right);
    std::copy(right.begin(), right.end(), x.begin());
  }

private:
  const Structure& structure_;
  Counters& counters_;
  Eigen::PartialPivLU<Eigen::MatrixXd> lu_;
};

const char* const most_nodes = "solver.most_nodes";

const Registration<LinearSolverKind> registration(
    {.name = "dense",
     .help = "dense factors",
     .keys = {{.name = most_nodes, .default_value = 100.0, .help = "of a mesh for dense factors"}},
     .make =
         [](const Scene& scene, const MeshSize& mesh) {
           if (mesh.nodes > scene.real(most_nodes))
             throw InputError(scene.where(most_nodes) + "the mesh has more nodes");
           return LinearSolverMaker{[](const Structure& structure, Counters& counters) {
             return std::make_unique<DenseSolver>(structure, counters);
           }};
         },
     .memory = [](const Scene&, const MeshSize& mesh) { return 8 * std::pow(4 * mesh.nodes, 2); }});

// By every driver: KINSOL, IDA, and the stages of an explicit method.
TEST(OwnLinearSolver, GivesTheNumbersOfFactors) {
  for (const char* name : {"backward-euler", "esdirk-3", "bdf", "forward-euler"}) {
    SCOPED_TRACE(name);
    const bool euler = std::string(name).ends_with("euler");
    const auto run = [&](const char* method) {
      return run_pin(name, euler ? 10 : 0, 1e-3, 100, {elements(5), method});
    };
    const PinRun dense = run("solver.method=dense"), direct = run("solver.method=direct");
    EXPECT_EQ(dense.counters.newton_iterations, direct.counters.newton_iterations);
    EXPECT_EQ(dense.counters.linear_solves, direct.counters.linear_solves);
    EXPECT_EQ(dense.counters.factorizations, direct.counters.factorizations);
    const Structure& structure = direct.model->system().structure();
    for (long i = 0; i < structure.size; ++i)
      ASSERT_NEAR(dense.last().y[i], direct.last().y[i], 1e-9 * structure.unknown_scale[i]) << i;
  }
}

TEST(OwnLinearSolver, HasAKeyOfItsOwn) {
  EXPECT_THAT(
      [] {
        pin_model({elements(12), "solver.method=dense"});
      },
      ThrowsMessage<InputError>(HasSubstr("the mesh has more nodes")));
  pin_model({elements(12), "solver.method=dense", "solver.most_nodes=200"});
  EXPECT_THAT(
      pin_scene({"solver.most_nodes=200"}).idle_texts(),
      ::testing::ElementsAre("solver.most_nodes has no effect: solver.method is \"block\""));
}

// It would end in a call of nothing, in the middle of a run.
TEST(OwnLinearSolver, IsRefusedWithoutItsFunctions) {
  EXPECT_THAT(
      [] {
        Registry<LinearSolverKind>::add(
            {.name = "half", .help = "", .keys = {}, .make = {}, .memory = {}});
      },
      ThrowsMessage<RegistrationError>(HasSubstr("\"half\" is registered without `make`")));
}

}  // namespace
}  // namespace gnomon::own_linear_solver_test
