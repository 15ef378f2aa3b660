// Columns aligned for a terminal.
#pragma once

#include <string>
#include <vector>

namespace gnomon::app {

class TextTable {
public:
  enum class Align { left, right };
  struct Column {
    std::string title{};
    Align align = Align::left;
  };

  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}
  /// One cell per column.
  void add(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }
  /// Title line (unless all titles are empty) and rows, two spaces between columns.
  std::string text() const;

private:
  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace gnomon::app
