// Bodies of revolution and extruded bodies, by the signed distance in their section.

#include <gnomon/shapes/counter_shape.hpp>

namespace gnomon {

/// With e_r across the axis, and the normal n and H of the meridian in (r, z): the surface also
/// bends around the axis, by n_r / r. On the axis itself that is the limit, dn_r/dr, if n_r = 0.
CounterShape<3> revolved(const CounterShape<2>& meridian, const Vector<3>& origin,
                         const Vector<3>& axis) {
  const Vector<3> e = axis.normalized();
  const Tensor<3> across = Tensor<3>::Identity() - e * e.transpose();
  const auto distance = [=](const Vector<3>& x) {
    constexpr double rounding = 1e-14;
    const Vector<3> from = across * (x - origin);
    const double r = from.norm(), z = e.dot(x - origin);
    const bool on_axis = r <= rounding * ((x - origin).norm() + origin.norm());
    const Vector<3> e_r = on_axis ? e.unitOrthogonal() : Vector<3>(from / r);
    const Vector<3> e_phi = e.cross(e_r);
    const SignedDistance<2> flat = meridian.unchecked({r, z});
    Eigen::Matrix<double, 3, 2> frame;
    frame << e_r, e;
    const double around = on_axis ? flat.normal_by_x(0, 0) : flat.normal[0] / r;
    const bool meets_axis_square = std::abs(flat.normal[0]) <= 1e-9;
    return SignedDistance<3>{
        flat.gap, frame * flat.normal,
        frame * flat.normal_by_x * frame.transpose() + around * e_phi * e_phi.transpose(),
        flat.unique && (!on_axis || meets_axis_square)};
  };
  return {distance, origin.norm() + meridian.reach()};
}

CounterShape<3> extruded(const CounterShape<2>& section, const Vector<3>& origin,
                         const Tensor<3>& frame) {
  const Eigen::Matrix<double, 3, 2> plane = frame.leftCols<2>();
  const Vector<3> along = frame.col(2);
  const auto distance = [=](const Vector<3>& x) {
    const SignedDistance<2> flat = section.unchecked(plane.transpose() * (x - origin));
    return SignedDistance<3>{flat.gap, plane * flat.normal,
                             plane * flat.normal_by_x * plane.transpose(), flat.unique};
  };
  return {distance, (origin - along * along.dot(origin)).norm() + section.reach()};
}

}  // namespace gnomon
