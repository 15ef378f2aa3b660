#include <gnomon/shapes/counter_shape_kind.hpp>
#include <gnomon/shapes/shape_keys.hpp>

namespace gnomon {

template <int dim>
CounterShape<dim> ball(const Vector<dim>& centre, double radius) {
  return {[centre, radius](const Vector<dim>& x) {
            const Vector<dim> from = x - centre;
            const double distance = from.norm();
            const Vector<dim> n = from / distance;
            return SignedDistance<dim>{distance - radius, n,
                                       (Tensor<dim>::Identity() - n * n.transpose()) / distance};
          },
          centre.norm() + radius};
}

namespace {

template <int dim>
CounterShape<dim> make(const Scene& scene, Section section) {
  Vector<dim> centre = read_point<dim>(scene, "counter_body.center");
  if constexpr (dim == 2)
    if (section == Section::meridian)
      centre = read_point_of_axis(scene, "counter_body.center", "the ball");
  return convex_or_concave(scene, ball<dim>(centre, scene.real("counter_body.radius")));
}

const Registration<CounterShapeKind> registration(
    {.name = "ball",
     .help = "disk, or a ball about r = 0; outside: a socket",
     .keys = {center_key("centre of the ball"),
              length_key("counter_body.radius", "radius of the ball"), side_key()},
     .in_plane = make<2>,
     .in_space = make<3>});

}  // namespace

template CounterShape<2> ball<2>(const Vector<2>&, double);
template CounterShape<3> ball<3>(const Vector<3>&, double);

}  // namespace gnomon
