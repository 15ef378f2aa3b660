#include "integrators/erk_stages.hpp"

#include <cmath>
#include <gnomon/base/error.hpp>
#include <iterator>
#include <limits>
#include <utility>

namespace gnomon {

namespace {

int stages_with_end(const ButcherTable& table) {
  const int s = table.stages();
  return table.stiffly_accurate() || table.c[s - 1] != 1 ? s : s + 1;
}

}  // namespace

sundials::TableOwner table_with_end(const ButcherTable& table) {
  const int s = table.stages(), n = stages_with_end(table);
  Eigen::MatrixXd transposed = Eigen::MatrixXd::Zero(n, n);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n), c = Eigen::VectorXd::Ones(n), embedded = b;
  transposed.topLeftCorner(s, s) = table.A.transpose();
  b.head(s) = table.b;
  c.head(s) = table.c;
  embedded.head(s) = table.b_embedded;
  if (n > s) transposed.col(s) = b;
  sundials::TableOwner result(ARKodeButcherTable_Create(n, table.order, table.embedded_order,
                                                        c.data(), transposed.data(), b.data(),
                                                        embedded.data()));
  sundials::check(result.get(), "ARKodeButcherTable_Create");
  return result;
}

void ErkStages::add(ErkStage stage) {
  evaluated_.push_back(std::move(stage));
  if (evaluated_.size() > static_cast<std::size_t>(table_.stages()) + 2) evaluated_.pop_front();
}

ErkStages::Sums ErkStages::sums(const ErkStage& first, double h) const {
  const std::ptrdiff_t second = second_stage(first.t, h);
  Sums sums{table_.b[0] * first.integrand, first.rates};
  for (double& e : sums.error) e *= h * (table_.b[0] - table_.b_embedded[0]);
  for (int i = 1; i < table_.stages(); ++i) {
    const ErkStage& stage = evaluated_[second + i - 1];
    sums.integral += table_.b[i] * stage.integrand;
    for (std::size_t k = 0; k < sums.error.size(); ++k)
      sums.error[k] += h * (table_.b[i] - table_.b_embedded[i]) * stage.rates[k];
  }
  sums.integral *= h;
  return sums;
}

/// The place in evaluated_ of the second stage of the step of size h that began at this time. The
/// stages were evaluated last, one after the other; after them there may be the end of the step, as
/// a separate stage or for the next step.
std::ptrdiff_t ErkStages::second_stage(double start, double h) const {
  const double rounding = 1e-9 * h + 8 * std::numeric_limits<double>::epsilon() * start;
  const std::ptrdiff_t later = table_.stages() - 1;
  const std::ptrdiff_t behind = stages_with_end(table_) - table_.stages();
  for (auto first = std::ssize(evaluated_) - behind - later; first >= 0; --first) {
    int i = 1;
    while (i <= later &&
           std::abs(evaluated_[first + i - 1].t - (start + table_.c[i] * h)) <= rounding)
      ++i;
    if (i > later) return first;
  }
  throw SolutionError("the stages of " + table_.name +
                      " cannot be told apart: steps are too short");
}

}  // namespace gnomon
