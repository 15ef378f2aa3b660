#include "study/captured.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <gnomon/base/error.hpp>

namespace gnomon::study {

namespace {

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

Captured run_captured(const std::vector<std::string>& arguments) {
  const Sink out, err;
  std::vector<char*> argv;
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
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
