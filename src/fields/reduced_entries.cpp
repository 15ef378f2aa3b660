#include <algorithm>
#include <gnomon/fields/reduced_entries.hpp>
#include <utility>

namespace gnomon {

ReducedEntries::ReducedEntries(const Numbering& numbering, SparsePattern all)
    : all_(std::move(all)) {
  for (int number = 0; number < all_.size(); ++number) rows_.push_back(numbering.meaning(number));
  const auto for_entries = [this](const auto& visit) {
    for (int column = 0; column < all_.size(); ++column)
      for (int k = all_.column_start[column]; k < all_.column_start[column + 1]; ++k)
        visit(rows_[all_.row_index[k]], rows_[column]);
  };
  PatternBuilder builder(numbering.size());
  for_entries(
      [&](const auto& row, const auto& column) { builder.add({row.unknown}, {column.unknown}); });
  pattern_ = builder.build();
  for_entries([&](const auto& row, const auto& column) {
    entries_.push_back({pattern_.find(row.unknown, column.unknown), row.factor * column.factor});
  });
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
