// A small diagonal block of a Jacobian with its own LU factors.
#pragma once

#include <gnomon/linear/jacobian_block.hpp>
#include <gnomon/linear/sparse_lu.hpp>
#include <memory>
#include <span>
#include <vector>

namespace gnomon {

/// The block of the unknowns with some roles; it may be empty. Vectors have the system's size.
class FactoredBlock {
public:
  FactoredBlock(const Structure& structure, Roles roles);

  /// Throws RecoverableError when the block is singular or not finite.
  void factorize(std::span<const double> J);
  /// z = J^-1 s over the block.
  void solve(std::span<const double> s, std::span<double> z);

private:
  std::vector<int> unknowns_, source_;  // in the system; positions in J
  std::vector<double> values_, b_, x_;
  std::unique_ptr<SparseLu> lu_;
};

}  // namespace gnomon
