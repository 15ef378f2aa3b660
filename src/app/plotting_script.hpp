// Runs the drawing program, which is Python (tools/plot), for commands that draw on their way.
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

}  // namespace gnomon::app
