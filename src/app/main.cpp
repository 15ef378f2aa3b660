#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <iostream>

#include "app/program.hpp"

namespace {

/// Threads that wait for work actively take a quarter of the CPU time of small scenes, and save no
/// time. libgomp reads its settings when it is loaded, which is why the program starts once more.
void let_threads_sleep_where_they_wait(char** argv) {
  constexpr const char* setting = "OMP_WAIT_POLICY";
  if (!std::getenv(setting) && setenv(setting, "passive", 1) == 0) execv("/proc/self/exe", argv);
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
  const int code = gnomon::app::program(argc, argv);
  leave_without_waiting_where_addresses_are_limited(code);
  return code;
}
