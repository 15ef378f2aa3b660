#include <algorithm>
#include <gnomon/linear/jacobian_block.hpp>
#include <utility>

namespace gnomon {

namespace {

std::vector<char> marked(const Structure& structure, Roles roles) {
  std::vector<char> mark(structure.block.size());
  for (std::size_t i = 0; i < mark.size(); ++i)
    mark[i] = std::find(roles.begin(), roles.end(), structure.block_of(i).role) != roles.end();
  return mark;
}

}  // namespace

std::vector<int> unknowns_of(const Structure& structure, Roles roles) {
  const std::vector<char> mark = marked(structure, roles);
  std::vector<int> result;
  for (std::size_t i = 0; i < mark.size(); ++i)
    if (mark[i]) result.push_back(static_cast<int>(i));
  return result;
}

JacobianBlock::JacobianBlock(const Structure& structure, Roles rows, Roles columns) {
  const std::vector<char> row = marked(structure, rows), column = marked(structure, columns);
  const SparsePattern& pattern = structure.pattern;
  for (int j = 0; j < static_cast<int>(column.size()); ++j) {
    if (!column[j]) continue;
    for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
      if (const int i = pattern.row_index[k]; row[i]) places_.push_back({i, j, k});
  }
}

void JacobianBlock::refresh(std::span<const double> J) {
  entries_.clear();
  for (const Place& of : places_)
    if (J[of.position] != 0) entries_.push_back({of.row, of.column, J[of.position]});
}

void JacobianBlock::subtract(std::span<const double> x, std::span<double> y) const {
  for (const Entry& entry : entries_) y[entry.row] -= entry.value * x[entry.column];
}

SymmetricPart::SymmetricPart(const SparsePattern& pattern, const std::vector<int>& unknowns,
                             const std::vector<std::vector<int>>& joined)
    : number_(pattern.size(), -1) {
  for (std::size_t k = 0; k < unknowns.size(); ++k) number_[unknowns[k]] = static_cast<int>(k);
  PatternBuilder lower(static_cast<int>(unknowns.size()));
  const auto add = [&](int column, std::span<const int> rows) {
    std::vector<int> below, above;
    for (const int row : rows)
      if (number_[row] >= 0)
        (number_[row] >= number_[column] ? below : above).push_back(number_[row]);
    lower.add(below, {number_[column]});
    lower.add({number_[column]}, above);
  };
  const std::span<const int> rows = pattern.row_index;
  for (int j : unknowns)
    add(j, rows.subspan(pattern.column_start[j],
                        pattern.column_start[j + 1] - pattern.column_start[j]));
  for (std::vector<int> clique : joined) {
    std::ranges::sort(clique);
    for (std::size_t j = 0; j < clique.size(); ++j) {
      const auto first = clique.begin() + std::ptrdiff_t(j);
      std::vector<int> below;
      std::transform(first, clique.end(), std::back_inserter(below),
                     [&](int unknown) { return number_[unknown]; });
      lower.add(below, {number_[*first]});
    }
  }
  lower_ = lower.build();
  // Unknowns ascend, so that each column of J is met in the order of its rows.
  std::vector<int> next = pattern.column_start;
  const auto position = [&](int row, int column) {
    int& k = next[column];
    while (k < pattern.column_start[column + 1] && rows[k] < row) ++k;
    return k < pattern.column_start[column + 1] && rows[k] == row ? k : -1;
  };
  for (int column = 0; column < lower_.size(); ++column)
    for (int k = lower_.column_start[column]; k < lower_.column_start[column + 1]; ++k) {
      const int i = unknowns[lower_.row_index[k]], j = unknowns[column];
      entry_.push_back(position(i, j));
      transposed_.push_back(position(j, i));
    }
}

int SymmetricPart::find(int row, int column) const {
  const int i = number_[row], j = number_[column];
  return lower_.find(std::max(i, j), std::min(i, j));
}

void SymmetricPart::keep_common(const SparsePattern& lower) {
  if (lower.row_index == lower_.row_index && lower.column_start == lower_.column_start) return;
  SparsePattern common{.column_start = {0}, .row_index = {}};
  std::vector<int> entry, transposed;
  for (int column = 0; column < lower_.size(); ++column) {
    for (int k = lower_.column_start[column]; k < lower_.column_start[column + 1]; ++k) {
      if (lower.find(lower_.row_index[k], column) < 0) continue;
      common.row_index.push_back(lower_.row_index[k]);
      entry.push_back(entry_[k]);
      transposed.push_back(transposed_[k]);
    }
    common.column_start.push_back(static_cast<int>(common.row_index.size()));
  }
  lower_ = std::move(common);
  entry_ = std::move(entry);
  transposed_ = std::move(transposed);
}

void SymmetricPart::gather(std::span<const double> J, std::vector<double>& values) const {
  values.resize(entry_.size());
  const auto at = [J](int position) { return position < 0 ? 0.0 : J[position]; };
  for (std::size_t k = 0; k < values.size(); ++k)
    values[k] = (at(entry_[k]) + at(transposed_[k])) / 2;
}

void multiply(const SparsePattern& pattern, std::span<const double> J, std::span<const double> x,
              std::span<double> y) {
  std::fill(y.begin(), y.end(), 0.0);
  for (int j = 0; j < pattern.size(); ++j) {
    const double factor = x[j];
    for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
      y[pattern.row_index[k]] += J[k] * factor;
  }
}

}  // namespace gnomon
