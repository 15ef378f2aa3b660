// The page of a study or of extremes with its figures, drawn by the plotting script (tools/plot) if
// this machine can run it.
#pragma once

#include <filesystem>
#include <string>

namespace gnomon::app {

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
