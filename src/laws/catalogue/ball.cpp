#include <gnomon/laws/catalogue.hpp>

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
CounterShapeKind<dim> kind() {
  return {.name = "ball",
          .help = dim == 2 ? "disk: a cylinder seen along its axis" : "ball",
          .keys = {{.name = "counter_body.centre",
                    .kind = KeyKind::reals,
                    .unit = "mm",
                    .length = dim,
                    .help = "centre of the ball"},
                   {.name = "counter_body.radius",
                    .unit = "mm",
                    .range = positive_quantity,
                    .help = "radius of the ball"}},
          .make = [](const Scene& scene) {
            return ball<dim>(read_point<dim>(scene, "counter_body.centre"),
                             scene.real("counter_body.radius"));
          }};
}

const Registration<CounterShapeKind<2>> in_2d(kind<2>());
const Registration<CounterShapeKind<3>> in_3d(kind<3>());

}  // namespace

template CounterShape<2> ball<2>(const Vector<2>&, double);
template CounterShape<3> ball<3>(const Vector<3>&, double);

}  // namespace gnomon
