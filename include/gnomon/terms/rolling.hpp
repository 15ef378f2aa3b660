// Steady rolling (docs/rolling.md): how material passes the partner.
#pragma once

#include <algorithm>
#include <array>
#include <gnomon/base/tensor.hpp>
#include <optional>
#include <utility>

namespace gnomon {

/// Steady rolling: the material of the body streams past the partner, eq. (6), (7).
template <int dim>
struct Rolling {
  Vector<dim> velocity = Vector<dim>::Zero();  ///< V of the material [length / time]
  /// That of the body's material on the partner, along the surface, by |V|, as a rigid body slides;
  /// in space it is that at `centre`, and turns about the partner's normal there.
  Vector<dim> creepage = Vector<dim>::Zero();
  Vector<dim> centre = Vector<dim>::Zero();  ///< [length]
  Tensor<dim> spin = Tensor<dim>::Zero();    ///< skew, of the creepage by place [1 / length]

  /// Of pairs: forces on the slave along the axes, beside those of contact. Where one is given, the
  /// creepage along it is unknown, beside the given one [force].
  std::array<std::optional<double>, dim> force = {};
  /// In space the same of the moment about an axis, and of the spin about it [force length].
  std::optional<double> moment = {};
  Tensor<dim> turn = Tensor<dim>::Zero();  ///< about that axis through `centre`, of the rate one
  double creepage_scale = 1;               ///< of unknown ones
  double arm = 1;                          ///< the same of a spin by that [length]

  bool creeps() const {
    return moment || std::ranges::any_of(force, [](const auto& of) { return of.has_value(); });
  }

  /// Of bodies with small strains: slopes of the deformed surface are left out, whose squares are
  /// of the size of the strains' squares.
  bool linear = false;

  Vector<dim> creepage_at(const Vector<dim>& X) const { return creepage + spin * (X - centre); }
  /// As a number by `turn`, which is of the rate one [1 / length].
  double spin_about_turn() const { return spin.cwiseProduct(turn).sum() / turn.squaredNorm(); }
  /// Where the unknown spin is one: a unit vector, and by how much of it a point slides [length].
  std::pair<Vector<dim>, double> turned(const Vector<dim>& X) const {
    const Vector<dim> way = turn * (X - centre);
    if (way.isZero(0)) return {Vector<dim>::Unit(0), 0};
    return {way.normalized(), way.norm()};
  }
};

}  // namespace gnomon
