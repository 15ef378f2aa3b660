// Settings of the BLAS behind the factorizations.
#pragma once

namespace gnomon {

/// The fronts of 2D problems are too small to share: a second thread only costs (measured: 11.7 s
/// instead of 6.5 s for a run of 20 steps on busy cores), and OpenBLAS wakes one for each of them.
void use_one_blas_thread();

}  // namespace gnomon
