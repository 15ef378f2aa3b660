// From the rows and columns that terms see to those of the unknowns, where numbers are multiples of
// unknowns: with y_all = T y, F = T^T F_all and J = T^T J_all T. A row of T has one entry.
#pragma once

#include <gnomon/fields/numbering.hpp>
#include <gnomon/fields/sparse_pattern.hpp>
#include <span>
#include <vector>

namespace gnomon {

class ReducedEntries {
public:
  /// `all`: of rows and columns by all numbers.
  ReducedEntries(const Numbering& numbering, SparsePattern all);

  /// Of the rows and columns of all numbers.
  const SparsePattern& all() const { return all_; }
  /// Of those of the unknowns.
  const SparsePattern& pattern() const { return pattern_; }
  /// Overwrites F by the sums of the rows of all numbers.
  void add_rows(std::span<const double> all, std::span<double> F) const;
  /// Overwrites the values on pattern() by the sums of those on all().
  void add_entries(std::span<const double> all, std::span<double> values) const;

private:
  struct Entry {
    int position;
    double factor;
  };
  std::vector<Numbering::Multiple> rows_;
  SparsePattern all_, pattern_;
  std::vector<Entry> entries_;  // for each on all()
};

}  // namespace gnomon
