#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "app/program.hpp"

namespace {

/// Threads that wait for work actively take a quarter of the CPU time of small scenes, and save no
/// time. libgomp reads its settings when it is loaded, which is why the program starts once more.
void let_threads_sleep_where_they_wait(char** argv) {
  constexpr const char* setting = "OMP_WAIT_POLICY";
  if (!std::getenv(setting) && setenv(setting, "passive", 1) == 0) execv("/proc/self/exe", argv);
}

/// Vectors of an iteration that go back to the system come with new pages in the next one, which
/// takes a tenth of the time in space.
void keep_memory_that_is_freed() {
#ifdef __GLIBC__
  constexpr int most = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, most);
  mallopt(M_TRIM_THRESHOLD, most);
#endif
}

/// exit() waits for the threads of OpenBLAS. One that gets no memory for its buffer, because of a
/// limit of addresses, tries again without an end.
void leave_without_waiting_where_addresses_are_limited(int code) {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return;
  std::cout.flush();
  std::fflush(nullptr);
  _exit(code);
}

}  // namespace

int main(int argc, char** argv) {
  let_threads_sleep_where_they_wait(argv);
  keep_memory_that_is_freed();
  const int code = gnomon::app::program(argc, argv);
  leave_without_waiting_where_addresses_are_limited(code);
  return code;
}
