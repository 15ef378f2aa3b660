#include <fmt/format.h>

#include <gnomon/base/error.hpp>
#include <gnomon/shapes/counter_shape_kind.hpp>
#include <gnomon/shapes/shape_keys.hpp>

namespace gnomon {

CounterShape<3> torus(const Vector<3>& centre, const Vector<3>& axis, double major, double minor) {
  return revolved(ball<2>({major, 0}, minor), centre, axis);
}

namespace {

struct Radii {
  double major, minor;
};

/// Rings that cross themselves in the middle are refused.
Radii read_radii(const Scene& scene) {
  const Radii radii{scene.real("counter_body.major_radius"), scene.real("counter_body.radius")};
  if (!(radii.minor < radii.major))
    throw InputError(fmt::format(
        "{}: expected less than counter_body.major_radius = {:g} mm, got {:g}: the ring would "
        "cross itself",
        scene.where("counter_body.radius"), radii.major, radii.minor));
  return radii;
}

CounterShape<2> in_plane(const Scene& scene, Section section) {
  if (section == Section::plane)
    throw InputError(shape_origin(scene) +
                     ": a torus has no section that is the same along the third direction; "
                     "expected `cylinder`, or an axisymmetric body");
  const Vector<2> centre = read_point_of_axis(scene, "counter_body.center", "the torus");
  const Radii radii = read_radii(scene);
  return convex_or_concave(scene, ball<2>({radii.major, centre[1]}, radii.minor));
}

CounterShape<3> in_space(const Scene& scene, Section) {
  const Radii radii = read_radii(scene);
  return convex_or_concave(
      scene, torus(read_point<3>(scene, "counter_body.center"),
                   read_direction<3>(scene, "counter_body.axis"), radii.major, radii.minor));
}

const Registration<CounterShapeKind> registration(
    {.name = "torus",
     .help = "ring of circular section about r = 0; outside: a groove",
     .keys = {center_key("centre of the ring"),
              length_key("counter_body.major_radius",
                         "from the axis of a ring to the middle of its tube"),
              length_key("counter_body.radius", "radius of the tube of a ring"), side_key()},
     .keys_in_space = {axis_key("axis of symmetry")},
     .in_plane = in_plane,
     .in_space = in_space});

}  // namespace

}  // namespace gnomon
