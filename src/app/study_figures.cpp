#include "app/study_figures.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <iterator>

namespace gnomon::app {

namespace {

namespace fs = std::filesystem;

/// Exit code of `python3 ARGUMENTS`; its output goes to `log`.
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

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The last line that a failed program printed.
std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  const std::size_t start = text.rfind('\n');
  if (text.empty()) return "they need Python 3 with Matplotlib (Debian: python3-matplotlib)";
  return start == std::string::npos ? text : text.substr(start + 1);
}

std::vector<fs::path> svg_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error))
    if (entry->path().extension() == ".svg") files.push_back(entry->path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

StudyFigures study_figures(const fs::path& folder, const std::string& kind) {
  const fs::path script = GNOMON_PLOT_SCRIPT, figures = folder / "figures";
  std::error_code error;
  if (!fs::exists(script, error))
    return {{}, "No figures: this build has no plotting script (tools/plot/gnomon_plot.py)."};
  fs::remove_all(figures, error);  // an earlier page's
  const fs::path log = folder / "figures.log";
  if (python({script.string(), kind, folder.string(), "--svg-out", figures.string()},
             log.string()) != 0)
    return {{},
            fmt::format("No figures: {} (then repeat the command with --resume).",
                        last_line(text_of(log)))};
  fs::remove(log, error);
  StudyFigures result;
  for (const fs::path& file : svg_files(figures)) result.svgs.push_back(text_of(file));
  if (result.svgs.empty()) result.note = "No figures: the plotting script made none.";
  return result;
}

}  // namespace gnomon::app
