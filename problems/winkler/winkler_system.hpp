// The equations of the worn pin on springs (see winkler.cpp) as a DAE.
#pragma once

#include <algorithm>
#include <gnomon/laws/wear_law.hpp>
#include <gnomon/system/system.hpp>
#include <memory>
#include <utility>
#include <vector>

namespace gnomon::winkler {

/// Data of the pin and its springs, and the trapezoidal points.
struct Foundation {
  double radius, width;      ///< R, L [mm]
  double modulus;            ///< K_w [MPa/mm]
  double force, speed;       ///< F [N/mm], v [mm/s]
  WearLaw wear;              ///< of p, v, t, s, x0 and h = d
  double wear_by_pressure;   ///< typical Wdot / p [mm/s/MPa]
  double duration;           ///< of the run [s]
  std::vector<double> x;     ///< positions of the points [mm]
  std::vector<double> area;  ///< A_i [mm]

  double profile(double at) const { return at * at / (2 * radius); }
  double mean_pressure() const { return force / width; }
  double mean_depth() const { return wear_by_pressure * mean_pressure() * duration; }
};

/// Unknowns d_0, p_0, d_1, p_1, ..., delta; or p_0, p_1, ..., delta with d frozen. The Jacobian is
/// an arrow: delta is coupled with every point, a point with nothing else.
class WinklerSystem : public System {
public:
  WinklerSystem(std::shared_ptr<const Foundation> foundation, bool coupled)
      : foundation_(std::move(foundation)), coupled_(coupled), frozen_(points(), 0.0) {
    const int n = points(), size = delta() + 1;
    PatternBuilder builder(size);
    for (int i = 0; i < n; ++i) {
      builder.add({p(i), delta()}, {p(i)});
      builder.add({p(i)}, {delta()});
      if (coupled_) builder.add({d(i)}, {p(i)}), builder.add({d(i), p(i)}, {d(i)});
    }
    structure_.size = size;
    structure_.pattern = builder.build();
    const Foundation& f = *foundation_;
    structure_.group.assign(size, n);
    structure_.differential.assign(size, 0);
    structure_.row_scale.assign(size, f.force);
    structure_.unknown_scale.assign(size, f.mean_pressure() / f.modulus);
    for (int i = 0; i < n; ++i) {
      structure_.switch_node.insert(structure_.switch_node.end(), switches(), i);
      structure_.group[p(i)] = i;
      structure_.row_scale[p(i)] = structure_.unknown_scale[p(i)] = f.mean_pressure();
      if (!coupled_) continue;
      structure_.group[d(i)] = i;
      structure_.differential[d(i)] = 1;
      structure_.row_scale[d(i)] = f.mean_depth() / f.duration;
      structure_.unknown_scale[d(i)] = f.mean_depth();
    }
    structure_.breakpoints = f.wear.breakpoints();
    for (int i = 0; i < n; ++i) {
      in_p_.push_back({position(p(i), p(i)), position(delta(), p(i)), position(p(i), delta())});
      if (coupled_)
        in_d_.push_back({position(d(i), d(i)), position(d(i), p(i)), position(p(i), d(i))});
    }
  }

  const Structure& structure() const override { return structure_; }

  void residual(const Point& at, std::span<double> F) const override {
    const Foundation& f = *foundation_;
    double force = 0;
    for (int i = 0; i < points(); ++i) {
      const double pressure = at.y[p(i)], spring = f.modulus * gap(at.y, i);
      F[p(i)] = pressure + (closed(at.branch, i, spring) ? spring : 0);
      if (coupled_) F[d(i)] = at.ydot[d(i)] - wear(at, i).value;
      force += f.area[i] * pressure;
    }
    F[delta()] = force - f.force;
  }

  void jacobian(const Point& at, double alpha, std::span<double> values) const override {
    const Foundation& f = *foundation_;
    std::fill(values.begin(), values.end(), 0.0);
    for (int i = 0; i < points(); ++i) {
      const double by_gap = closed(at.branch, i, f.modulus * gap(at.y, i)) ? f.modulus : 0;
      values[in_p_[i].diagonal] = 1;
      values[in_p_[i].row] = f.area[i];
      values[in_p_[i].column] = -by_gap;
      if (!coupled_) continue;
      const WearRate rate = wear(at, i);
      values[in_d_[i].diagonal] = alpha - rate.by_depth;
      values[in_d_[i].row] = -rate.by_pressure;
      values[in_d_[i].column] = by_gap;
    }
  }

  void switching(double t, std::span<const double> y, std::span<double> values) const override {
    const Point at{.t = t, .y = y};
    for (int i = 0; i < points(); ++i) {
      const std::span<double> own = values.subspan(first_switch(i), switches());
      own.front() = foundation_->modulus * gap(y, i);
      foundation_->wear.switching(wear_input(at, i), own.subspan(1));
    }
  }

  /// Wear rate of a point of the coupled system, on its branch. A point without pressure has none.
  WearRate wear(const Point& at, int i) const {
    const auto branches =
        at.branch ? std::span<const char>(*at.branch).subspan(first_switch(i) + 1, switches() - 1)
                  : std::span<const char>();
    return foundation_->wear.rate(wear_input(at, i), branches);
  }

  std::vector<AlgebraicStage> algebraic_stages() const override {
    auto algebraic = std::make_unique<WinklerSystem>(foundation_, false);
    AlgebraicStage stage;
    for (int i = 0; i < points(); ++i) stage.unknowns.push_back(p(i));
    stage.unknowns.push_back(delta());
    stage.freeze = [this, system = algebraic.get()](double, std::span<const double> y) {
      for (int i = 0; i < points(); ++i) system->frozen_[i] = y[d(i)];
    };
    stage.system = std::move(algebraic);
    std::vector<AlgebraicStage> stages;
    stages.push_back(std::move(stage));
    return stages;
  }

  int points() const { return static_cast<int>(foundation_->x.size()); }
  int d(int i) const { return 2 * i; }
  int p(int i) const { return coupled_ ? 2 * i + 1 : i; }
  int delta() const { return (coupled_ ? 2 : 1) * points(); }
  /// Negative where the springs are compressed [length].
  double gap(std::span<const double> y, int i) const {
    return foundation_->profile(foundation_->x[i]) + (coupled_ ? y[d(i)] : frozen_[i]) - y[delta()];
  }

private:
  struct Place {
    int diagonal, row, column;  // positions in the values
  };
  WearInput wear_input(const Point& at, int i) const {
    const Foundation& f = *foundation_;
    return {.pressure = at.y[p(i)],
            .speed = f.speed,
            .depth = coupled_ ? at.y[d(i)] : frozen_[i],
            .moment = {.time = at.t, .slid = f.speed * at.t, .within = at.within.value_or(at.t)},
            .initial = {f.x[i], f.profile(f.x[i]), 0}};
  }
  /// Contact, then the kinks of the wear law.
  std::size_t switches() const { return 1 + foundation_->wear.kinks(); }
  std::size_t first_switch(int i) const { return static_cast<std::size_t>(i) * switches(); }
  int position(int row, int column) const { return structure_.pattern.find(row, column); }
  bool closed(const ActiveSet* branch, int i, double switching) const {
    return branch ? (*branch)[first_switch(i)] != 0 : switching <= 0;
  }

  std::shared_ptr<const Foundation> foundation_;
  bool coupled_;
  std::vector<double> frozen_;  // d
  Structure structure_;
  std::vector<Place> in_p_, in_d_;
};

}  // namespace gnomon::winkler
