#include <gnomon/shapes/counter_shape_kind.hpp>
#include <gnomon/shapes/shape_keys.hpp>

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

/// Seen along its axis; about the axis of symmetry a straight line at the distance of the radius.
CounterShape<2> make_2d(const Scene& scene, Section section) {
  const double radius = scene.real("counter_body.radius");
  if (section == Section::plane)
    return convex_or_concave(scene, ball<2>(read_point<2>(scene, "counter_body.center"), radius));
  read_point_of_axis(scene, "counter_body.center", "the cylinder");
  return convex_or_concave(scene, plane<2>({radius, 0}, {1, 0}));
}

CounterShape<3> make_3d(const Scene& scene, Section) {
  return convex_or_concave(scene, cylinder(read_point<3>(scene, "counter_body.center"),
                                           read_direction<3>(scene, "counter_body.axis"),
                                           scene.real("counter_body.radius")));
}

std::vector<Key> keys(int dim) {
  std::vector<Key> keys = {center_key(dim, "point of the axis of the cylinder"),
                           length_key("counter_body.radius", "radius of the cylinder"), side_key()};
  if (dim == 3) keys.push_back(axis_key(dim, "direction of the axis"));
  return keys;
}

const Registration<CounterShapeKind<2>> in_2d(
    {.name = "cylinder",
     .help = "cylinder seen along its axis, or a rod about r = 0; outside: a bore",
     .keys = keys(2),
     .make = make_2d});
const Registration<CounterShapeKind<3>> in_3d(
    {.name = "cylinder",
     .help = "circular cylinder without ends; outside: a bore",
     .keys = keys(3),
     .make = make_3d});

}  // namespace

}  // namespace gnomon
