#include <algorithm>
#include <gnomon/sparse.hpp>

namespace gnomon {

int SparsePattern::find(int row, int column) const {
  const auto first = row_index.begin() + column_start[column];
  const auto last = row_index.begin() + column_start[column + 1];
  const auto place = std::lower_bound(first, last, row);
  return place != last && *place == row ? static_cast<int>(place - row_index.begin()) : -1;
}

void PatternBuilder::add(const std::vector<int>& rows, const std::vector<int>& columns) {
  for (int column : columns) {
    if (column < 0) continue;
    for (int row : rows)
      if (row >= 0) columns_[column].push_back(row);
  }
}

SparsePattern PatternBuilder::build() {
  SparsePattern pattern;
  pattern.column_start.push_back(0);
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    std::vector<int>& rows = columns_[j];
    rows.push_back(static_cast<int>(j));
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    pattern.row_index.insert(pattern.row_index.end(), rows.begin(), rows.end());
    pattern.column_start.push_back(static_cast<int>(pattern.row_index.size()));
    std::vector<int>().swap(rows);
  }
  return pattern;
}

}  // namespace gnomon
