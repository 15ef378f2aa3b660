// Supernodal Cholesky factors in single precision.
#pragma once

#include <cholmod.h>

#include <span>
#include <vector>

namespace gnomon {

/// A solve reads the factors twice and waits for nothing else, so half the bytes are half the time.
/// Rounding them changes the matrix by some 1e-7 of its largest entries, which an outer iteration
/// makes up for. Factors and right sides are scaled into the range of single precision.
class RoundedFactor {
public:
  /// Of a numeric supernodal factor L L^T, P K P^T. Its pattern and permutation must outlive this.
  void copy(const cholmod_factor& factor);
  bool empty() const { return values_.empty(); }
  /// x = approximately K^-1 b.
  void solve(std::span<const double> b, std::span<double> x);

private:
  void forward(int supernode);
  void backward(int supernode);

  const cholmod_factor* factor_ = nullptr;
  double unit_ = 1;  // values_ are so many times those of the factor
  std::vector<float> values_;
  std::vector<float> x_, below_;  // permuted; of the rows below a supernode's own
};

}  // namespace gnomon
