// Ctrl-C and SIGTERM end a run at its last step. Then Ctrl-C kills it, but SIGTERM does not:
// a run of a study may get it twice, from a batch system that sends it to all processes of a job,
// and from the study that ends. A run does not end when the reader of its progress has gone away.
#pragma once

namespace gnomon::app {

/// Catches the signals while it lives. At most one at a time.
class InterruptGuard {
public:
  explicit InterruptGuard(
      bool announce);  ///< announce: report on stderr that the signal was received
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  static bool interrupted();
};

}  // namespace gnomon::app
