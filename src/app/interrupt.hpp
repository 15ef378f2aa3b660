// Ctrl-C and SIGTERM end a run after its current step; a second one kills as usual. That nobody
// reads its progress any more does not end it.
#pragma once

namespace gnomon::app {

/// Catches the signals while it lives. At most one at a time.
class InterruptGuard {
public:
  explicit InterruptGuard(bool announce);  ///< announce: tell on stderr that the signal was heard
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  static bool interrupted();
};

}  // namespace gnomon::app
