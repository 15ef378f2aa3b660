// A small diagonal block of a Jacobian with its own LU factors.
#pragma once

#include <gnomon/base/error.hpp>
#include <gnomon/linear/jacobian_block.hpp>
#include <gnomon/linear/sparse_lu.hpp>
#include <memory>
#include <span>
#include <vector>

namespace gnomon {

/// The block of the unknowns with some roles; it may be empty. Vectors have the system's size.
class FactoredBlock {
public:
  FactoredBlock(const Structure& structure, Roles roles)
      : unknowns_(unknowns_of(structure, roles)), b_(unknowns_.size()), x_(unknowns_.size()) {
    std::vector<int> number(structure.size, -1);
    for (int i : unknowns_) {
      number[i] = static_cast<int>(group_.size());
      group_.push_back(structure.group[i]);
    }
    for (int j : unknowns_)
      for (int k = structure.pattern.column_start[j]; k < structure.pattern.column_start[j + 1];
           ++k)
        if (const int row = number[structure.pattern.row_index[k]]; row >= 0)
          entries_.push_back({row, number[j], k, row == number[j]});
  }

  /// Throws RecoverableError when the block is singular or not finite.
  void factorize(std::span<const double> J) {
    if (unknowns_.empty()) return;
    bool grown = !lu_;
    for (Entry& entry : entries_)
      if (!entry.used && J[entry.position] != 0) entry.used = grown = true;
    if (grown) analyse();
    values_.clear();
    for (const Entry& entry : entries_)
      if (entry.used) values_.push_back(J[entry.position]);
    if (!lu_->factorize(values_)) throw RecoverableError("the worn surface is singular");
  }
  /// z = J^-1 s over the block.
  void solve(std::span<const double> s, std::span<double> z) {
    if (!lu_) return;
    for (std::size_t k = 0; k < b_.size(); ++k) b_[k] = s[unknowns_[k]];
    lu_->solve(b_, x_);
    for (std::size_t k = 0; k < x_.size(); ++k) z[unknowns_[k]] = x_[k];
  }

private:
  struct Entry {
    int row, column, position;  ///< in the block; in J
    bool used;                  ///< has not always been zero
  };

  /// Of facets that may meet, few do: the factors have only what some Jacobian had.
  void analyse() {
    SparsePattern pattern;
    for (const Entry& entry : entries_) {
      if (!entry.used) continue;
      while (static_cast<int>(pattern.column_start.size()) <= entry.column)
        pattern.column_start.push_back(static_cast<int>(pattern.row_index.size()));
      pattern.row_index.push_back(entry.row);
    }
    pattern.column_start.push_back(static_cast<int>(pattern.row_index.size()));
    lu_ = std::make_unique<SparseLu>(pattern, group_);
  }

  std::vector<int> unknowns_, group_;
  std::vector<Entry> entries_;  // column by column
  std::vector<double> values_, b_, x_;
  std::unique_ptr<SparseLu> lu_;
};

}  // namespace gnomon
