// The BLAS that the factorizations use.
#pragma once

#include <string>

namespace gnomon {

/// One thread is best except in a large factorization. The fronts of 2D problems are too small to
/// be divided: a second thread only adds cost (measured: 11.7 s instead of 6.5 s for a run of 20
/// steps on busy cores), and OpenBLAS wakes one for each of them.
void use_blas_threads(int count);

/// Which BLAS this process runs, such as "OpenBLAS 0.3.21", or the name of its file.
std::string blas_name();

/// Whether it is the reference implementation (netlib), with which a factorization takes 4 to 6
/// times as long.
bool is_reference_blas();

}  // namespace gnomon
