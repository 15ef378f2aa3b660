// The entry of libFuzzer, for the target GNOMON_FUZZ_TARGET.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <gnomon/base/error.hpp>

#include "fuzz/targets.hpp"

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  return std::freopen("/dev/null", "w", stdout) == nullptr;  // libFuzzer writes to stderr
}

/// Everything else than a return or an InputError in one line ends the process, and libFuzzer
/// reports it.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    gnomon::fuzz::GNOMON_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  } catch (const gnomon::InputError& error) {
    const std::string_view message = error.what();
    gnomon::fuzz::demand(message.find('\n') == message.npos, "a message is one line");
  }
  return 0;
}
