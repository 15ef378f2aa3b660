// Arithmetic that may overflow or have no result, and is looked at afterwards.
#pragma once

#include <cfenv>

namespace gnomon {

/// Floating-point exceptions do not trap (GNOMON_TRAP) during the life of this object.
class UntrappedArithmetic {
public:
  UntrappedArithmetic() { std::feholdexcept(&before_); }
  ~UntrappedArithmetic() { std::fesetenv(&before_); }
  UntrappedArithmetic(const UntrappedArithmetic&) = delete;
  UntrappedArithmetic& operator=(const UntrappedArithmetic&) = delete;

private:
  std::fenv_t before_;
};

}  // namespace gnomon
