// Columns aligned for a terminal.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace gnomon::app {

class TextTable {
public:
  /// `alignment`: for each column l (left) or r (right). Titles: one per column, or none.
  explicit TextTable(std::string alignment, const std::vector<std::string>& titles = {})
      : alignment_(std::move(alignment)) {
    if (!titles.empty()) add(titles);
  }
  /// One cell per column.
  void add(std::vector<std::string> cells) { lines_.push_back(std::move(cells)); }
  /// Titles and rows, two spaces between columns.
  std::string text() const;

private:
  std::string alignment_;
  std::vector<std::vector<std::string>> lines_;
};

}  // namespace gnomon::app
