#include <gnomon/cycles/body_cycle.hpp>

namespace gnomon {

template <int dim>
bool BodyCycle<dim>::moves() const {
  return cycle.rotation || std::ranges::any_of(cycle.displacement, [](const auto& function) {
           return function.has_value();
         });
}

template <int dim>
BodyPlace<dim> BodyCycle<dim>::at(double tau) const {
  BodyPlace<dim> place;
  Vector<dim> displaced = Vector<dim>::Zero();
  RigidMotion<dim> own;
  for (int i = 0; i < 3; ++i) {
    if (!cycle.displacement[i]) continue;
    const double speed = cycle.displacement[i]->slope(tau) / cycle.period;
    if (i < dim) {
      displaced[i] = cycle.displacement[i]->value(tau);
      own.velocity[i] += speed;
    } else {
      own.across += speed;
    }
  }
  place.shift = displaced;
  if (cycle.rotation) {
    const double rate = cycle.rotation->slope(tau) / cycle.period;
    if (axis.meridian) {
      own.across_by_x[0] += rate;
    } else {
      place.turn = Turning<dim>{axis.spin, axis.centre, 0, cycle.rotation->value(tau)}.rotation(0);
      place.shift += axis.centre - place.turn * axis.centre;
      own.spin = rate * axis.spin;
      own.velocity -= own.spin * (axis.centre + displaced);
    }
  }
  // The steady motion goes on in the directions of space, about a centre that is displaced.
  place.motion.velocity = own.velocity + motion.at(Vector<dim>(-displaced));
  place.motion.spin = own.spin + motion.spin;
  place.motion.across = own.across + motion.across_at(Vector<dim>(-displaced));
  place.motion.across_by_x = own.across_by_x + motion.across_by_x;
  return place;
}

template struct BodyCycle<2>;
template struct BodyCycle<3>;

}  // namespace gnomon
