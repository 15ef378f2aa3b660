// Work that is divided among the threads of OpenMP.
#pragma once

#include <functional>

namespace gnomon {

/// Entries of sparse matrices below which waking threads costs more than they gain, by far where
/// other programs use the cores.
inline constexpr long worth_threads = 200'000;

/// work(i) for 0 <= i < count, each by one thread where there are more of them than threads, and
/// where all together have at least `worth_threads` entries; otherwise one after the other, each by
/// all threads. Of several exceptions that of the smallest i is thrown again.
void divide_among_threads(long count, long entries, const std::function<void(long)>& work);

}  // namespace gnomon
