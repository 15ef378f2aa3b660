// Quadrature on triangles (Dunavant 1985), symmetric, with positive weights and inner points.
#pragma once

#include <array>
#include <cmath>
#include <span>

namespace gnomon::mortar {

struct TrianglePoint {
  std::array<double, 3> at;  ///< barycentric coordinates
  double weight;             ///< part of the area
};

template <std::size_t points>
class TriangleRule {
public:
  TriangleRule& middle(double weight) {
    constexpr double third = 1.0 / 3;
    return push({third, third, third}, weight);
  }
  TriangleRule& three(double weight, double a) {
    const double b = 1 - 2 * a;
    return push({b, a, a}, weight).push({a, b, a}, weight).push({a, a, b}, weight);
  }
  TriangleRule& six(double weight, double a, double b) {
    const double c = 1 - a - b;
    for (const auto& [p, q, r] : {std::array{a, b, c}, {b, c, a}, {c, a, b}})
      push({p, q, r}, weight).push({q, p, r}, weight);
    return *this;
  }
  const std::array<TrianglePoint, points>& all() const { return points_; }

private:
  TriangleRule& push(const std::array<double, 3>& at, double weight) {
    points_[count_++] = {at, weight};
    return *this;
  }
  std::array<TrianglePoint, points> points_;
  std::size_t count_ = 0;
};

/// Exact for polynomials of degree 5.
inline const auto degree_5 = TriangleRule<7>()
                                 .middle(9.0 / 40)
                                 .three((155 + std::sqrt(15.0)) / 1200, (6 + std::sqrt(15.0)) / 21)
                                 .three((155 - std::sqrt(15.0)) / 1200, (6 - std::sqrt(15.0)) / 21)
                                 .all();
inline const auto degree_6 =
    TriangleRule<12>()
        .three(0.050844906370206821, 0.063089014491502231)
        .three(0.116786275726379390, 0.249286745170910407)
        .six(0.082851075618373561, 0.053145049844816937, 0.310352451033784416)
        .all();
inline const auto degree_8 =
    TriangleRule<16>()
        .middle(0.144315607677787169)
        .three(0.095091634267284625, 0.459292588292723154)
        .three(0.103217370534718246, 0.170569307751760205)
        .three(0.032458497623198080, 0.050547228317030974)
        .six(0.027230314174434997, 0.008394777409957610, 0.263112829634638115)
        .all();

/// For facets that are parallelograms but for a relative change of shape, so that integrands are
/// polynomials of degree 5 but for that. Errors are near 1e-8 of the area of a facet up to 0.1, and
/// 3e-6 at the quadrilaterals that a triangle is cut into.
inline std::span<const TrianglePoint> triangle_rule(double irregularity) {
  if (irregularity < 1e-12) return degree_5;
  if (irregularity < 0.1) return degree_6;
  return degree_8;
}

}  // namespace gnomon::mortar
