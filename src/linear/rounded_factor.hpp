// Supernodal Cholesky factors in single precision.
#pragma once

#include <cholmod.h>

#include <span>
#include <vector>

namespace gnomon {

/// The time of a solve is that of reading the factors twice, so half the bytes need half the time.
/// Rounding them changes the matrix by about 1e-7 of its largest entries; the outer iteration
/// corrects this. Factors and right sides are scaled into the range of single precision.
class RoundedFactor {
public:
  /// Copies a numeric supernodal factor, L L^T = P K P^T, whose pattern and permutation must
  /// outlive this object.
  void copy(const cholmod_factor& factor);
  bool empty() const { return values_.empty(); }
  /// x = approximately K^-1 b.
  void solve(std::span<const double> b, std::span<double> x);

private:
  void forward(int supernode);
  void backward(int supernode);

  const cholmod_factor* factor_ = nullptr;
  double unit_ = 1;  // factor by which values_ are larger than those of the factor
  std::vector<float> values_;
  std::vector<float> x_, below_;  // permuted; of the rows below a supernode's own
};

}  // namespace gnomon
