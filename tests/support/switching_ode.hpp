// A minimal system with events: points that come into contact with springs and wear them.
#pragma once

#include <cmath>
#include <gnomon/integrators/rates.hpp>
#include <gnomon/system/state.hpp>
#include <gnomon/system/system.hpp>
#include <memory>
#include <numeric>
#include <vector>

namespace gnomon::testing {

struct SprungPointsOptions {
  std::vector<double> borders{};  ///< a_j, where point j touches its spring
  double frequency = 0;           ///< omega of the motion
  double stiffness = 1;           ///< K
  double wear = 0;                ///< k
  double x = 0, speed = 1;        ///< at the start
  std::vector<double> breakpoints = {};
};

/// Unknowns [x, v, d_1 ... d_m, p_1 ... p_m]:
///
///   x' = v,  v' = -omega^2 x,  d_j' = k p_j,  p_j = K max(0, x - a_j - d_j).
///
/// With omega = 0 and x = t: nothing before a_j, then with s = t - a_j
/// d_j = s - (1 - exp(-k K s)) / (k K); for k = 0 the events are where x(t) = a_j.
class SprungPoints : public System {
public:
  explicit SprungPoints(const SprungPointsOptions& options) : options_(options) {
    const int n = 2 + 2 * points();
    std::vector<int> all(n);
    std::iota(all.begin(), all.end(), 0);
    PatternBuilder builder(n);
    builder.add(all, all);
    structure_.size = n;
    structure_.pattern = builder.build();
    structure_.group.assign(n, 0);
    structure_.differential.assign(n, 1);
    for (int j = 0; j < points(); ++j) structure_.differential[pressure(j)] = 0;
    structure_.row_scale.assign(n, 1.0);
    structure_.unknown_scale.assign(n, 1.0);
    for (int j = 0; j < points(); ++j) structure_.switch_node.push_back(100 + j);
    structure_.breakpoints = options.breakpoints;
  }

  int points() const { return static_cast<int>(options_.borders.size()); }
  static int depth(int j) { return 2 + j; }
  int pressure(int j) const { return 2 + points() + j; }
  const SprungPointsOptions& options() const { return options_; }

  State start() const {
    State state;
    state.y.assign(structure_.size, 0.0);
    state.y[0] = options_.x;
    state.y[1] = options_.speed;
    for (int j = 0; j < points(); ++j)
      state.y[pressure(j)] = options_.stiffness * std::max(0.0, options_.x - options_.borders[j]);
    set_rates(*this, nullptr, state);
    return state;
  }

  /// Depth of point j at t, for omega = 0, x = 0 and speed = 1 at the start.
  double exact_depth(int j, double t) const {
    const double s = t - options_.borders[j], rate = options_.wear * options_.stiffness;
    return s <= 0 ? 0 : s + std::expm1(-rate * s) / rate;
  }

  const Structure& structure() const override { return structure_; }

  void residual(const Point& at, std::span<double> F) const override {
    const ActiveSet active = at.branch ? *at.branch : active_set(*this, at.t, at.y);
    const double omega = options_.frequency;
    F[0] = at.ydot[0] - at.y[1];
    F[1] = at.ydot[1] + omega * omega * at.y[0];
    for (int j = 0; j < points(); ++j) {
      const double p = at.y[pressure(j)];
      F[depth(j)] = at.ydot[depth(j)] - options_.wear * p;
      F[pressure(j)] = p - (active[j] ? options_.stiffness * overlap(j, at.y) : 0);
    }
  }

  void jacobian(const Point& at, double rate_weight, std::span<double> values) const override {
    const ActiveSet active = at.branch ? *at.branch : active_set(*this, at.t, at.y);
    const double omega = options_.frequency;
    std::fill(values.begin(), values.end(), 0.0);
    const auto J = [&](int row, int column) -> double& {
      return values[column * structure_.size + row];
    };
    J(0, 0) = J(1, 1) = rate_weight;
    J(0, 1) = -1;
    J(1, 0) = omega * omega;
    for (int j = 0; j < points(); ++j) {
      J(depth(j), depth(j)) = rate_weight;
      J(depth(j), pressure(j)) = -options_.wear;
      J(pressure(j), pressure(j)) = 1;
      if (!active[j]) continue;
      J(pressure(j), 0) = -options_.stiffness;
      J(pressure(j), depth(j)) = options_.stiffness;
    }
  }

  void switching(const Point& at, std::span<double> values) const override {
    for (int j = 0; j < points(); ++j) values[j] = -overlap(j, at.y);
  }

  std::vector<AlgebraicStage> algebraic_stages() const override {
    auto system = std::make_unique<Pressures>(*this);
    Pressures* pressures = system.get();
    std::vector<AlgebraicStage> stages(1);
    for (int j = 0; j < points(); ++j) stages[0].unknowns.push_back(pressure(j));
    stages[0].system = std::move(system);
    stages[0].freeze = [pressures](double, std::span<const double> y) {
      pressures->frozen.assign(y.begin(), y.end());
    };
    return stages;
  }

private:
  /// The pressures for given x and d.
  struct Pressures : System {
    explicit Pressures(const SprungPoints& parent)
        : parent(parent), frozen(parent.structure_.size) {
      const int m = parent.points();
      own.size = m;
      own.pattern = PatternBuilder(m).build();  // the diagonal
      own.group.assign(m, 0);
      own.differential.assign(m, 0);
      own.row_scale.assign(m, 1.0);
      own.unknown_scale.assign(m, 1.0);
      own.switch_node = parent.structure_.switch_node;
    }
    const Structure& structure() const override { return own; }
    void residual(const Point& at, std::span<double> F) const override {
      const ActiveSet active = at.branch ? *at.branch : active_set(*this, at.t, at.y);
      for (int j = 0; j < parent.points(); ++j)
        F[j] = at.y[j] - (active[j] ? parent.options_.stiffness * parent.overlap(j, frozen) : 0);
    }
    void jacobian(const Point&, double, std::span<double> values) const override {
      std::fill(values.begin(), values.end(), 1.0);
    }
    void switching(const Point&, std::span<double> values) const override {
      parent.switching({.y = frozen}, values);
    }
    std::vector<AlgebraicStage> algebraic_stages() const override { return {}; }

    const SprungPoints& parent;
    Structure own;
    std::vector<double> frozen;
  };

  double overlap(int j, std::span<const double> y) const {
    return y[0] - options_.borders[j] - y[depth(j)];
  }

  SprungPointsOptions options_;
  Structure structure_;
};

}  // namespace gnomon::testing
