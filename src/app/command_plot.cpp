// gnomon plot: finds the drawing program, which is Python (tools/plot), and runs it.

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "app/commands.hpp"
#include "app/plotting_script.hpp"
#include "study/process_pool.hpp"

namespace gnomon::app {

namespace {

constexpr const char* python = "python3";

/// Replaces this process by the program, so that signals reach it; without a shell, because names
/// of files may contain any character.
[[noreturn]] void become(const std::vector<std::string>& words) {
  std::fflush(stdout);
  execvp(python, study::pointers_to(words).data());
  throw std::runtime_error(fmt::format("cannot run {} ({}): plots need the packages {}", python,
                                       std::strerror(errno), drawing_packages));
}

}  // namespace

void plot_command(const std::vector<std::filesystem::path>& targets,
                  const std::filesystem::path& folder) {
  std::vector<std::string> words = {python, plotting_script().string(), "any"};
  if (!folder.empty()) words.push_back("--output=" + folder.string());
  words.push_back("--");
  for (const std::filesystem::path& target : targets) words.push_back(target.string());
  become(words);
}

}  // namespace gnomon::app
