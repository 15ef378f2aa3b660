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
  const Vector<dim> normal = read_direction<dim>(scene, "counter_body.normal");
  if (section == Section::meridian && normal[0] != 0)
    throw InputError(scene.where("counter_body.normal") +
                     ": expected a normal along the axis of symmetry, [0, 1] or [0, -1], in an "
                     "axisymmetric scene; others belong to a `cone` or a `cylinder`");
  const bool given = scene.has("counter_body.center");
  return plane<dim>(given ? read_point<dim>(scene, "counter_body.center") : Vector<dim>::Zero(),
                    normal);
}

template <int dim>
CounterShapeKind<dim> kind() {
  std::vector<double> up(dim, 0.0);
  up.back() = 1;
  Key center = center_key(dim, "point of the plane");
  center.absent_meaning = "the origin";  // which is no centre of rotation by itself
  return {.name = "plane",
          .help = "half-space below a plane",
          .keys = {center,
                   {.name = "counter_body.normal",
                    .kind = KeyKind::reals,
                    .default_value = up,
                    .length = dim,
                    .help = "its normal towards the worn body, of any length"}},
          .make = make<dim>};
}

const Registration<CounterShapeKind<2>> in_2d(kind<2>());
const Registration<CounterShapeKind<3>> in_3d(kind<3>());

}  // namespace

template CounterShape<2> plane<2>(const Vector<2>&, const Vector<2>&);
template CounterShape<3> plane<3>(const Vector<3>&, const Vector<3>&);

}  // namespace gnomon
