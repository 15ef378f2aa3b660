#include "app/plotting_script.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <gnomon/base/error.hpp>
#include <gnomon/base/installation.hpp>
#include <iterator>

namespace gnomon::app {

namespace {

/// Exit code of `python3 ARGUMENTS`.
int python(const std::vector<std::string>& arguments, const std::string& log) {
  std::vector<char*> argv = {const_cast<char*>("python3")};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const pid_t process = fork();
  if (process < 0) return -1;
  if (process == 0) {
    const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
    execvp(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  while (waitpid(process, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

/// The last line that a failed program printed, without the name of the program before it.
std::string last_line(const std::filesystem::path& log) {
  std::ifstream stream(log, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  while (!text.empty() && text.back() == '\n') text.pop_back();
  if (text.empty())
    return fmt::format("drawing needs Python 3 and the packages {}", drawing_packages);
  std::string line = text.substr(text.rfind('\n') + 1);  // npos + 1 is zero
  if (const std::string name = "gnomon: "; line.starts_with(name)) line.erase(0, name.size());
  return line;
}

}  // namespace

std::filesystem::path plotting_script() {
  return installed("share/gnomon/plot/gnomon_plot.py");
}

ScriptEnd run_plotting_script(const std::vector<std::string>& arguments,
                              const std::filesystem::path& log) {
  std::vector<std::string> words;
  try {
    words = {plotting_script().string()};
  } catch (const Error& error) {
    return {1, error.what()};
  }
  words.insert(words.end(), arguments.begin(), arguments.end());
  ScriptEnd end{python(words, log.string()), {}};
  if (end.exit_code != 0) {
    end.complaint = last_line(log);
  } else {
    std::error_code error;
    std::filesystem::remove(log, error);
  }
  return end;
}

}  // namespace gnomon::app
