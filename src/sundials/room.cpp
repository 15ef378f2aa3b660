#include "room.hpp"

#include <nvector/nvector_serial.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace gnomon::sundials {

void check(int flag, const char* what) {
  if (flag < 0) throw Error(std::string(what) + " failed with code " + std::to_string(flag));
}

void check(const void* handle, const char* what) {
  if (!handle) throw Error(std::string(what) + " failed: no memory");
}

VectorOwner make_vector(long n, SUNContext context) {
  VectorOwner v(N_VNew_Serial(n, context));
  check(v.get(), "N_VNew_Serial");
  N_VConst(0, v.get());
  return v;
}

std::span<double> view(N_Vector v) {
  return {N_VGetArrayPointer_Serial(v), static_cast<std::size_t>(N_VGetLength_Serial(v))};
}

void require_finite(std::span<const double> values, const char* what) {
  if (!std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); }))
    throw RecoverableError(std::string(what) + " is not finite");
}

double scaled_norm(std::span<const double> F, const std::vector<double>& row_scale) {
  double largest = 0;
  for (std::size_t i = 0; i < F.size(); ++i)
    largest = std::max(largest, std::abs(F[i]) / row_scale[i]);
  return largest;
}

// ---- matrix
// --------------------------------------------------------------------------------------

namespace {

struct MatrixContent {
  const Structure& structure;
  std::vector<double> values;
};

MatrixContent& content(SUNMatrix matrix) {
  return *static_cast<MatrixContent*>(matrix->content);
}

SUNMatrix new_matrix(const Structure& structure, SUNContext context) {
  SUNMatrix matrix = SUNMatNewEmpty(context);
  if (!matrix) return nullptr;
  matrix->content = new MatrixContent{structure, std::vector<double>(structure.pattern.nonzeros())};
  matrix->ops->getid = [](SUNMatrix) { return SUNMATRIX_CUSTOM; };
  matrix->ops->clone = [](SUNMatrix m) { return new_matrix(content(m).structure, m->sunctx); };
  matrix->ops->zero = [](SUNMatrix m) {
    std::fill(content(m).values.begin(), content(m).values.end(), 0.0);
    return 0;
  };
  matrix->ops->destroy = [](SUNMatrix m) {
    delete &content(m);
    SUNMatFreeEmpty(m);
  };
  return matrix;
}

}  // namespace

MatrixOwner make_matrix(const Structure& structure, SUNContext context) {
  MatrixOwner matrix(new_matrix(structure, context));
  check(matrix.get(), "SUNMatNewEmpty");
  return matrix;
}

std::span<double> values(SUNMatrix matrix) {
  return content(matrix).values;
}

// ---- linear solver
// -------------------------------------------------------------------------------

namespace {

struct LinearContent {
  SparseLu lu;
  Counters& counters;
  Guard& guard;
  const bool* keep;
};

LinearContent& content(SUNLinearSolver solver) {
  return *static_cast<LinearContent*>(solver->content);
}

int setup(SUNLinearSolver solver, SUNMatrix matrix) {
  LinearContent& c = content(solver);
  if (c.keep && *c.keep) return 0;
  return c.guard.run([&] {
    ++c.counters.factorizations;
    if (!c.lu.factorize(values(matrix))) throw RecoverableError("the Jacobian is singular");
  });
}

int solve(SUNLinearSolver solver, SUNMatrix, N_Vector x, N_Vector b, sunrealtype) {
  LinearContent& c = content(solver);
  return c.guard.run([&] {
    ++c.counters.linear_solves;
    if (x == b) {  // IDA solves in place, UMFPACK does not
      const std::vector<double> right(view(b).begin(), view(b).end());
      c.lu.solve(right, view(x));
    } else {
      c.lu.solve(view(b), view(x));
    }
  });
}

}  // namespace

LinearSolverOwner make_linear_solver(const Structure& structure, Counters& counters, Guard& guard,
                                     SUNContext context, const bool* keep) {
  SUNLinearSolver solver = SUNLinSolNewEmpty(context);
  check(solver, "SUNLinSolNewEmpty");
  LinearSolverOwner owner(solver);
  solver->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  solver->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
  solver->ops->initialize = [](SUNLinearSolver) { return 0; };
  solver->ops->setup = setup;
  solver->ops->solve = solve;
  solver->ops->free = [](SUNLinearSolver s) {
    delete static_cast<LinearContent*>(s->content);
    s->content = nullptr;
    SUNLinSolFreeEmpty(s);
    return 0;
  };
  solver->content =
      new LinearContent{SparseLu(structure.pattern, structure.group), counters, guard, keep};
  return owner;
}

}  // namespace gnomon::sundials
