// gnomon plot: finds the drawing program, which is Python (tools/plot), and runs it.

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <gnomon/error.hpp>
#include <stdexcept>

#include "app/commands.hpp"
#include "app/program.hpp"

extern char** environ;

namespace gnomon::app {

namespace {

constexpr const char* python = "python3";
constexpr const char* packages = "python3-matplotlib python3-h5py";

/// Without a shell: names of files may hold anything. Returns the exit code.
int spawn(const std::vector<std::string>& words) {
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  std::fflush(stdout);
  pid_t child = 0;
  if (const int error = posix_spawnp(&child, python, nullptr, nullptr, argv.data(), environ))
    throw std::runtime_error(fmt::format("cannot run {} ({}): plots need the packages {}", python,
                                         std::strerror(error), packages));
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) throw std::runtime_error("lost the drawing program");
  return WIFEXITED(status) ? WEXITSTATUS(status) : other_failure;
}

}  // namespace

int plot_command(const std::vector<std::filesystem::path>& targets,
                 const std::filesystem::path& folder) {
  const std::filesystem::path script = GNOMON_PLOT_SCRIPT;
  if (!std::filesystem::exists(script))
    throw std::runtime_error(fmt::format("there is no {}", script.string()));
  std::vector<std::string> words = {python, script.string(), "any"};
  if (!folder.empty()) words.push_back("--output=" + folder.string());
  words.push_back("--");
  for (const std::filesystem::path& target : targets) words.push_back(target.string());
  return spawn(words);
}

}  // namespace gnomon::app
