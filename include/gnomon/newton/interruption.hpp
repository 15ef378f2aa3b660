// Long solves may be ended from outside, without waiting for the end of a step.
#pragma once

#include <functional>
#include <gnomon/base/error.hpp>

namespace gnomon {

/// Ends a solve that is not wanted any more; no failure, after which a shorter step is tried.
struct Interruption : Error {
  using Error::Error;
};

/// While it lives, every iteration of NewtonSolver on this thread begins with the question, and
/// throws Interruption where its answer is true (not those of bdf, which IDA makes). The last one
/// that was made counts.
class Interruptible {
public:
  /// `asked` must outlive it.
  explicit Interruptible(const std::function<bool()>& asked);
  ~Interruptible();
  Interruptible(const Interruptible&) = delete;
  Interruptible& operator=(const Interruptible&) = delete;

private:
  const std::function<bool()>* before_;
};

/// Throws Interruption.
void require_uninterrupted();

}  // namespace gnomon
