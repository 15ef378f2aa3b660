// In the plane and on a meridian. The slave segment is cut where the master's ends project on it
// along the interpolated normal: neighbouring masters share these cuts, so that they cover it
// without gaps and overlaps.
#include <cmath>
#include <gnomon/base/lift.hpp>
#include <gnomon/terms/mortar_kernel.hpp>
#include <unsupported/Eigen/AutoDiff>

namespace gnomon {

namespace {

template <class Scalar>
Scalar wedge(const Vector<2, Scalar>& a, const Vector<2, Scalar>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

/// A point of a segment, from the values at its ends.
template <class Scalar>
Vector<2, Scalar> at(const FacetNodal<2, Scalar>& ends, const Scalar& xi) {
  return ((Scalar(1) - xi) * ends.row(0) + xi * ends.row(1)).transpose();
}

/// Positive where the ray along the normal from the point xi of the slave passes behind y, seen
/// along the slave.
template <class Scalar>
Scalar behind(const FacetPair<2, Scalar>& pair, const Vector<2, Scalar>& y, const Scalar& xi) {
  return wedge<Scalar>(at(pair.x, xi) - y, at(pair.n, xi));
}

/// The point of the slave segment whose ray meets y, where one does; else its end on that side.
template <class Scalar>
Scalar cut(const FacetPair<2, Scalar>& pair, const Vector<2, Scalar>& y) {
  const FacetPair<2> given{plain(pair.X), plain(pair.x), plain(pair.n), plain(pair.y)};
  const Vector<2> to = plain(y);
  const double first = behind<double>(given, to, 0), last = behind<double>(given, to, 1);
  if (first <= 0) return Scalar(0);
  if (last >= 0) return Scalar(1);
  // A quadratic with one root between the ends.
  const double middle = behind<double>(given, to, 0.5);
  const double a = 2 * (first - 2 * middle + last), b = last - first - a;
  const double root = 2 * first / (-b + std::sqrt(std::max(0.0, b * b - 4 * a * first)));
  // One step of Newton's method gives the derivatives.
  return Scalar(root) - behind<Scalar>(pair, y, Scalar(root)) / Scalar(2 * a * root + b);
}

template <class Scalar>
CoveredPart<2, Scalar> covered(const FacetPair<2, Scalar>& pair, Section section, double reach) {
  CoveredPart<2, Scalar> part;
  const Vector<2, Scalar> y0 = pair.y.row(0), y1 = pair.y.row(1), along = y1 - y0,
                          X0 = pair.X.row(0), X1 = pair.X.row(1), x0 = pair.x.row(0),
                          x1 = pair.x.row(1);
  if (!(plain(Scalar(along.dot(x1 - x0))) < 0)) return part;
  const Scalar from = cut<Scalar>(pair, y1), to = cut<Scalar>(pair, y0), length = to - from;
  constexpr double nothing = 1e-12;
  if (!(plain(length) > nothing)) return part;
  // The products of shape functions at the two ends.
  const auto eta_at = [&](const Scalar& xi) -> Scalar {
    return wedge<Scalar>(at(pair.x, xi) - y0, at(pair.n, xi)) /
           wedge<Scalar>(along, at(pair.n, xi));
  };
  const auto products = [](const Scalar& xi, const Scalar& eta) {
    const Vector<2, Scalar> phi(Scalar(1) - xi, xi), N(Scalar(1) - eta, eta);
    return (phi * N.transpose()).eval();
  };
  const Tensor<2, Scalar> first = products(from, eta_at(from)), last = products(to, eta_at(to));
  const double off = 1 / std::sqrt(12.0);
  for (const double s : {0.5 - off, 0.5 + off}) {
    const Scalar xi = from + s * length;
    const Vector<2, Scalar> x = at(pair.x, xi), n = at(pair.n, xi);
    const Scalar eta = eta_at(xi);
    const Scalar distance = n.dot(y0 + eta * along - x) / n.norm();
    if (std::abs(plain(distance)) > reach) return {};
    Scalar measure = Scalar(0.5) * length * (X1 - X0).norm();
    if (section == Section::meridian) measure *= Scalar(2 * M_PI) * (X0[0] + xi * (X1[0] - X0[0]));
    const Vector<2, Scalar> phi(Scalar(1) - xi, xi), N(Scalar(1) - eta, eta);
    part.mass += measure * phi * phi.transpose();
    part.coupling += measure * phi * N.transpose();
    part.shared += measure * (Scalar(1 - s) * first + Scalar(s) * last);
    part.gap += measure * distance * phi;
  }
  return part;
}

}  // namespace

CoveredPart<2> covered_part(const FacetPair<2>& pair, Section section, double reach) {
  return covered<double>(pair, section, reach);
}

CoveredPartTangent<2> covered_part_tangent(const FacetPair<2>& pair, Section section,
                                           double reach) {
  constexpr int inputs = CoveredPartTangent<2>::inputs, each = 4;
  using Number = Eigen::AutoDiffScalar<Eigen::Matrix<double, inputs, 1>>;
  FacetPair<2, Number> lifted;
  int field = 0;
  for (const auto& [from, to] : {std::pair{&pair.X, &lifted.X},
                                 {&pair.x, &lifted.x},
                                 {&pair.n, &lifted.n},
                                 {&pair.y, &lifted.y}}) {
    for (int k = 0; k < each; ++k)
      to->data()[k] = Number(from->data()[k], inputs, each * field + k);
    ++field;
  }
  const CoveredPart<2, Number> part = covered<Number>(lifted, section, reach);
  CoveredPartTangent<2> tangent;
  int row = 0;
  const auto take = [&](const auto& from, auto& to) {
    for (Eigen::Index k = 0; k < from.size(); ++k, ++row) {
      to.data()[k] = from.data()[k].value();
      if (from.data()[k].derivatives().size() > 0)
        tangent.by_input.row(row) = from.data()[k].derivatives().transpose();
    }
  };
  take(part.mass, tangent.part.mass);
  take(part.coupling, tangent.part.coupling);
  take(part.shared, tangent.part.shared);
  take(part.gap, tangent.part.gap);
  return tangent;
}

}  // namespace gnomon
