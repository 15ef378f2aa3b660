#include "app/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gnomon::app {

std::string TextTable::text() const {
  std::vector<std::size_t> widths(alignment_.size(), 0);
  for (const auto& line : lines_)
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], line[i].size());

  std::string text;
  for (const auto& line : lines_) {
    std::string row;
    for (std::size_t i = 0; i < line.size(); ++i)
      row += (i ? "  " : "") + (alignment_[i] == 'l' ? fmt::format("{:<{}}", line[i], widths[i])
                                                     : fmt::format("{:>{}}", line[i], widths[i]));
    text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace gnomon::app
