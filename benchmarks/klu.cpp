#include "klu.hpp"

#include <algorithm>
#include <gnomon/base/error.hpp>

namespace gnomon::bench {

namespace {

/// KLU reads its values through a pointer to non-const, but does not change them.
double* untouched(std::span<const double> values) {
  return const_cast<double*>(values.data());
}

}  // namespace

Klu::Klu(const SparsePattern& pattern, const std::vector<int>& order) : pattern_(pattern) {
  klu_defaults(&common_);
  // One block, so that the given order is used. This is no disadvantage: the Jacobian of the pin is
  // irreducible, and with the search for blocks KLU does the same operations.
  common_.btf = 0;
  std::vector<int> rows = order, columns = order;
  symbolic_ = klu_analyze_given(pattern_.size(), pattern_.column_start.data(),
                                pattern_.row_index.data(), rows.data(), columns.data(), &common_);
  if (!symbolic_) throw Error("KLU could not analyse the matrix");
}

Klu::~Klu() {
  klu_free_numeric(&numeric_, &common_);
  klu_free_symbolic(&symbolic_, &common_);
}

bool Klu::factorize(std::span<const double> values) {
  klu_free_numeric(&numeric_, &common_);
  numeric_ = klu_factor(pattern_.column_start.data(), pattern_.row_index.data(), untouched(values),
                        symbolic_, &common_);
  return numeric_ != nullptr;
}

bool Klu::refactorize(std::span<const double> values) {
  return klu_refactor(pattern_.column_start.data(), pattern_.row_index.data(), untouched(values),
                      symbolic_, numeric_, &common_) != 0;
}

void Klu::solve(std::span<const double> b, std::span<double> x) {
  std::copy(b.begin(), b.end(), x.begin());
  klu_solve(symbolic_, numeric_, pattern_.size(), 1, x.data(), &common_);
}

double Klu::factor_flops() {
  klu_flops(symbolic_, numeric_, &common_);
  return common_.flops;
}

}  // namespace gnomon::bench
