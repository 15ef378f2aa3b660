// Linked into the program and the tests by GNOMON_TRAP: from before main on, an invalid operation,
// a division by zero and an overflow end the process (SIGFPE) where they happen.
#include <cfenv>

namespace {

[[maybe_unused]] const int trapped = feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);

}  // namespace
