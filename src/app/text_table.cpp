#include "app/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::app {

std::string TextTable::text() const {
  std::vector<std::string> titles;
  for (const Column& column : columns_) titles.push_back(column.title);
  std::vector<std::vector<std::string>> lines = rows_;
  const bool titled =
      std::any_of(titles.begin(), titles.end(), [](const auto& title) { return !title.empty(); });
  if (titled) lines.insert(lines.begin(), titles);

  std::vector<std::size_t> widths(columns_.size(), 0);
  for (const auto& line : lines)
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());

  std::string text;
  for (const auto& line : lines) {
    std::string row;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const bool left = columns_[i].align == Align::left;
      row += (i ? "  " : "") + (left ? fmt::format("{:<{}}", line[i], widths[i])
                                     : fmt::format("{:>{}}", line[i], widths[i]));
    }
    text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace gnomon::app
