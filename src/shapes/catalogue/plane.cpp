#include <gnomon/base/error.hpp>
#include <gnomon/shapes/counter_shape_kind.hpp>
#include <gnomon/shapes/shape_keys.hpp>

namespace gnomon {

template <int dim>
CounterShape<dim> plane(const Vector<dim>& point, const Vector<dim>& normal) {
  const Vector<dim> n = normal.normalized();
  return {[point, n](const Vector<dim>& x) {
            return SignedDistance<dim>{n.dot(x - point), n, Tensor<dim>::Zero()};
          },
          point.norm()};
}

namespace {

template <int dim>
CounterShape<dim> make(const Scene& scene, Section section) {
  Vector<dim> point = Vector<dim>::Zero(), normal = Vector<dim>::Unit(dim - 1);
  if (scene.has("counter_body.center")) point = read_point<dim>(scene, "counter_body.center");
  if (scene.has("counter_body.normal")) normal = read_direction<dim>(scene, "counter_body.normal");
  if (section == Section::meridian && normal[0] != 0)
    throw InputError(scene.where("counter_body.normal") +
                     ": expected a normal along the axis of symmetry, [0, 1] or [0, -1], in an "
                     "axisymmetric scene; others belong to a `cone` or a `cylinder`");
  return plane<dim>(point, normal);
}

Key center() {
  Key key = center_key("point of the plane");
  key.absent_meaning = "the origin";  // which is no centre of rotation by itself
  return key;
}

const Registration<CounterShapeKind> registration(
    {.name = "plane",
     .help = "half-space below a plane",
     .keys = {center(), reals_key("counter_body.normal", "", absent("along the last direction"), {},
                                  "its normal towards the worn body, of any length")},
     .in_plane = make<2>,
     .in_space = make<3>});

}  // namespace

template CounterShape<2> plane<2>(const Vector<2>&, const Vector<2>&);
template CounterShape<3> plane<3>(const Vector<3>&, const Vector<3>&);

}  // namespace gnomon
