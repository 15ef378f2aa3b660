#include <algorithm>
#include <gnomon/fields/sparse_pattern.hpp>

namespace gnomon {

int SparsePattern::find(int row, int column) const {
  const auto first = row_index.begin() + column_start[column];
  const auto last = row_index.begin() + column_start[column + 1];
  const auto place = std::lower_bound(first, last, row);
  return place != last && *place == row ? static_cast<int>(place - row_index.begin()) : -1;
}

std::vector<int> SparsePattern::positions(const std::vector<int>& rows,
                                          const std::vector<int>& columns) const {
  std::vector<int> result;
  result.reserve(rows.size() * columns.size());
  for (int column : columns) {
    std::size_t next = 0;  // after the last place that was found: rows of dense blocks follow it
    for (int row : rows) {
      const bool none = row < 0 || column < 0;
      if (!none && next > 0 && static_cast<int>(next) < column_start[column + 1] &&
          row_index[next] == row)
        result.push_back(static_cast<int>(next));
      else
        result.push_back(none ? -1 : find(row, column));
      if (result.back() >= 0) next = static_cast<std::size_t>(result.back()) + 1;
    }
  }
  return result;
}

namespace {

/// Mostly rows are added to a list that is sorted, and often ascending ones.
void sort_unique(std::vector<int>& rows) {
  const auto added = std::is_sorted_until(rows.begin(), rows.end());
  if (!std::is_sorted(added, rows.end())) std::sort(added, rows.end());
  std::inplace_merge(rows.begin(), added, rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
}

}  // namespace

void PatternBuilder::add(const std::vector<int>& rows, const std::vector<int>& columns) {
  for (int column : columns) {
    if (column < 0) continue;
    std::vector<int>& collected = columns_[column];
    // Cells that share an edge give equal entries: duplicates are removed before more memory is
    // allocated.
    if (collected.size() + rows.size() > collected.capacity()) {
      sort_unique(collected);
      collected.reserve(2 * (collected.size() + rows.size()));
    }
    for (int row : rows)
      if (row >= 0) collected.push_back(row);
  }
}

SparsePattern PatternBuilder::build() {
  SparsePattern pattern;
  pattern.column_start.push_back(0);
  for (std::size_t j = 0; j < columns_.size(); ++j) {
    columns_[j].push_back(static_cast<int>(j));
    sort_unique(columns_[j]);
    pattern.column_start.push_back(pattern.column_start.back() +
                                   static_cast<int>(columns_[j].size()));
  }
  pattern.row_index.reserve(pattern.column_start.back());
  for (std::vector<int>& rows : columns_) {
    pattern.row_index.insert(pattern.row_index.end(), rows.begin(), rows.end());
    std::vector<int>().swap(rows);
  }
  return pattern;
}

}  // namespace gnomon
