// The table of an explicit method as ERKStep needs it, and the control of its steps.
#pragma once

#include <gnomon/integrators/butcher_table.hpp>

#include "sundials/room.hpp"

namespace gnomon {

/// ERKStep (until 6.7) uses the rate of a last stage at c = 1 as the rate at the end of the step,
/// which is right only if that stage is the new value; in Heun's method it is not, and the method
/// would lose half of its stability. Where needed, the new value is appended as a stage of weight
/// zero, whose rate the next step uses.
inline int stages_with_end(const ButcherTable& table) {
  const int s = table.stages();
  return table.stiffly_accurate() || table.c[s - 1] != 1 ? s : s + 1;
}

inline sundials::TableOwner table_with_end(const ButcherTable& table) {
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

/// The PI controller that chooses the steps: with every version of SUNDIALS, the default parameters
/// of ERKStep 6.4.
inline constexpr sundials::PiController pi_controller{.proportional = 0.8,
                                                      .integral = 0.31,
                                                      .bias = 1.2,
                                                      .safety = 0.99,
                                                      .keep_from = 1.0,
                                                      .keep_to = 1.5};

}  // namespace gnomon
