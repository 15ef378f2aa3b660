// The stages of ERKStep: the table that it gets, and what was evaluated at the stages of a step, to
// which it gives no access.
#pragma once

#include <deque>
#include <gnomon/integrators/butcher_table.hpp>
#include <vector>

#include "sundials/room.hpp"

namespace gnomon {

/// ERKStep (until 6.7) uses the rate of a last stage at c = 1 as the rate at the end of the step,
/// which is right only if that stage is the new value; in Heun's method it is not, and the method
/// would lose half of its stability. Where needed, the new value is appended as a stage of weight
/// zero, whose rate the next step uses.
sundials::TableOwner table_with_end(const ButcherTable& table);

struct ErkStage {
  double t = 0, integrand = 0;
  std::vector<double> rates;
};

class ErkStages {
public:
  /// The table must outlive it.
  explicit ErkStages(const ButcherTable& table) : table_(table) {}

  /// Called at every evaluation, in their order.
  void add(ErkStage stage);

  struct Sums {
    double integral;
    std::vector<double> error;  ///< of the step
  };
  /// By the weights of the table, over the step of size h that ERKStep has just taken from the
  /// first stage.
  Sums sums(const ErkStage& first, double h) const;

private:
  std::ptrdiff_t second_stage(double start, double h) const;

  const ButcherTable& table_;
  std::deque<ErkStage> evaluated_;  // the last ones
};

}  // namespace gnomon
