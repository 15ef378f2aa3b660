#include <algorithm>
#include <cmath>
#include <utility>

#include "model/wear_start.hpp"

namespace gnomon {

namespace {

/// The last two equilibria of the ramp.
class LoadPath {
public:
  LoadPath(double begin, std::vector<double> y) : reached_(begin), last_(std::move(y)) {}

  double reached() const { return reached_; }
  const std::vector<double>& last() const { return last_; }

  /// The guess at `target`, on the secant once there is one.
  void predict(double target, std::vector<double>& guess) const {
    guess = last_;
    if (before_.empty()) return;
    const double ratio = (target - reached_) / increment_;
    for (std::size_t i = 0; i < guess.size(); ++i) guess[i] += ratio * (last_[i] - before_[i]);
  }

  void append(double target, std::vector<double>& y) {
    std::swap(before_, last_);
    std::swap(last_, y);
    increment_ = target - reached_;
    reached_ = target;
  }

private:
  double reached_, increment_ = 0;
  std::vector<double> last_, before_;
};

/// The end of an increment, chosen so that the rest of the load is zero or at least as large as the
/// increment.
double target_of(double reached, double increment) {
  const double rest = 1 - reached;
  if (increment >= rest * (1 - 1e-9)) return 1;
  return reached + std::min(increment, rest / 2);
}

double growth(int iterations, const RampOptions& options) {
  return std::clamp(std::sqrt(double(options.good_iterations) / std::max(1, iterations)), 0.5, 1.5);
}

}  // namespace

RampReport ramp_load(const LoadSolve& solve, const RampOptions& options, std::vector<double>& y) {
  RampReport report;
  LoadPath path(options.begin, y);
  double increment = options.first;
  while (path.reached() < 1 && report.increments + report.failures < options.most) {
    const double target = target_of(path.reached(), std::min(increment, options.largest));
    const double size = target - path.reached();
    path.predict(target, y);
    const NewtonReport newton = solve(target, y);
    if (newton.converged) {
      path.append(target, y);
      ++report.increments;
      if (options.strays && path.reached() < 1 && options.strays(path.last(), 0.5)) {
        report.reason = "bodies of a pair have come to other facets";
        break;
      }
      increment = std::max(options.smallest, size * growth(newton.iterations, options));
      continue;
    }
    ++report.failures;
    report.reason = newton.reason;
    increment = size / 2;
    if (increment < options.smallest) break;
  }
  report.reached = path.reached();
  if (report.reached == 1)
    report.reason.clear();
  else if (report.reason.empty())
    report.reason = "increments became too small";
  y = path.last();
  return report;
}

}  // namespace gnomon
