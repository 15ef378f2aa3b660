#include <gnomon/base/error.hpp>
#include <gnomon/shapes/counter_shape_kind.hpp>
#include <gnomon/shapes/profile.hpp>
#include <gnomon/shapes/shape_keys.hpp>

namespace gnomon {

namespace {

CounterShape<2> in_plane(const Scene& scene, Section) {
  return profile(read_profile(scene));
}

/// The first coordinate of an extruded profile runs along axis x up.
Tensor<3> frame_of(const Vector<3>& axis, const Scene& scene) {
  const Vector<3> e = axis.normalized();
  const Vector<3> up = read_direction<3>(scene, "counter_body.up");
  const Vector<3> first = e.cross(up.normalized());
  if (!(first.norm() > 1e-6))
    throw InputError(scene.where("counter_body.up") +
                     ": expected a direction that is not along counter_body.axis");
  Tensor<3> frame;
  frame << first.normalized(), first.normalized().cross(e), e;
  return frame;
}

CounterShape<3> in_space(const Scene& scene, Section) {
  const CounterShape<2> section = profile(read_profile(scene));
  const Vector<3> centre = read_point<3>(scene, "counter_body.center");
  const Vector<3> axis = read_direction<3>(scene, "counter_body.axis");
  return scene.text("counter_body.sweep") == "revolved"
             ? revolved(section, centre, axis)
             : extruded(section, centre, frame_of(axis, scene));
}

Key center() {
  Key key = center_key("origin of the curve's coordinates");
  key.default_value = std::vector<double>(3, 0.0);
  return key;
}

const Registration<CounterShapeKind> registration(
    {.name = "profile",
     .help = "body on one side of a smooth curve through given points",
     .keys = {{.name = "counter_body.points",
               .kind = KeyKind::reals,
               .unit = "mm",
               .names_file = true,
               .help = "coordinates of the points of the curve, two for each, one point after the "
                       "other, or a file beside the scene with two numbers per line"},
              side_key()},
     .keys_in_space = {text_key("counter_body.sweep", required(),
                                "whether the curve, in coordinates (r, z), is turned about the "
                                "axis, or moved along it",
                                {"extruded", "revolved"}),
                       center(), axis_key("axis of revolution, or direction of the extrusion"),
                       reals_key("counter_body.up", "", by_default(std::vector<double>{0, 0, 1}),
                                 {},
                                 "direction of the second coordinate of an extruded curve, made "
                                 "perpendicular to the axis; the first is along axis x up",
                                 3)},
     .in_plane = in_plane,
     .in_space = in_space});

}  // namespace

}  // namespace gnomon
