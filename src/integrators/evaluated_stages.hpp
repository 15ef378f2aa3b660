// The rates that ERKStep has asked for last, and which of them are the stages of its last step.
#pragma once

#include <cmath>
#include <deque>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/butcher_table.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "integrators/erk_table.hpp"

namespace gnomon {

struct Evaluated {
  double t, integrand;
  std::vector<double> rates;
};

class EvaluatedStages {
public:
  /// The table must outlive it.
  explicit EvaluatedStages(const ButcherTable& table) : table_(table) {}

  void add(Evaluated evaluated) {
    last_.push_back(std::move(evaluated));
    if (last_.size() > static_cast<std::size_t>(table_.stages()) + 2) last_.pop_front();
  }
  const Evaluated& operator[](std::size_t place) const { return last_[place]; }

  /// The place of the second stage of the step of size h that ERKStep has just taken from `start`,
  /// the first stage. The others were evaluated last, one after the other; after them there may be
  /// the end of the step, as a separate stage or for the next step. Throws SolutionError.
  std::size_t second_stage(double start, double h) const {
    const double rounding = 1e-9 * h + 8 * std::numeric_limits<double>::epsilon() * start;
    const std::ptrdiff_t later = table_.stages() - 1;
    const std::ptrdiff_t behind = stages_with_end(table_) - table_.stages();
    for (auto first = std::ssize(last_) - behind - later; first >= 0; --first) {
      int i = 1;
      while (i <= later && std::abs(last_[first + i - 1].t - (start + table_.c[i] * h)) <= rounding)
        ++i;
      if (i > later) return static_cast<std::size_t>(first);
    }
    throw SolutionError("the stages of " + table_.name +
                        " cannot be told apart: steps are too short");
  }

private:
  const ButcherTable& table_;
  std::deque<Evaluated> last_;
};

}  // namespace gnomon
