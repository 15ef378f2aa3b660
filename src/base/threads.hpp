// Work that is divided among the threads of OpenMP.
#pragma once

#include <functional>

namespace gnomon {

/// work(i) for 0 <= i < count, each by one thread where there are more of them than threads;
/// otherwise one after the other, each by all threads. Of several exceptions that of the smallest i
/// is thrown again.
void divide_among_threads(long count, const std::function<void(long)>& work);

}  // namespace gnomon
