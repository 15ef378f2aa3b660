#include <gnomon/laws/catalogue.hpp>

namespace gnomon {

CounterShape<3> cylinder(const Vector<3>& point, const Vector<3>& axis, double radius) {
  const Vector<3> e = axis.normalized();
  return {[point, e, radius](const Vector<3>& x) {
            const Tensor<3> across = Tensor<3>::Identity() - e * e.transpose();
            const Vector<3> from = across * (x - point);
            const double distance = from.norm();
            const Vector<3> n = from / distance;
            return SignedDistance<3>{distance - radius, n, (across - n * n.transpose()) / distance};
          },
          (point - e * e.dot(point)).norm() + radius};
}

namespace {

const Registration<CounterShapeKind<3>> registration(
    {.name = "cylinder",
     .help = "circular cylinder without ends",
     .keys = {{.name = "counter_body.point",
               .kind = KeyKind::reals,
               .unit = "mm",
               .length = 3,
               .help = "point of the axis"},
              {.name = "counter_body.axis",
               .kind = KeyKind::reals,
               .length = 3,
               .help = "direction of the axis, of any length"},
              {.name = "counter_body.radius",
               .unit = "mm",
               .range = positive_quantity,
               .help = "radius of the cylinder"}},
     .make = [](const Scene& scene) {
       return cylinder(read_point<3>(scene, "counter_body.point"),
                       read_direction<3>(scene, "counter_body.axis"),
                       scene.real("counter_body.radius"));
     }});

}  // namespace

}  // namespace gnomon
