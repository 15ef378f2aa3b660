// An elastic law at a Gauss point of a cell, by the rules of its element technology
// (solid_kernels.hpp; in a body of revolution, meridian_kernels.hpp).
#pragma once

#include <cmath>
#include <gnomon/laws/linear_elastic.hpp>
#include <gnomon/terms/solid.hpp>
#include <type_traits>

namespace gnomon {

/// With the point's own change of volume or that of the cell. `dim`: of the law, 3 in a body of
/// revolution.
template <ElementTechnology technology, template <int, class> class Law, int dim,
          class Scalar = double>
struct LawInCell {
  using T = Tensor<dim, Scalar>;
  using Point = Law<dim, Scalar>;
  static_assert(ElasticPoint<Point>, "a law provides what laws/elastic_law.hpp lists");
  static constexpr Kinematics kinematics = Point::kinematics;
  static constexpr bool small = kinematics == Kinematics::small;

  Scalar c;  ///< r^(1/dim), 1 with small strains
  T strain;  ///< strain at which the law is evaluated: F, Fbar, H or Hbar
  Point law;
  Scalar weight;  ///< factor of P n_a in R_a

  /// `mean`: of the cell, with its J and trace() of H.
  template <class Mean, class At>
  LawInCell(const ElasticModuli& moduli, const Mean& mean, const At& point)
      : c(stretch(mean, point)),
        strain(strain_of(mean, point)),
        law(moduli, strain),
        weight(point.volume) {
    // c / r: in a body of revolution, where the mean is not that of a point, written as c^-2.
    if constexpr (technology == ElementTechnology::f_bar && !small)
      weight = std::is_same_v<Mean, At> ? Scalar(point.volume * c * point.J / mean.J)
                                        : Scalar(point.volume / (c * c));
    if constexpr (variational(technology) && !small) weight = point.volume * c;
  }

private:
  template <class Mean, class At>
  static Scalar stretch(const Mean& mean, const At& point) {
    using std::pow;
    if constexpr (averaged(technology) && !small)
      return pow(Scalar(mean.J / point.J), 1.0 / dim);
    else
      return Scalar(1);
  }
  template <class Mean, class At>
  T strain_of(const Mean& mean, const At& point) const {
    if constexpr (small && averaged(technology))
      return point.H + Scalar((mean.trace() - point.H.trace()) / Scalar(dim)) * T::Identity();
    else if constexpr (small)
      return point.H;
    else if constexpr (averaged(technology))
      return c * point.F;
    else
      return point.F;
  }
};

/// Von Mises' equivalent of the Cauchy stress (of sigma with small strains) of a strain in the
/// plane or in space. Plane strain is a state of the three-dimensional law.
template <template <int, class> class Law, int dim>
double von_mises_stress(const ElasticModuli& moduli, const Tensor<dim>& strain) {
  constexpr bool small = Law<3, double>::kinematics == Kinematics::small;
  Tensor<3> whole = small ? Tensor<3>(Tensor<3>::Zero()) : Tensor<3>(Tensor<3>::Identity());
  whole.topLeftCorner<dim, dim>() = strain;
  const Tensor<3> P = Law<3, double>(moduli, whole).stress();
  const Tensor<3> sigma = small ? P : Tensor<3>(P * whole.transpose() / whole.determinant());
  return std::sqrt(1.5) * (sigma - sigma.trace() / 3 * Tensor<3>::Identity()).norm();
}

}  // namespace gnomon
