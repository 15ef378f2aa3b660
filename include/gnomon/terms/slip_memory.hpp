// The memory s of slip: where the contact nodes are on their partner at the end of a cycle
// (docs/fretting.md). A node that sticks in a part of every cycle keeps its s, whatever the rows of
// the path say of it; one that slips follows within a cycle. Implicit methods integrate
//
//   sdot - (r - s) / period = 0,   r: the place at the end of the cycle
//
// Explicit ones would need steps of a cycle. For them s is an algebraic unknown,
//
//   (least (s - s_before) - (r - s)) / period = 0
//
// which is a step of backward Euler, long beside a cycle, from where s was when the stage was
// frozen: r - s vanishes where the node sticks, so that s stays, and s = r where it slips.
#pragma once

#include <gnomon/terms/term.hpp>

namespace gnomon {

struct SlipMemory {
  FieldId s = FieldId::none;
  FieldId before = FieldId::none;  ///< s_before, where s is algebraic
  double period = 1;               ///< of the cycle [time]

  bool is_algebraic() const { return before != FieldId::none; }
  /// The row of component i at a contact node, whose number is `row`.
  template <int dim>
  double residual(const Evaluation<dim>& at, Eigen::Index node, int i, int row, double r) const {
    const double now = at.values.vector(s)(node, i);
    const double rate = is_algebraic()
                            ? least / period * (now - at.values.vector(before)(node, i))
                            : (at.ydot.empty() ? 0 : at.ydot[static_cast<std::size_t>(row)]);
    return rate - (r - now) / period;
  }
  /// Its derivative by s; that by r is -1 / period.
  double by_s(double rate_weight) const {
    return 1 / period + (is_algebraic() ? least / period : rate_weight);
  }

private:
  static constexpr double least = 1e-4;
};

}  // namespace gnomon
