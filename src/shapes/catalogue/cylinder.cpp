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
CounterShape<2> in_plane(const Scene& scene, Section section) {
  const double radius = scene.real("counter_body.radius");
  if (section == Section::plane)
    return convex_or_concave(scene, ball<2>(read_point<2>(scene, "counter_body.center"), radius));
  read_point_of_axis(scene, "counter_body.center", "the cylinder");
  return convex_or_concave(scene, plane<2>({radius, 0}, {1, 0}));
}

CounterShape<3> in_space(const Scene& scene, Section) {
  return convex_or_concave(scene, cylinder(read_point<3>(scene, "counter_body.center"),
                                           read_direction<3>(scene, "counter_body.axis"),
                                           scene.real("counter_body.radius")));
}

const Registration<CounterShapeKind> registration(
    {.name = "cylinder",
     .help = "cylinder seen along its axis, or a rod about r = 0; outside: a bore",
     .keys = {center_key("point of the axis of the cylinder"),
              length_key("counter_body.radius", "radius of the cylinder"), side_key()},
     .keys_in_space = {axis_key("direction of the axis")},
     .in_plane = in_plane,
     .in_space = in_space});

}  // namespace

}  // namespace gnomon
