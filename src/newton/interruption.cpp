#include <gnomon/newton/interruption.hpp>
#include <utility>

namespace gnomon {

namespace {

// Solvers are made far below what may interrupt them, and many of them.
thread_local const std::function<bool()>* question = nullptr;

}  // namespace

Interruptible::Interruptible(const std::function<bool()>& asked)
    : before_(std::exchange(question, &asked)) {}

Interruptible::~Interruptible() {
  question = before_;
}

void require_uninterrupted() {
  if (question && *question && (*question)()) throw Interruption("the solution was interrupted");
}

}  // namespace gnomon
