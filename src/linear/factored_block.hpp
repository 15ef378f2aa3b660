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
    if (unknowns_.empty()) return;
    std::vector<int> number(structure.size, -1), group;
    for (int i : unknowns_) {
      number[i] = static_cast<int>(group.size());
      group.push_back(structure.group[i]);
    }
    SparsePattern block;
    for (int j : unknowns_) {
      block.column_start.push_back(static_cast<int>(source_.size()));
      for (int k = structure.pattern.column_start[j]; k < structure.pattern.column_start[j + 1];
           ++k)
        if (const int row = number[structure.pattern.row_index[k]]; row >= 0) {
          block.row_index.push_back(row);
          source_.push_back(k);
        }
    }
    block.column_start.push_back(static_cast<int>(source_.size()));
    values_.resize(source_.size());
    lu_ = std::make_unique<SparseLu>(block, group);
  }

  /// Throws RecoverableError when the block is singular or not finite.
  void factorize(std::span<const double> J) {
    for (std::size_t k = 0; k < source_.size(); ++k) values_[k] = J[source_[k]];
    if (lu_ && !lu_->factorize(values_)) throw RecoverableError("the worn surface is singular");
  }
  /// z = J^-1 s over the block.
  void solve(std::span<const double> s, std::span<double> z) {
    if (!lu_) return;
    for (std::size_t k = 0; k < b_.size(); ++k) b_[k] = s[unknowns_[k]];
    lu_->solve(b_, x_);
    for (std::size_t k = 0; k < x_.size(); ++k) z[unknowns_[k]] = x_[k];
  }

private:
  std::vector<int> unknowns_, source_;  // in the system; positions in J
  std::vector<double> values_, b_, x_;
  std::unique_ptr<SparseLu> lu_;
};

}  // namespace gnomon
