// The common part of all elastic laws: moduli, and the interface of a law at one point.
#pragma once

#include <array>
#include <concepts>
#include <gnomon/base/tensor.hpp>

namespace gnomon {

/// Finite strains, or the law and the balance of forces linearized in the displacement.
enum class Kinematics { finite, small };

/// The parameters of an elastic law. Parameters other than those of the linearization have no unit,
/// so that only lambda and mu determine the stiffness.
struct ElasticModuli {
  double lambda = 0;               ///< first Lame parameter of the linearization [stress]
  double mu = 0;                   ///< shear modulus of the linearization [stress]
  std::array<double, 2> ratios{};  ///< further parameters, different for each law, without unit

  static ElasticModuli from_young_poisson(double young, double poisson) {
    const double mu = young / (2 * (1 + poisson));
    return {2 * mu * poisson / (1 - 2 * poisson), mu};
  }
  double young_modulus() const { return mu * (3 * lambda + 2 * mu) / (lambda + mu); }
  /// The same material, `factor` times as stiff.
  ElasticModuli scaled(double factor) const { return {factor * lambda, factor * mu, ratios}; }
};

/// A law evaluated at one strain: a class template `Law<dim, Scalar>`, constructed from
/// ElasticModuli and a Tensor<dim, Scalar>. The strain is the deformation gradient F with
/// det F > 0, or, if its `kinematics` are small, the displacement gradient H. In 2D the state is
/// plane strain (F_33 = 1). `stress` is P = d energy / dF (sigma of H), `stress_change(dF)` is
/// (dP/dF) : dF.
template <class Point>
concept ElasticPoint = requires(const Point& at, const typename Point::T& dF) {
  { Point::kinematics } -> std::convertible_to<Kinematics>;
  at.energy();
  { at.stress() } -> std::convertible_to<typename Point::T>;
  { at.stress_change(dF) } -> std::convertible_to<typename Point::T>;
};

/// A law whose tangent has the form
///   (dP/dF) : dF = shear dF + volumetric (G : dF) G + geometric G dF^T G,
/// G = F^-T (I with small strains). Elements assemble it faster than a general one.
template <class Point>
concept DyadicPoint = ElasticPoint<Point> && requires(const Point& at) {
  at.shear();
  at.volumetric();
  at.geometric();
};

}  // namespace gnomon
