#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <iostream>

#include "app/program.hpp"

namespace {

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
  const int code = gnomon::app::program(argc, argv);
  leave_without_waiting_where_addresses_are_limited(code);
  return code;
}
