// The block solver on exact coupled Jacobians, against the properties that follow from its
// derivation.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/linear/inner_solver.hpp>
#include <gnomon/linear/jacobian_block.hpp>
#include <numbers>
#include <tuple>

#include "linear/block_preconditioner.hpp"
#include "newton/krylov.hpp"
#include "support/pin.hpp"
#include "support/pressed_block.hpp"

namespace gnomon::block_solver_test {
namespace {

using namespace testing;

/// A Jacobian, a right side, and inner solvers.
struct Problem {
  Structure structure;
  InnerSolverMaker inner;
  std::vector<double> J, F;

  Problem(const System& system, const std::vector<double>& y, double alpha,
          InnerSolverMaker inner_solvers, const ActiveSet* branch = nullptr)
      : structure(system.structure()),
        inner(std::move(inner_solvers)),
        J(structure.pattern.nonzeros()),
        F(structure.size) {
    const std::vector<double> rest(structure.size, 0.0);
    system.residual({0, y, rest, branch}, F);
    system.jacobian({0, y, rest, branch}, alpha, J);
  }
  double size(const std::vector<double>& r) const {
    double sum = 0;
    for (long i = 0; i < structure.size; ++i) sum += std::pow(r[i] / structure.row_scale[i], 2);
    return std::sqrt(sum);
  }
  struct Solution {
    long iterations = 0;
    std::vector<double> x;
  };
  /// At a relative tolerance of 1e-8; the residual is checked.
  Solution solve() const {
    Counters counters;
    gnomon::sundials::BlockSolver solver(structure, counters, inner);
    std::vector<double> x(structure.size), r(structure.size);
    solver.set_up(J);
    solver.solve(F, x, 1e-8, 1e-8);
    multiply(structure.pattern, J, x, r);
    for (long i = 0; i < structure.size; ++i) r[i] -= F[i];
    EXPECT_LT(size(r), 2e-8 * size(F));
    return {counters.krylov_iterations, x};
  }
  long iterations() const { return solve().iterations; }
};

/// The pin at 50 s and the residual of a step of size `step` there.
Problem pin_problem(int n, double step, const InnerSolverMaker& inner, const Overrides& more = {}) {
  Overrides overrides = {elements(n)};
  overrides.insert(overrides.end(), more.begin(), more.end());
  const PinRun run = run_pin("backward-euler", 25, 1e-4, 50, overrides);
  return {run.model->system(), run.last().y, 1 / step, inner};
}

/// Whether multigrid is told the grid lines of the block.
enum class Lines { unknown, known };

/// The block under a Hertzian guess of the pressure, an eighth of its surface in contact.
Problem block_problem(int n, double step, const InnerSolverMaker& inner, double poisson_ratio = 0.3,
                      Lines lines = Lines::unknown) {
  const PressedBlock block{.across = n, .high = n, .poisson_ratio = poisson_ratio};
  AssemblyParts<3> parts = pressed_block(block);
  if (lines == Lines::known) parts.solver.coarsens = true;
  const auto body = std::make_shared<const Assembly<3>>(std::move(parts));
  const WornBodyEquations<3> equations(body);
  const ComposedSystem<3> system(equations.composition());
  FieldValues<3> values(*equations.composition()->fields);
  auto lambda = values.scalar(equations.fields().lambda);
  const double a = 0.4 * block.size, p0 = 6 * block.force / (std::numbers::pi * a * a);
  ActiveSet branch;
  for (std::size_t c = 0; c < body->contact_nodes.size(); ++c) {
    const Vector<3>& X = body->mesh.nodes[body->contact_nodes[c].node];
    const double inside = 1 - (X[0] * X[0] + X[1] * X[1]) / (a * a);
    branch.push_back(inside > 0);
    lambda[static_cast<Eigen::Index>(c)] = inside > 0 ? -p0 * std::sqrt(inside) : 0;
  }
  std::vector<double> y(system.structure().size);
  system.numbering().gather(values, y);
  return {system, y, 1 / step, inner, &branch};
}

/// Drops the derivatives that the preconditioner drops: equilibrium by shape, and wear by the shape
/// of neighbouring nodes.
void decouple(Problem& problem) {
  const Structure& s = problem.structure;
  for (int j = 0; j < s.pattern.size(); ++j)
    for (int k = s.pattern.column_start[j]; k < s.pattern.column_start[j + 1]; ++k) {
      const int i = s.pattern.row_index[k];
      const bool surface = s.block_of(j).role == Role::evolution;
      const bool shape = surface || s.block_of(j).role == Role::extension;
      if (s.block_of(i).role == Role::stiffness && shape) problem.J[k] = 0;
      if (s.block_of(i).role == Role::evolution && surface && s.group[i] != s.group[j])
        problem.J[k] = 0;
    }
}

// Where nodes wear enough for the compliance of a step to be their own, nothing else is neglected.
TEST(BlockPreconditioner, IsTheInverseOfWhatItKeeps) {
  for (const char* form : {"eliminated", "multiplier"}) {
    Problem problem =
        pin_problem(10, 200, factor_solvers(), {std::string("shape.constraint=") + form});
    decouple(problem);
    BlockPreconditioner preconditioner(problem.structure, problem.inner);
    preconditioner.refresh(problem.J);
    preconditioner.set_up(true);
    const long n = problem.structure.size;
    std::vector<double> r(n), z(n);
    for (long j = 0; j < n; ++j) {
      std::vector<double> unit(n, 0.0);
      unit[j] = problem.structure.unknown_scale[j];
      multiply(problem.structure.pattern, problem.J, unit, r);
      preconditioner.apply(r, z);
      for (long i = 0; i < n; ++i)
        ASSERT_NEAR(z[i], unit[i], 1e-9 * problem.structure.unknown_scale[i]) << i << " " << j;
    }
  }
}

// Then flexible GMRES has nothing left to do, for all scales of the rows.
TEST(BlockSolver, IsDoneAtOnceWhereNothingIsNeglected) {
  Problem problem = pin_problem(10, 200, factor_solvers());
  decouple(problem);
  EXPECT_LE(problem.iterations(), 2);
}

TEST(BlockSolver, IterationsHardlyGrowWithTheMeshOrTheStep) {
  const long coarse = pin_problem(20, 50, factor_solvers()).iterations();
  const long fine = pin_problem(40, 50, factor_solvers()).iterations();
  EXPECT_LE(coarse, 8);
  EXPECT_LE(fine, coarse + 2);
  EXPECT_LE(pin_problem(40, 5, factor_solvers()).iterations(), 7);
  EXPECT_LE(pin_problem(40, 200, factor_solvers()).iterations(), 10);
}

TEST(BlockSolver, SolvesInThreeDimensions) {
  const long coarse = block_problem(4, 5, factor_solvers()).iterations();
  const long fine = block_problem(8, 5, factor_solvers()).iterations();
  EXPECT_LE(coarse, 12);
  EXPECT_LE(fine, coarse + 3);
}

// On 16x16x16 elements there is an aggregate of one node, which causes zero rows on the level
// below.
TEST(Multigrid, IterationsHardlyGrowWithTheMesh) {
  if (!has_multigrid()) GTEST_SKIP() << "built without PETSc";
  for (const auto& [poisson_ratio, most] : {std::pair{0.3, 14}, {0.45, 19}}) {
    SCOPED_TRACE(poisson_ratio);
    const auto iterations = [nu = poisson_ratio](int n) {
      return block_problem(n, 5, multigrid_solvers(), nu).iterations();
    };
    const long coarse = iterations(8), fine = iterations(16);
    EXPECT_LE(coarse, most);
    EXPECT_LE(fine, coarse + 6);  // wide aggregates on two levels: four more when nearly
  }                               // incompressible, two more otherwise
  EXPECT_LE(pin_problem(40, 50, multigrid_solvers()).iterations(), 16);
}

// Twice as fine, and twice again. Nearly incompressible bodies have motions without change of
// volume that the coarse meshes do not have.
TEST(Multigrid, AlongGridLinesTakesNearlyTheSameIterationsOnEveryMesh) {
  if (!has_multigrid()) GTEST_SKIP() << "built without PETSc";
  for (const auto& [poisson_ratio, most, growth] : {std::tuple{0.3, 12, 2}, {0.45, 20, 4}}) {
    const auto iterations = [nu = poisson_ratio](int n) {
      return block_problem(n, 5, multigrid_solvers(), nu, Lines::known).iterations();
    };
    const long coarse = iterations(6), fine = iterations(12), finest = iterations(24);
    EXPECT_LE(std::max({coarse, fine, finest}), most) << poisson_ratio;
    EXPECT_LE(std::max(fine, finest), coarse + growth) << poisson_ratio;
  }
}

TEST(Multigrid, AgreesWithFactors) {
  if (!has_multigrid()) GTEST_SKIP() << "built without PETSc";
  const auto factors = block_problem(8, 50, factor_solvers()).solve();
  for (const Lines lines : {Lines::unknown, Lines::known}) {
    const Problem problem = block_problem(8, 50, multigrid_solvers(), 0.3, lines);
    EXPECT_EQ(problem.structure.coarsening != nullptr, lines == Lines::known);
    const auto multigrid = problem.solve();
    for (long i = 0; i < problem.structure.size; ++i)
      ASSERT_NEAR(factors.x[i], multigrid.x[i], 1e-6 * problem.structure.unknown_scale[i]) << i;
  }
}

// Flexible GMRES does not need this, but reproducible runs do.
class BothMultigrids : public ::testing::TestWithParam<Lines> {};
INSTANTIATE_TEST_SUITE_P(Multigrid, BothMultigrids,
                         ::testing::Values(Lines::unknown, Lines::known));

TEST_P(BothMultigrids, AreOneLinearMap) {
  if (!has_multigrid()) GTEST_SKIP() << "built without PETSc";
  const Lines lines = GetParam();
  const Problem problem = block_problem(10, 5, multigrid_solvers(), 0.3, lines);
  const auto& scale = problem.structure.row_scale;
  BlockPreconditioner first(problem.structure, problem.inner),
      second(problem.structure, problem.inner);
  for (BlockPreconditioner* p : {&first, &second}) {
    p->refresh(problem.J);
    p->set_up(true);
  }
  const std::size_t n = scale.size();
  std::vector<double> a(n), b(n), sum(n), Ma(n), Mb(n), Msum(n), again(n);
  for (std::size_t i = 0; i < n; ++i) {
    a[i] = scale[i] * std::sin(1.0 * i);
    b[i] = scale[i] * std::cos(1.7 * i);
    sum[i] = a[i] - 2 * b[i];
  }
  first.apply(a, Ma);
  first.apply(b, Mb);
  first.apply(sum, Msum);
  second.apply(sum, again);
  EXPECT_EQ(Msum, again);
  double largest = 0, error = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = Ma[i] - 2 * Mb[i], unit = problem.structure.unknown_scale[i];
    largest = std::max(largest, std::abs(z / unit));
    error = std::max(error, std::abs((z - Msum[i]) / unit));
  }
  EXPECT_LT(error, 1e-10 * largest);
}

TEST(BlockSolver, RefusesASystemWithoutBlocks) {
  EXPECT_THROW(BlockPreconditioner(Structure{}, factor_solvers()), InputError);
}

TEST(BlockSolver, GivesTheTrajectoriesOfTheDirectOne) {
  for (const char* name : {"backward-euler", "esdirk-3", "bdf"}) {
    SCOPED_TRACE(name);
    const double step = std::string(name) == "backward-euler" ? 25 : 0;
    const auto direct = pin_model({elements(16), "solver.method=direct"});
    const auto block = pin_model({elements(16), "solver.method=block"});
    const ModelRun a = run_model(*direct, name, step, 1e-3, 200);
    const ModelRun b = run_model(*block, name, step, 1e-3, 200);
    ASSERT_EQ(a.counters.steps, b.counters.steps);
    EXPECT_GT(b.counters.krylov_iterations, 0);
    EXPECT_EQ(a.counters.krylov_iterations, 0);
    EXPECT_LT(b.counters.factorizations, a.counters.factorizations + 10);
    const Structure& structure = direct->system().structure();
    for (long i = 0; i < structure.size; ++i)
      EXPECT_NEAR(a.last().y[i], b.last().y[i], 1e-6 * structure.unknown_scale[i]);
  }
}

// A body so soft that the blocks neglect too much: where factors of the whole Jacobian are at hand,
// slow blocks are tried twice only.
TEST(BlockSolver, GivesWayToFactorsWhereItIsSlow) {
  const auto counters = [](const char* method) {
    const auto model = pin_model({elements(12), "body.young_modulus=3", method});
    return run_model(*model, "esdirk-3", 0, 1e-6, 1000).counters;
  };
  const Counters direct = counters("solver.method=direct"), block = counters("solver.method=block");
  EXPECT_GT(block.krylov_iterations, 0);
  EXPECT_LT(block.krylov_iterations, 600);
  EXPECT_LT(block.factorizations, direct.factorizations + 20);
}

}  // namespace
}  // namespace gnomon::block_solver_test
