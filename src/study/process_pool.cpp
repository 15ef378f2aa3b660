#include "study/process_pool.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <gnomon/base/error.hpp>
#include <sstream>
#include <thread>

#include "study/text_file.hpp"

namespace gnomon::study {

namespace {

constexpr auto pause_between_looks = std::chrono::milliseconds(10);

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

ProcessEnd end_of(int status, const rusage& usage) {
  ProcessEnd end;
  if (WIFSIGNALED(status)) end.signal = WTERMSIG(status);
  if (WIFEXITED(status)) end.exit_code = WEXITSTATUS(status);
  end.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  end.peak_memory_mb = static_cast<double>(usage.ru_maxrss) * 1024e-6;
  return end;
}

/// Runs in the child, between fork and exec, and does only what is safe there.
[[noreturn]] void become(pid_t parent, const char* log, char* const* argv, char* const* envp) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);  // the parent died before the line above
  signal(SIGINT, SIG_DFL);
  signal(SIGTERM, SIG_DFL);
  const int nothing = open("/dev/null", O_RDWR);
  const int errors = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0666);
  dup2(nothing, STDIN_FILENO);
  dup2(nothing, STDOUT_FILENO);
  dup2(errors >= 0 ? errors : nothing, STDERR_FILENO);
  if (nothing > STDERR_FILENO) close(nothing);
  if (errors > STDERR_FILENO) close(errors);
  execve(argv[0], argv, envp);
  _exit(127);
}

/// The environment of this process, with one thread per process unless the user has chosen another
/// number: processes that run at the same time would compete with each other's threads for the
/// cores.
std::vector<char*> environment() {
  static char one_thread[] = "OMP_NUM_THREADS=1";
  std::vector<char*> result;
  for (char** entry = environ; *entry; ++entry) result.push_back(*entry);
  if (!getenv("OMP_NUM_THREADS")) result.push_back(one_thread);
  result.push_back(nullptr);
  return result;
}

/// A file without a name, which takes any amount of text while nobody reads it.
class Sink {
public:
  Sink() : descriptor_(memfd_create("output", MFD_CLOEXEC)) {
    if (descriptor_ < 0)
      throw Error(fmt::format("cannot keep the output of a program: {}", std::strerror(errno)));
  }
  ~Sink() { close(descriptor_); }
  Sink(const Sink&) = delete;
  Sink& operator=(const Sink&) = delete;

  int descriptor() const { return descriptor_; }
  std::string text() const {
    std::string text;
    std::array<char, 4096> part{};
    lseek(descriptor_, 0, SEEK_SET);
    for (ssize_t n; (n = read(descriptor_, part.data(), part.size())) > 0;)
      text.append(part.data(), static_cast<std::size_t>(n));
    return text;
  }

private:
  int descriptor_;
};

}  // namespace

std::vector<char*> pointers_to(const std::vector<std::string>& words) {
  std::vector<char*> pointers;
  for (const std::string& word : words) pointers.push_back(const_cast<char*>(word.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

void ProcessPool::start(std::size_t index, const Command& command) {
  const std::vector<char*> argv = pointers_to(command.arguments);
  const std::vector<char*> envp = environment();
  const std::string log = command.log.string();
  const pid_t parent = getpid(), process = fork();
  if (process == 0) become(parent, log.c_str(), argv.data(), envp.data());
  if (process < 0) throw Error(fmt::format("cannot start a process: {}", std::strerror(errno)));
  const auto limit = std::chrono::duration<double>(command.limit);
  children_.push_back({process, index,
                       command.limit > 0 ? Clock::now() + std::chrono::ceil<Clock::duration>(limit)
                                         : Clock::time_point::max()});
}

void ProcessPool::kill_the_late() {
  for (Child& child : children_) {
    if (Clock::now() < child.deadline) continue;
    child.timed_out = true;
    ::kill(child.process, SIGKILL);
  }
}

bool ProcessPool::reap(const Ended& ended) {
  bool any = false;
  for (std::size_t i = 0; i < children_.size();) {
    int status = 0;
    rusage usage{};
    const pid_t result = wait4(children_[i].process, &status, WNOHANG, &usage);
    if (result == 0 || (result < 0 && errno == EINTR)) {
      ++i;
      continue;
    }
    const Child child = children_[i];
    children_.erase(children_.begin() + static_cast<std::ptrdiff_t>(i));
    any = true;
    if (result <= 0) continue;
    ProcessEnd end = end_of(status, usage);
    end.timed_out = child.timed_out && end.signal == SIGKILL;
    ended(child.index, end);
  }
  return any;
}

void ProcessPool::wait(const Ended& ended) {
  kill_the_late();
  if (!reap(ended) && running() > 0) pause();
}

ProcessEnd ProcessPool::so_far(std::size_t index) const {
  ProcessEnd end;
  const auto child = std::ranges::find(children_, index, &Child::index);
  if (child == children_.end()) return end;
  std::istringstream stat(process_stat(child->process));
  std::string field;
  for (int i = 3; i < 14; ++i) stat >> field;  // from the state of the process on
  double user = 0, system = 0;                 // [ticks]
  if (stat >> user >> system)
    end.cpu_seconds = (user + system) / static_cast<double>(sysconf(_SC_CLK_TCK));
  return end;
}

std::string process_stat(long process) {
  const std::string stat = read_text(fmt::format("/proc/{}/stat", process));
  const std::size_t name_end = stat.rfind(')');  // the name may hold anything
  return name_end == std::string::npos ? std::string() : stat.substr(name_end + 1);
}

void ProcessPool::pause() {
  std::this_thread::sleep_for(pause_between_looks);
}

void ProcessPool::kill(std::size_t index) {
  const auto child = std::ranges::find(children_, index, &Child::index);
  if (child == children_.end()) return;
  const pid_t process = child->process;
  children_.erase(child);
  ::kill(process, SIGKILL);
  while (waitpid(process, nullptr, 0) < 0 && errno == EINTR) continue;
}

ProcessPool::~ProcessPool() {
  while (running() > 0) kill(children_.back().index);
}

void ProcessPool::stop(const Ended& ended) {
  constexpr auto patience = std::chrono::seconds(30);
  const auto begin = Clock::now();
  for (const Child& child : children_) ::kill(child.process, SIGTERM);
  while (running() > 0) {
    if (Clock::now() - begin > patience)
      for (const Child& child : children_) ::kill(child.process, SIGKILL);
    wait(ended);
  }
}

Captured run_captured(const std::vector<std::string>& arguments) {
  const Sink out, err;
  const std::vector<char*> argv = pointers_to(arguments);
  const pid_t process = fork();
  if (process < 0)
    throw Error(fmt::format("cannot start {}: {}", arguments.front(), std::strerror(errno)));
  if (process == 0) {
    setpgid(0, 0);  // Ctrl-C is for gnomon alone
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(out.descriptor(), STDOUT_FILENO);
    dup2(err.descriptor(), STDERR_FILENO);
    execvp(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  while (waitpid(process, &status, 0) < 0)
    if (errno != EINTR) break;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, WIFSIGNALED(status) ? WTERMSIG(status) : 0,
          out.text(), err.text()};
}

}  // namespace gnomon::study
