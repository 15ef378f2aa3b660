// Ends a run that no longer gets anywhere: every step succeeds, after ever more work and over ever
// less time.
#pragma once

#include <gnomon/base/counters.hpp>

namespace gnomon {

class Headway {
public:
  /// Of a run from now on.
  Headway(double t, const Counters& counters, double end);
  /// Throws SolutionError when most_newton_iterations have not brought the run on by 1e-5 of its
  /// length: it would take half a milliard for the whole.
  void require(double t, const Counters& counters);

private:
  double t_;
  long newton_iterations_;
  double end_;
};

}  // namespace gnomon
