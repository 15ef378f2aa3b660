#include "app/study_page.hpp"

#include <fmt/format.h>

#include "app/plotting_script.hpp"

namespace gnomon::app {

namespace fs = std::filesystem;

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
  return drawn;
}

}  // namespace gnomon::app
