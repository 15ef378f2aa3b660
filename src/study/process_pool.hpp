// Runs commands: at the same time, with a report of the time and memory that each has used, or one
// for what it prints.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <gnomon/study/study.hpp>
#include <string>
#include <vector>

namespace gnomon::study {

/// The words of a command as exec() takes them; they stay where they are.
std::vector<char*> pointers_to(const std::vector<std::string>& words);

struct Captured {
  int exit_code = 0;  ///< -1: it has none; 127: there is no such program
  int signal = 0;     ///< that ended it
  std::string out, err;
};

/// Waits for a program, which is looked for in PATH. Throws Error if no process can be started.
Captured run_captured(const std::vector<std::string>& arguments);

struct Command {
  std::vector<std::string> arguments;  ///< the program first
  std::filesystem::path log;           ///< takes standard error; standard output is dropped
  double limit = 0;                    ///< wall time after which it is killed [s]; 0: no limit
};

/// What Linux tells of a process of this machine, from its state on (field 3 of /proc/PID/stat);
/// empty if there is none.
std::string process_stat(long process);

/// The processes of a pool end with the pool, and with the process that made it, however that
/// process ends.
class ProcessPool {
public:
  using Clock = std::chrono::steady_clock;
  using Ended = std::function<void(std::size_t command, const ProcessEnd& end)>;

  ProcessPool() = default;
  ~ProcessPool();
  ProcessPool(const ProcessPool&) = delete;
  ProcessPool& operator=(const ProcessPool&) = delete;

  std::size_t running() const { return children_.size(); }
  /// Ends the process of a command at once; wait() does not report it.
  void kill(std::size_t index);
  /// Starts a command; `index` names it in wait(). Throws Error.
  void start(std::size_t index, const Command& command);
  /// The costs of a running command; of one that does not run any more, none.
  ProcessEnd so_far(std::size_t index) const;
  /// A short time.
  static void pause();
  /// Reports the processes that have ended; waits a short time if there are none.
  void wait(const Ended& ended);
  /// Asks all processes to end, and kills those that have not ended after half a minute: a run ends
  /// at its last step. Reports the end of each.
  void stop(const Ended& ended);

private:
  struct Child {
    pid_t process;
    std::size_t index;
    Clock::time_point deadline;
    bool timed_out = false;
  };
  bool reap(const Ended& ended);
  void kill_the_late();

  std::vector<Child> children_;
};

}  // namespace gnomon::study
