// The memory s of slip: where the contact nodes are on their partner at the end of a cycle
// (docs/fretting.md). A node that sticks throughout every cycle keeps its s, whatever the rows of
// the path say of it; one that slips follows within a cycle. Implicit methods integrate
//
//   sdot - (r - s) / period = 0,   r: the place at the end of the cycle
//
// Explicit ones would need steps of a cycle. For them s is an algebraic unknown,
//
//   (s - r) + w (s - s_before) = 0
//
// of which the small second part keeps s determined where a node sticks, so that r - s = 0 holds
// for any s. What is left of that by the nonlinear solves moves s by 1 / w times as much: w is
// larger where the node stuck when the stage was frozen.
#pragma once

#include <gnomon/terms/term.hpp>

namespace gnomon {

struct SlipMemory {
  FieldId s = FieldId::none;
  // Where s is algebraic: its values and, per node, 1 where it stuck, when the stage was frozen.
  FieldId before = FieldId::none, stuck = FieldId::none;
  double period = 1;  ///< of the cycle [time]

  bool is_algebraic() const { return before != FieldId::none; }
  /// The row of component i at a contact node, whose number is `row` [length / time].
  template <int dim>
  double residual(const Evaluation<dim>& at, Eigen::Index node, int i, int row, double r) const {
    const double now = at.values.vector(s)(node, i);
    const double rate = is_algebraic()
                            ? weight(at, node) / period * (now - at.values.vector(before)(node, i))
                            : (at.ydot.empty() ? 0 : at.ydot[static_cast<std::size_t>(row)]);
    return rate - (r - now) / period;
  }
  /// Its derivative by s; that by r is -1 / period.
  template <int dim>
  double by_s(const Evaluation<dim>& at, Eigen::Index node, double rate_weight) const {
    return 1 / period + (is_algebraic() ? weight(at, node) / period : rate_weight);
  }

private:
  template <int dim>
  double weight(const Evaluation<dim>& at, Eigen::Index node) const {
    constexpr double of_slip = 1e-4, of_stick = 1e-2;
    return at.values.scalar(stuck)[node] != 0 ? of_stick : of_slip;
  }
};

}  // namespace gnomon
