#include <cmath>
#include <gnomon/stability/stability.hpp>
#include <limits>

namespace gnomon {

namespace {
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-12;  // by which |R| may exceed one: R(0) = 1 exactly
constexpr double slow = 0.01;       // fraction of the fastest mode
}  // namespace

std::complex<double> stability_function(const ButcherTable& table, std::complex<double> z) {
  std::vector<std::complex<double>> stages;
  std::complex<double> R = 1;
  for (int i = 0; i < table.stages(); ++i) {
    std::complex<double> before = 1;
    for (int j = 0; j < i; ++j) before += z * table.A(i, j) * stages[j];
    R += z * table.b[i] * stages.emplace_back(before / (1.0 - z * table.A(i, i)));
  }
  return R;
}

double stability_boundary(const ButcherTable& table, double angle) {
  constexpr double stride = 0.01;
  const auto stable = [&](double r) {
    return std::abs(stability_function(table, std::polar(r, angle))) <= 1 + rounding;
  };
  const double reach = 2.0 * table.stages() * table.stages() + stride;
  double inside = 0;
  while (stable(inside + stride)) {
    inside += stride;
    if (inside > reach) return infinite;
  }
  double outside = inside + stride;
  while (outside - inside > 1e-12 * reach) {
    const double middle = (inside + outside) / 2;
    (stable(middle) ? inside : outside) = middle;
  }
  // Along the imaginary axis |R| may exceed one as slowly as 1 + y^4 / 8, at first by less than
  // rounding errors.
  return inside < 2 * std::pow(rounding, 0.25) ? 0 : inside;
}

CriticalStep critical_step(const ButcherTable& table, std::span<const Mode> modes) {
  double largest = 0;
  for (const Mode& mode : modes) largest = std::max(largest, std::abs(mode.eigenvalue));
  CriticalStep critical{infinite, -1};
  for (std::size_t k = 0; k < modes.size(); ++k) {
    const std::complex<double> eigenvalue = modes[k].eigenvalue;
    if (eigenvalue.real() > rounding * largest || std::abs(eigenvalue) <= slow * largest) continue;
    const double step = stability_boundary(table, std::arg(eigenvalue)) / std::abs(eigenvalue);
    if (step < critical.step) critical = {step, static_cast<int>(k)};
  }
  return critical;
}

}  // namespace gnomon
