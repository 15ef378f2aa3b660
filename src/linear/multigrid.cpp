#include <dlfcn.h>

#include <gnomon/base/error.hpp>
#include <gnomon/base/installation.hpp>
#include <gnomon/linear/inner_solver.hpp>

#include "linear/unknown_interpolation.hpp"

namespace gnomon {

#ifdef GNOMON_HAS_MULTIGRID

bool has_multigrid() {
  return true;
}

std::unique_ptr<InnerSolver> make_multigrid_solver(const StiffnessLayout& layout) {
  using New = InnerSolver*(const StiffnessLayout&, const std::vector<SparseRows>&);
  // Never unloaded, because PETSc and MPI do not support it.
  static void* const module =
      dlopen(installed("libexec/gnomon/gnomon_multigrid.so").c_str(), RTLD_NOW | RTLD_LOCAL);
  static const auto make =
      module ? reinterpret_cast<New*>(dlsym(module, "gnomon_new_multigrid")) : nullptr;
  if (!make) {
    const char* reason = dlerror();
    throw Error(std::string("multigrid cannot be loaded: ") + (reason ? reason : "unknown"));
  }
  return std::unique_ptr<InnerSolver>(make(layout, unknown_interpolations(layout)));
}

#else

bool has_multigrid() {
  return false;
}

std::unique_ptr<InnerSolver> make_multigrid_solver(const StiffnessLayout&) {
  throw InputError(
      "solver.preconditioner = \"multigrid\" needs PETSc, but this gnomon was built without it");
}

#endif

InnerSolverMaker multigrid_solvers() {
  return {make_multigrid_solver, 1};
}

}  // namespace gnomon
