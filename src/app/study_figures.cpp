#include "app/study_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "app/plotting_script.hpp"

namespace gnomon::app {

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
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
  const fs::path figures = folder / "figures";
  std::error_code error;
  fs::remove_all(figures, error);  // an earlier page's
  const ScriptEnd end = run_plotting_script({kind, folder.string(), "--svg-out", figures.string()},
                                            folder / "figures.log");
  if (end.exit_code != 0)
    return {{},
            fmt::format("No figures: {} (then repeat the command with --resume).", end.complaint)};
  StudyFigures result;
  for (const fs::path& file : svg_files(figures)) result.svgs.push_back(text_of(file));
  if (result.svgs.empty()) result.note = "No figures: the plotting script made none.";
  return result;
}

}  // namespace gnomon::app
