#include "app/interrupt.hpp"

#include <unistd.h>

#include <csignal>

namespace gnomon::app {

namespace {

volatile std::sig_atomic_t signalled = 0;
volatile std::sig_atomic_t announced = 0;

extern "C" void on_signal(int) {
  signalled = 1;
  std::signal(SIGINT, SIG_DFL);
  if (!announced) return;
  static const char text[] = "\ngnomon: ending at the last step (or the start); Ctrl-C kills now\n";
  // Nothing can be done about a failure, and nothing else is safe here.
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text, sizeof text - 1);
}

}  // namespace

InterruptGuard::InterruptGuard(bool announce) {
  signalled = 0;
  announced = announce;
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGPIPE, SIG_IGN);  // the writing call then reports the error
  std::signal(SIGXFSZ, SIG_IGN);
}

InterruptGuard::~InterruptGuard() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGPIPE, SIG_DFL);
  std::signal(SIGXFSZ, SIG_DFL);
}

bool InterruptGuard::interrupted() {
  return signalled != 0;
}

}  // namespace gnomon::app
