#include "base/threads.hpp"

#include <omp.h>

#include <exception>
#include <vector>

namespace gnomon {

void divide_among_threads(long count, long entries, const std::function<void(long)>& work) {
  const int threads = omp_get_max_threads();
  if (threads == 1 || count <= threads || entries < worth_threads) {
    for (long i = 0; i < count; ++i) work(i);
    return;
  }
  std::vector<std::exception_ptr> errors(count);
#pragma omp parallel for schedule(dynamic)
  for (long i = 0; i < count; ++i) try {
      work(i);
    } catch (...) {
      errors[i] = std::current_exception();
    }
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace gnomon
