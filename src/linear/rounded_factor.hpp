// Supernodal Cholesky factors in single precision.
#pragma once

#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

extern "C" {
void strsv_(const char* uplo, const char* trans, const char* diag, const int* n, const float* a,
            const int* lda, float* x, const int* incx);
void sgemv_(const char* trans, const int* m, const int* n, const float* alpha, const float* a,
            const int* lda, const float* x, const int* incx, const float* beta, float* y,
            const int* incy);
}

namespace gnomon {

/// The time of a solve is that of reading the factors twice, so half the bytes need half the time.
/// Rounding them changes the matrix by about 1e-7 of its largest entries; the outer iteration
/// corrects this. Factors and right sides are scaled into the range of single precision.
class RoundedFactor {
public:
  /// Copies a numeric supernodal factor, L L^T = P K P^T, whose pattern and permutation must
  /// outlive this object.
  void copy(const cholmod_factor& factor) {
    factor_ = &factor;
    const std::span<const double> values(static_cast<const double*>(factor.x), factor.xsize);
    double largest = 0;  // of the diagonal
    for (int s = 0; s < static_cast<int>(factor.nsuper); ++s) {
      const Supernode supernode(factor, s);
      for (int j = 0; j < supernode.columns; ++j)
        largest = std::max(largest, values[supernode.start + j * (supernode.rows + 1L)]);
    }
    unit_ = 1 / largest;
    values_.resize(values.size());
    std::transform(values.begin(), values.end(), values_.begin(),
                   [this](double value) { return static_cast<float>(unit_ * value); });
    x_.resize(factor.n);
    below_.resize(factor.maxesize);
  }

  bool empty() const { return values_.empty(); }
  /// x = approximately K^-1 b.
  void solve(std::span<const double> b, std::span<double> x) {
    const auto* permutation = static_cast<const SuiteSparse_long*>(factor_->Perm);
    double largest = 0;
    for (double value : b) largest = std::max(largest, std::abs(value));
    const double scale = largest > 0 ? largest : 1;
    for (std::size_t k = 0; k < x_.size(); ++k)
      x_[k] = static_cast<float>(b[permutation[k]] / scale);
    const int supernodes = static_cast<int>(factor_->nsuper);
    for (int s = 0; s < supernodes; ++s) forward(s);
    for (int s = supernodes; s-- > 0;) backward(s);
    for (std::size_t k = 0; k < x_.size(); ++k)
      x[permutation[k]] = scale * unit_ * unit_ * double(x_[k]);
  }

private:
  static constexpr int one = 1;

  /// Neighbouring columns with the same rows: a dense triangle and the rows below it.
  struct Supernode {
    long first;                   // column
    int columns, rows, below;     // rows: of the triangle and below
    const SuiteSparse_long* row;  // of those below
    long start;                   // of its values, column by column

    Supernode(const cholmod_factor& factor, int s) {
      const auto* super = static_cast<const SuiteSparse_long*>(factor.super);
      const auto* pi = static_cast<const SuiteSparse_long*>(factor.pi);
      first = super[s];
      columns = static_cast<int>(super[s + 1] - super[s]);
      rows = static_cast<int>(pi[s + 1] - pi[s]);
      below = rows - columns;
      row = static_cast<const SuiteSparse_long*>(factor.s) + pi[s] + columns;
      start = static_cast<const SuiteSparse_long*>(factor.px)[s];
    }
  };
  void forward(int supernode) {
    const Supernode s(*factor_, supernode);
    const float *L = values_.data() + s.start, unit = 1, zero = 0;
    float* x = x_.data() + s.first;
    strsv_("L", "N", "N", &s.columns, L, &s.rows, x, &one);
    if (s.below == 0) return;
    sgemv_("N", &s.below, &s.columns, &unit, L + s.columns, &s.rows, x, &one, &zero, below_.data(),
           &one);
    for (int i = 0; i < s.below; ++i) x_[s.row[i]] -= below_[i];
  }

  void backward(int supernode) {
    const Supernode s(*factor_, supernode);
    const float *L = values_.data() + s.start, minus = -1, unit = 1;
    float* x = x_.data() + s.first;
    if (s.below > 0) {
      for (int i = 0; i < s.below; ++i) below_[i] = x_[s.row[i]];
      sgemv_("T", &s.below, &s.columns, &minus, L + s.columns, &s.rows, below_.data(), &one, &unit,
             x, &one);
    }
    strsv_("L", "T", "N", &s.columns, L, &s.rows, x, &one);
  }

  const cholmod_factor* factor_ = nullptr;
  double unit_ = 1;  // factor by which values_ are larger than those of the factor
  std::vector<float> values_;
  std::vector<float> x_, below_;  // permuted; of the rows below a supernode's own
};

}  // namespace gnomon
