// Runs the drawing program, which is Python (tools/plot), for commands that draw on their way, and
// for the page of a study or of extremes with its figures.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace gnomon::app {

/// Debian's packages that it needs.
inline constexpr const char* drawing_packages = "python3-matplotlib python3-h5py python3-jinja2";

/// How the script ended; `complaint`: why, if its exit code is not zero.
struct ScriptEnd {
  int exit_code = 0;      ///< negative: it has none
  std::string complaint;  ///< one line, without the name of the program
  std::string printed;    ///< all of it
};

/// The script, gnomon_plot.py. Throws Error if it is not installed.
std::filesystem::path plotting_script();

/// Waits for it. What it prints goes to the file `log`, which stays only after a failure.
ScriptEnd run_plotting_script(const std::vector<std::string>& arguments,
                              const std::filesystem::path& log);

struct DrawnPage {
  bool exists = false;
  /// A line that says what could not be drawn, why, and how to draw it later; empty if nothing.
  std::string complaint;

  /// The page in a list of files.
  const char* listed() const { return exists ? "index.html, " : ""; }
};

/// Draws the page of a folder that holds KIND.csv and KIND.json: "study", "extremes". A page that
/// cannot be drawn is not an error.
DrawnPage draw_page(const std::filesystem::path& folder, const std::string& kind);

}  // namespace gnomon::app
