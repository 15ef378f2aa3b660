// Motion and load that repeat: their functions of the position in a cycle, and the counter-body at
// a position (docs/cycles.md; the paper, sec. 2.1: the time scale of the deformation). The
// positions of the phases: cycle_quadrature.hpp.
#pragma once

#include <array>
#include <gnomon/expressions/expression.hpp>
#include <gnomon/shapes/counter_body.hpp>
#include <optional>
#include <string>
#include <vector>

namespace gnomon {

/// A function of the position tau in a cycle, 0 <= tau < 1. A value; copies share what they hold.
class CycleFunction {
public:
  /// An expression with the single variable tau. Kinks of the language (abs, if, a table) are where
  /// the function has corners or jumps.
  explicit CycleFunction(Expression expression);

  double value(double tau) const;
  /// Its derivative by tau; at a kink that of what follows.
  double slope(double tau) const;
  /// Positions in [0, 1), ascending, at which it may have a corner or a jump; 0 where it ends
  /// otherwise than it begins, save for whole turns of an angle (0: it is none).
  std::vector<double> kinks(double turn = 0) const;
  /// By how much it ends above where it begins, save for whole turns of an angle (0: it is none).
  double gap(double turn = 0) const;
  /// By how much it differs from its begin at most, at sampled positions.
  double range() const;

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
  /// For the user: of each motion that does not end where it begins.
  std::vector<std::string> remarks() const;
};

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

/// The displacement at a position of the cycle; in the plane without the component out of it.
template <int dim>
Vector<dim> displacement_at(const Cycle& cycle, double tau);
/// Adds the velocity of displacement and rotation, in coordinates that are displaced with it. The
/// derivative at a breakpoint is that of what follows.
template <int dim>
void add_velocity(const Cycle& cycle, const CycleAxis<dim>& axis, double tau,
                  RigidMotion<dim>& motion);

/// The counter-body at a position of the cycle: displaced and turned from `body`, and its surface
/// moves with the velocity of both, beside that of `body.motion`. In the plane the third component
/// of the displacement is out of the plane.
template <int dim>
CounterBody<dim> counter_body_at(const CounterBody<dim>& body, const Cycle& cycle,
                                 const CycleAxis<dim>& axis, double tau);

}  // namespace gnomon
