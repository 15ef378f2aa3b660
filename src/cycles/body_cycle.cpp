#include <algorithm>
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
  const Vector<dim> displaced = displacement_at<dim>(cycle, tau);
  place.shift = displaced;
  if (cycle.rotation && !axis.meridian) {
    place.turn = Turning<dim>{axis.spin, axis.centre, 0, cycle.rotation->value(tau)}.rotation(0);
    place.shift += axis.centre - place.turn * axis.centre;
  }
  // The steady motion goes on in the directions of space, about a centre that is displaced.
  RigidMotion<dim> own = motion;
  add_velocity(cycle, axis, tau, own);
  add_motion<dim>(1, own, displaced, place.motion);
  return place;
}

template struct BodyCycle<2>;
template struct BodyCycle<3>;

}  // namespace gnomon
