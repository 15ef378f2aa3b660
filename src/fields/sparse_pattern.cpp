#include <algorithm>
#include <gnomon/fields/sparse_pattern.hpp>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>

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

void PatternBuilder::add(const std::vector<int>& rows, const std::vector<int>& columns) {
  for (const std::vector<int>* side : {&rows, &columns}) {
    starts_.push_back(numbers_.size());
    std::ranges::copy_if(*side, std::back_inserter(numbers_), [](int n) { return n >= 0; });
  }
}

namespace {

/// Every entry of the union of cliques with the diagonal once, row by row, columns in any order.
class UnionOfCliques {
public:
  UnionOfCliques(int size, std::span<const int> numbers, std::span<const std::size_t> starts)
      : numbers_(numbers), starts_(starts), first_(static_cast<std::size_t>(size) + 1) {
    for_rows([this](std::size_t, int row) { ++first_[static_cast<std::size_t>(row) + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    cliques_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for_rows([&](std::size_t clique, int row) {
      cliques_[next[static_cast<std::size_t>(row)]++] = clique;
    });
  }

  template <class Visit>
  void for_entries(const Visit& visit) const {
    const int size = static_cast<int>(first_.size()) - 1;
    std::vector<int> last(static_cast<std::size_t>(size), -1);  // row in which a column was seen
    for (int row = 0; row < size; ++row) {
      const auto once = [&](int column) {
        if (std::exchange(last[static_cast<std::size_t>(column)], row) != row) visit(row, column);
      };
      once(row);
      for (std::size_t k = first_[static_cast<std::size_t>(row)];
           k < first_[static_cast<std::size_t>(row) + 1]; ++k)
        std::ranges::for_each(side(2 * cliques_[k] + 1), once);
    }
  }

private:
  std::span<const int> side(std::size_t s) const {
    const std::size_t end = s + 1 < starts_.size() ? starts_[s + 1] : numbers_.size();
    return numbers_.subspan(starts_[s], end - starts_[s]);
  }
  template <class Visit>
  void for_rows(const Visit& visit) const {
    for (std::size_t clique = 0; clique < starts_.size() / 2; ++clique)
      for (const int row : side(2 * clique)) visit(clique, row);
  }

  std::span<const int> numbers_;
  std::span<const std::size_t> starts_;
  std::vector<std::size_t> first_, cliques_;  // those of row i: cliques_[first_[i]] ...
};

}  // namespace

SparsePattern PatternBuilder::build() const {
  const UnionOfCliques entries(size_, numbers_, starts_);
  SparsePattern pattern;
  std::vector<int>& start = pattern.column_start;
  start.assign(static_cast<std::size_t>(size_) + 1, 0);
  entries.for_entries([&](int, int column) { ++start[static_cast<std::size_t>(column) + 1]; });
  std::partial_sum(start.begin(), start.end(), start.begin());
  pattern.row_index.resize(static_cast<std::size_t>(start.back()));
  std::vector<int> next(start.begin(), start.end() - 1);
  entries.for_entries([&](int row, int column) {  // rows ascend, and so they do in each column
    pattern.row_index[static_cast<std::size_t>(next[static_cast<std::size_t>(column)]++)] = row;
  });
  return pattern;
}

}  // namespace gnomon
