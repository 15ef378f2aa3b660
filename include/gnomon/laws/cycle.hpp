// Motion and load that repeat: their functions of the position in a cycle, the phases at which they
// are taken, and the counter-body in a phase (docs/cycles.md; the paper, sec. 2.1: the time scale
// of the deformation).
#pragma once

#include <array>
#include <functional>
#include <gnomon/laws/counter_body.hpp>
#include <gnomon/scene/expression.hpp>
#include <optional>
#include <span>
#include <vector>

namespace gnomon {

/// A function of the position tau in a cycle, 0 <= tau < 1. A value; copies share what they hold.
class CycleFunction {
public:
  /// An expression with the single variable tau. Kinks of the language (abs, if, a table) are where
  /// the function has corners or jumps.
  explicit CycleFunction(Expression expression);

  double value(double tau) const;
  /// Its derivative by tau; at a kink that of one side.
  double slope(double tau) const;
  /// Positions in [0, 1), ascending, at which it may have a corner or a jump; 0 where it ends
  /// otherwise than it begins, save for whole turns of an angle (0: it is none).
  std::vector<double> kinks(double turn = 0) const;

private:
  Expression expression_;
};

/// What moves and loads the bodies over a cycle. What is absent does not change.
struct Cycle {
  double period = 1;                                         ///< [time]
  std::array<std::optional<CycleFunction>, 3> displacement;  ///< of the counter-body [length]
  std::optional<CycleFunction> rotation;  ///< of the counter-body, from its place [rad]
  std::optional<CycleFunction> force;     ///< that presses the counter-body [force]
  std::optional<CycleFunction> load;      ///< factor of the loads on the worn body

  /// Positions in [0, 1), ascending, at which one of the functions may have a corner or a jump.
  std::vector<double> kinks() const;
};

/// Positions in [0, 1), ascending, at which one of `count` functions of the position changes its
/// sign, also from the end of the cycle to its begin (sign_changes.hpp).
std::vector<double> sign_changes_in_cycle(
    const std::function<void(double tau, std::span<double> values)>& functions, std::size_t count);

/// The positions of both, ascending; of those that differ by rounding the first: a corner of a
/// table is also where a velocity changes its sign.
std::vector<double> merged_kinks(std::vector<double> kinks, const std::vector<double>& more);

/// A position in the cycle with its part of the mean over the cycle.
struct CyclePoint {
  double position = 0;  ///< tau
  double weight = 1;    ///< omega; the sum over the points is 1
};

/// Points of a quadrature over the cycle, ascending. Without kinks equal weights at 0, 1/P, ...:
/// spectrally accurate for a smooth periodic integrand. With kinks, at which the integrand has
/// corners, Gauss's formula between them, with about as many points in each part as its length
/// demands, one or more; with fewer points than parts, equal weights.
std::vector<CyclePoint> cycle_points(int count, const std::vector<double>& kinks);
/// The same at chosen positions in [0, 1), ascending: each has half of the distances to its
/// neighbours, around the cycle.
std::vector<CyclePoint> cycle_points(const std::vector<double>& positions);

/// Chosen positions and the middles between them, around the cycle; all in [0, 1), ascending.
std::vector<double> with_middles(const std::vector<double>& positions);

/// The axis about which Cycle::rotation turns a counter-body: through `centre`, in the coordinates
/// of its shape.
template <int dim>
struct CycleAxis {
  Tensor<dim> spin = Tensor<dim>::Zero();  ///< skew, of the rate one
  Vector<dim> centre = Vector<dim>::Zero();
  bool turns_shape = false;  ///< whether the shape does not look the same after a rotation
  /// Of a body of revolution (dim = 2): the rotation is about r = 0, and moves out of the section.
  bool meridian = false;
};

/// The counter-body at a position of the cycle: displaced and turned from `body`, and its surface
/// moves with the velocity of both, beside that of `body.motion`. In the plane the third component
/// of the displacement is out of the plane.
template <int dim>
CounterBody<dim> counter_body_at(const CounterBody<dim>& body, const Cycle& cycle,
                                 const CycleAxis<dim>& axis, double tau);

}  // namespace gnomon
