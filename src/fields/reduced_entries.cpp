#include <algorithm>
#include <gnomon/fields/reduced_entries.hpp>
#include <utility>

namespace gnomon {

ReducedEntries::ReducedEntries(const Numbering& numbering, SparsePattern all)
    : all_(std::move(all)) {
  for (int number = 0; number < all_.size(); ++number) rows_.push_back(numbering.meaning(number));
  PatternBuilder builder(numbering.size());
  std::vector<int> rows;
  for (int column = 0; column < all_.size(); ++column) {
    rows.clear();
    for (int k = all_.column_start[column]; k < all_.column_start[column + 1]; ++k)
      rows.push_back(rows_[all_.row_index[k]].unknown);
    builder.add(rows, {rows_[column].unknown});
  }
  pattern_ = builder.build();
  for (int column = 0; column < all_.size(); ++column)
    for (int k = all_.column_start[column]; k < all_.column_start[column + 1]; ++k) {
      const auto &row = rows_[all_.row_index[k]], &of = rows_[column];
      entries_.push_back({pattern_.find(row.unknown, of.unknown), row.factor * of.factor});
    }
}

void ReducedEntries::add_rows(std::span<const double> all, std::span<double> F) const {
  std::ranges::fill(F, 0.0);
  for (std::size_t k = 0; k < rows_.size(); ++k) F[rows_[k].unknown] += rows_[k].factor * all[k];
}

void ReducedEntries::add_entries(std::span<const double> all, std::span<double> values) const {
  std::ranges::fill(values, 0.0);
  for (std::size_t k = 0; k < entries_.size(); ++k)
    values[entries_[k].position] += entries_[k].factor * all[k];
}

}  // namespace gnomon
