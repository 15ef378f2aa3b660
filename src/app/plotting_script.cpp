#include "app/plotting_script.hpp"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <gnomon/base/error.hpp>
#include <gnomon/base/installation.hpp>
#include <sstream>

#include "study/process_pool.hpp"

namespace gnomon::app {

namespace fs = std::filesystem;

namespace {

/// Why a program failed that printed nothing.
std::string why_silent(const study::Captured& end) {
  if (end.signal != 0)
    return fmt::format("drawing was ended by signal {} ({})", end.signal, strsignal(end.signal));
  if (end.exit_code == 127)
    return fmt::format("drawing needs Python 3 and the packages {}", drawing_packages);
  return fmt::format("the drawing program ended with exit code {} and no message", end.exit_code);
}

/// The last line that a failed program printed, without the name of the program before it.
std::string last_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::string line = text.substr(text.rfind('\n') + 1);  // npos + 1 is zero
  if (const std::string name = "gnomon: "; line.starts_with(name)) line.erase(0, name.size());
  return line;
}

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

std::filesystem::path plotting_script() {
  return installed("share/gnomon/plot/gnomon_plot.py");
}

ScriptEnd run_plotting_script(const std::vector<std::string>& arguments,
                              const std::filesystem::path& log) try {
  std::vector<std::string> words = {"python3", plotting_script().string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const study::Captured captured = study::run_captured(words);
  ScriptEnd end{captured.exit_code, {}, captured.out + captured.err};
  std::error_code error;
  std::filesystem::remove(log, error);
  if (end.exit_code == 0) return end;
  std::ofstream(log, std::ios::binary) << end.printed;
  end.complaint = last_line(end.printed);
  if (end.complaint.empty() || end.exit_code < 0) end.complaint = why_silent(captured);
  return end;
} catch (const Error& error) {
  return {.exit_code = 1, .complaint = error.what(), .printed = {}};
}

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
