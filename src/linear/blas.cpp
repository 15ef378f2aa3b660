#include "linear/blas.hpp"

// OpenBLAS has it, other BLAS do not; resolved when the program is loaded.
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace gnomon {

void use_one_blas_thread() {
  if (openblas_set_num_threads) openblas_set_num_threads(1);
}

}  // namespace gnomon
