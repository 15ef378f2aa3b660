#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/shapes/counter_shape_kind.hpp>
#include <gnomon/shapes/shape_keys.hpp>

namespace gnomon {

namespace {

/// In coordinates r across and s along the axis from the apex: the flank, and before its foot
/// reaches the apex, the apex itself.
SignedDistance<2> flank(double r, double s, double half_angle) {
  const double sine = std::sin(half_angle), cosine = std::cos(half_angle);
  const Vector<2> from(r, s), normal(cosine, -sine);
  if (r * sine + s * cosine >= 0) return {from.dot(normal), normal, Tensor<2>::Zero()};
  const double distance = from.norm();
  const Vector<2> n = from / distance;
  return {distance, n, (Tensor<2>::Identity() - n * n.transpose()) / distance};
}

/// Both flanks, one the image of the other.
CounterShape<2> wedge(const Vector<2>& apex, const Vector<2>& axis, double half_angle) {
  const Vector<2> e = axis.normalized(), across(e[1], -e[0]);
  const auto distance = [=](const Vector<2>& x) {
    const double r = across.dot(x - apex);
    SignedDistance<2> at = flank(std::abs(r), e.dot(x - apex), half_angle);
    Tensor<2> frame;
    frame << (r < 0 ? -across : across), e;
    at.unique = r != 0 || at.normal[0] == 0;
    at.normal = frame * at.normal;
    at.normal_by_x = frame * at.normal_by_x * frame.transpose();
    return at;
  };
  return {distance, apex.norm()};
}

}  // namespace

CounterShape<2> cone_meridian(double apex, double direction, double half_angle) {
  const auto distance = [=](const Vector<2>& x) {
    SignedDistance<2> at = flank(x[0], direction * (x[1] - apex), half_angle);
    const Vector<2> mirror(1, direction);
    at.normal = at.normal.cwiseProduct(mirror);
    at.normal_by_x = mirror.asDiagonal() * at.normal_by_x * mirror.asDiagonal();
    return at;
  };
  return {distance, std::abs(apex)};
}

template <int dim>
CounterShape<dim> cone(const Vector<dim>& apex, const Vector<dim>& axis, double half_angle) {
  if constexpr (dim == 2)
    return wedge(apex, axis, half_angle);
  else
    return revolved(cone_meridian(0, 1, half_angle), apex, axis);
}

template CounterShape<2> cone(const Vector<2>&, const Vector<2>&, double);
template CounterShape<3> cone(const Vector<3>&, const Vector<3>&, double);

namespace {

template <int dim>
CounterShape<dim> make(const Scene& scene, Section section) {
  const double half_angle = scene.real("counter_body.half_angle") * M_PI / 180;
  const Vector<dim> axis = read_direction<dim>(scene, "counter_body.axis");
  if constexpr (dim == 2)
    if (section == Section::meridian) {
      const Vector<2> apex = read_point_of_axis(scene, "counter_body.center", "the cone");
      if (axis[0] != 0)
        throw InputError(scene.where("counter_body.axis") +
                         ": expected the axis of symmetry, [0, 1] or [0, -1]: a cone of an "
                         "axisymmetric scene stands on it");
      return convex_or_concave(scene, cone_meridian(apex[1], axis[1] > 0 ? 1 : -1, half_angle));
    }
  const Vector<dim> apex = read_point<dim>(scene, "counter_body.center");
  return convex_or_concave(scene, cone<dim>(apex, axis, half_angle));
}

const Registration<CounterShapeKind> registration(
    {.name = "cone",
     .help = "wedge, or a cone about r = 0; outside: a V groove, a conical seat",
     .keys = {center_key("tip of the cone"),
              axis_key("from the tip into the cone (of a seat: into it)"),
              real_key("counter_body.half_angle", "deg", required(), {.min = 0.01, .max = 89.99},
                       "between axis and surface"),
              side_key()},
     .in_plane = make<2>,
     .in_space = make<3>});

}  // namespace

}  // namespace gnomon
