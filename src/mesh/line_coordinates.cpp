#include "mesh/line_coordinates.hpp"

#include <algorithm>
#include <cmath>

namespace gnomon {

template <int dim>
LineCoordinates<dim>::LineCoordinates(const Streamlines<dim>& lines,
                                      const std::vector<Vector<dim>>& points)
    : lines_(lines), first_(points.front()) {
  if (!lines.centre) return;
  double least = lines_.radial(first_).norm(), most = least;
  for (const Vector<dim>& x : points) {
    least = std::min(least, lines_.radial(x).norm());
    most = std::max(most, lines_.radial(x).norm());
  }
  radius_ = (least + most) / 2;
}

template <int dim>
double LineCoordinates<dim>::place(const Vector<dim>& x) const {
  if (!lines_.centre) return x.dot(lines_.along);
  constexpr double rounding = 1e-3;  // what is this little before the beginning is there
  const Vector<dim> from = lines_.radial(first_), to = lines_.radial(x);
  const double angle = std::atan2(turned(from, to), from.dot(to));
  return radius_ * (angle < -rounding ? angle + 2 * M_PI : angle);
}

template <int dim>
Vector<dim> LineCoordinates<dim>::across(const Vector<dim>& x) const {
  if (!lines_.centre) return x - x.dot(lines_.along) * lines_.along;
  return lines_.radial(x).norm() * Vector<dim>::Unit(0) +
         (x - *lines_.centre).dot(lines_.along) * Vector<dim>::Unit(1);
}

template <int dim>
bool LineCoordinates<dim>::is_on_axis(const Vector<dim>& x) const {
  constexpr double rounding = 1e-6;
  return lines_.radial(x).norm() <= rounding * radius_;
}

template <int dim>
double LineCoordinates<dim>::length_of(const std::vector<Vector<dim>>& circle, bool closed) const {
  double length = 0;
  for (std::size_t k = closed ? 0 : 1; k < circle.size(); ++k) {
    const Vector<dim> from = lines_.radial(circle[(k + circle.size() - 1) % circle.size()]),
                      to = lines_.radial(circle[k]);
    length += radius_ * std::abs(turned(from, to)) / (from.norm() * to.norm());
  }
  return length;
}

template <int dim>
double LineCoordinates<dim>::turned(const Vector<dim>& from, const Vector<dim>& to) const {
  if constexpr (dim == 2)
    return from[0] * to[1] - from[1] * to[0];
  else
    return lines_.along.dot(from.cross(to));
}

template class LineCoordinates<2>;
template class LineCoordinates<3>;

}  // namespace gnomon
