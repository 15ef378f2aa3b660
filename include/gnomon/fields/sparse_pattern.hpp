// The sparsity pattern of a square matrix, compressed by columns.
#pragma once

#include <cstddef>
#include <vector>

namespace gnomon {

/// Column j holds rows row_index[column_start[j]] ... row_index[column_start[j+1]-1], ascending.
struct SparsePattern {
  std::vector<int> column_start;  ///< size + 1 entries
  std::vector<int> row_index;     ///< one for each structural nonzero

  int size() const { return column_start.empty() ? 0 : static_cast<int>(column_start.size()) - 1; }
  long nonzeros() const { return static_cast<long>(row_index.size()); }
  /// Position of entry (row, column) in the values, or -1 where it is structurally zero.
  int find(int row, int column) const;
  /// find() of rows x columns, column by column; -1 also where a number is negative.
  std::vector<int> positions(const std::vector<int>& rows, const std::vector<int>& columns) const;
};

/// Collects cliques (rows x columns) and makes the pattern of their union with the diagonal.
class PatternBuilder {
public:
  explicit PatternBuilder(int size) : size_(size) {}
  /// Adds rows x columns; negative numbers (fixed values) are skipped.
  void add(const std::vector<int>& rows, const std::vector<int>& columns);
  SparsePattern build() const;

private:
  int size_;
  std::vector<int> numbers_;         // of the cliques, one after the other: rows, then columns
  std::vector<std::size_t> starts_;  // in numbers_: of the rows and of the columns of each clique
};

}  // namespace gnomon
