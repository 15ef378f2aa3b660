#include "linear/factored_block.hpp"

#include <gnomon/base/error.hpp>

namespace gnomon {

FactoredBlock::FactoredBlock(const Structure& structure, Roles roles)
    : unknowns_(unknowns_of(structure, roles)), b_(unknowns_.size()), x_(unknowns_.size()) {
  if (unknowns_.empty()) return;
  std::vector<int> number(structure.size, -1), group;
  for (int i : unknowns_) {
    number[i] = static_cast<int>(group.size());
    group.push_back(structure.group[i]);
  }
  SparsePattern block;
  for (int j : unknowns_) {
    block.column_start.push_back(static_cast<int>(source_.size()));
    for (int k = structure.pattern.column_start[j]; k < structure.pattern.column_start[j + 1]; ++k)
      if (const int row = number[structure.pattern.row_index[k]]; row >= 0) {
        block.row_index.push_back(row);
        source_.push_back(k);
      }
  }
  block.column_start.push_back(static_cast<int>(source_.size()));
  values_.resize(source_.size());
  lu_ = std::make_unique<SparseLu>(block, group);
}

void FactoredBlock::factorize(std::span<const double> J) {
  for (std::size_t k = 0; k < source_.size(); ++k) values_[k] = J[source_[k]];
  if (lu_ && !lu_->factorize(values_)) throw RecoverableError("the worn surface is singular");
}

void FactoredBlock::solve(std::span<const double> s, std::span<double> z) {
  if (!lu_) return;
  for (std::size_t k = 0; k < b_.size(); ++k) b_[k] = s[unknowns_[k]];
  lu_->solve(b_, x_);
  for (std::size_t k = 0; k < x_.size(); ++k) z[unknowns_[k]] = x_[k];
}

}  // namespace gnomon
