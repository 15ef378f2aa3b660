// Parts of a Jacobian, chosen by the roles of its rows and columns.
#pragma once

#include <gnomon/fields/block.hpp>
#include <gnomon/system/system.hpp>
#include <initializer_list>
#include <span>
#include <vector>

namespace gnomon {

using Roles = std::initializer_list<Role>;

/// The unknowns of some roles, ascending.
std::vector<int> unknowns_of(const Structure& structure, Roles roles);

/// The entries of J in rows of some roles and columns of others. Vectors have the system's size.
/// Most of those of contact are zero: an interface declares all that may touch.
class JacobianBlock {
public:
  struct Entry {
    int row, column;
    double value;
  };
  JacobianBlock(const Structure& structure, Roles rows, Roles columns);

  void refresh(std::span<const double> J);
  /// Those that are not zero, of the last refresh().
  const std::vector<Entry>& entries() const { return entries_; }
  /// y -= J x over the block, of the last refresh().
  void subtract(std::span<const double> x, std::span<double> y) const;

private:
  struct Place {
    int row, column, position;
  };
  std::vector<Place> places_;
  std::vector<Entry> entries_;
};

/// The symmetric part of a diagonal block, numbered 0, 1, ... in ascending order of its unknowns.
class SymmetricPart {
public:
  /// `joined`: unknowns of the block that have entries with each other, beside those of `pattern`.
  SymmetricPart(const SparsePattern& pattern, const std::vector<int>& unknowns,
                const std::vector<std::vector<int>>& joined = {});

  const SparsePattern& lower() const { return lower_; }
  /// Drops the entries that another matrix of the same size lacks.
  void keep_common(const SparsePattern& lower);
  /// Number in the block of one of its unknowns.
  int number(int unknown) const { return number_[unknown]; }
  /// Position in `lower` of an entry in the system's numbers, or -1.
  int find(int row, int column) const;
  /// (J + J^T) / 2 on `lower`.
  void gather(std::span<const double> J, std::vector<double>& values) const;

private:
  std::vector<int> number_;  // of the system's unknowns in the block, -1: not in it
  SparsePattern lower_;
  std::vector<int> entry_, transposed_;  // positions in J, -1: structurally zero
};

/// y = J x.
void multiply(const SparsePattern& pattern, std::span<const double> J, std::span<const double> x,
              std::span<double> y);

}  // namespace gnomon
