#include "app/study_page.hpp"

#include <fmt/format.h>

#include <sstream>

#include "app/plotting_script.hpp"

namespace gnomon::app {

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
