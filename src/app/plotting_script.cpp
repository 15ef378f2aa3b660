#include "app/plotting_script.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <gnomon/base/error.hpp>
#include <gnomon/base/installation.hpp>
#include <iterator>
#include <optional>
#include <sstream>

namespace gnomon::app {

namespace {

constexpr int cannot_start = 127;

/// Status of `python3 ARGUMENTS` as of waitpid(); nothing if there was no process.
std::optional<int> run_python(const std::vector<std::string>& arguments, const std::string& log) {
  std::vector<char*> argv = {const_cast<char*>("python3")};
  for (const std::string& argument : arguments) argv.push_back(const_cast<char*>(argument.c_str()));
  argv.push_back(nullptr);
  const pid_t process = fork();
  if (process < 0) return {};
  if (process == 0) {
    const int out = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    dup2(out, STDOUT_FILENO);
    dup2(out, STDERR_FILENO);
    execvp(argv[0], argv.data());
    _exit(cannot_start);
  }
  int status = 0;
  while (waitpid(process, &status, 0) < 0)
    if (errno != EINTR) return {};
  return status;
}

std::string text_of(const std::filesystem::path& log) {
  std::ifstream stream(log, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// Why a program failed that printed nothing.
std::string why_silent(const std::optional<int>& status) {
  if (!status) return "a process for drawing cannot be started";
  if (WIFSIGNALED(*status))
    return fmt::format("drawing was ended by signal {} ({})", WTERMSIG(*status),
                       strsignal(WTERMSIG(*status)));
  if (WEXITSTATUS(*status) == cannot_start)
    return fmt::format("drawing needs Python 3 and the packages {}", drawing_packages);
  return fmt::format("the drawing program ended with exit code {} and no message",
                     WEXITSTATUS(*status));
}

/// The last line that a failed program printed, without the name of the program before it.
std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
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
    return {.exit_code = 1, .complaint = error.what(), .printed = {}};
  }
  words.insert(words.end(), arguments.begin(), arguments.end());
  const std::optional<int> status = run_python(words, log.string());
  ScriptEnd end{.exit_code = status && WIFEXITED(*status) ? WEXITSTATUS(*status) : -1,
                .complaint = {},
                .printed = text_of(log)};
  if (end.exit_code != 0) {
    end.complaint = last_line(end.printed);
    if (end.complaint.empty() || end.exit_code < 0) end.complaint = why_silent(status);
  } else {
    std::error_code error;
    std::filesystem::remove(log, error);
  }
  return end;
}

namespace fs = std::filesystem;

namespace {

/// Of what the script printed, the figures that it left out: "NAME: REASON; ...".
std::string left_out(const std::string& printed) {
  std::istringstream lines(printed);
  std::string texts;
  for (std::string line; std::getline(lines, line);) {
    const std::string mark = ": skipped, ";
    const std::size_t place = line.find(mark);
    if (place == std::string::npos) continue;
    texts += fmt::format("{}{}: {}", texts.empty() ? "" : "; ", line.substr(0, place),
                         line.substr(place + mark.size()));
  }
  return texts;
}

}  // namespace

DrawnPage draw_page(const fs::path& folder, const std::string& kind) {
  const fs::path page = folder / "index.html";
  std::error_code error;
  fs::remove_all(folder / "figures", error);  // of earlier tables
  fs::remove(page, error);
  const ScriptEnd end =
      run_plotting_script({kind, "--svg", "--", folder.string()}, folder / "figures.log");
  DrawnPage drawn{fs::exists(page, error), {}};
  if (end.exit_code != 0)
    drawn.complaint =
        fmt::format("{}: {}; `gnomon plot {}` draws {}\n", drawn.exists ? "no figures" : "no page",
                    end.complaint, folder.string(), drawn.exists ? "them" : "it");
  else if (const std::string texts = left_out(end.printed);
           !texts.empty() && !fs::exists(folder / "figures", error))
    drawn.complaint = fmt::format("no figures: {}\n", texts);
  return drawn;
}

}  // namespace gnomon::app
