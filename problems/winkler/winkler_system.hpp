// The worn pin on springs (see winkler.cpp): the phases of the flat that wears it, one when it
// slides steadily, several with [cycle]; and its equations as a DAE.
#pragma once

#include <algorithm>
#include <functional>
#include <gnomon/cycles/phase_mean.hpp>
#include <gnomon/laws/wear_law.hpp>
#include <gnomon/scene/scene.hpp>
#include <gnomon/system/system.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::winkler {

/// The flat at a position of the cycle.
struct Phase {
  double position = 0;  ///< tau
  double weight = 1;    ///< omega, its part of the mean over the cycle
  double speed = 0;     ///< v_q [mm/s]
  bool held = false;    ///< whether `press` is the approach [mm] instead of the force [N/mm]
  double press = 0;
};

/// Keys of load.force, wear.velocity and [cycle]: what presses and moves the flat.
std::vector<Key> phase_keys();

/// Phases of a cycle.
using PhaseSource = std::function<std::vector<Phase>(const PhaseSet&)>;

/// One phase by load.force and wear.velocity; with a cycle those of cycle.phases, with cycle.force
/// or the approach cycle.y instead of the force, and the speed of cycle.x instead of wear.velocity;
/// then also where others of the cycle come from. Throws InputError.
struct FlatMotion {
  std::vector<Phase> phases;
  PhaseSource phase_set;               ///< empty: there is no cycle
  int parts = 0;                       ///< of the cycle between corners and reversals
  std::vector<std::string> remarks{};  ///< for the user
};
FlatMotion read_flat_motion(const Scene& scene);

/// The mean speed over the cycle [mm/s].
double mean_speed(const std::vector<Phase>& phases);

/// Data of the pin, its springs and the flat, and the trapezoidal points.
struct Foundation : FlatMotion {
  double radius, width;      ///< R, L [mm]
  double modulus;            ///< K_w [MPa/mm]
  double force, speed;       ///< typical F [N/mm] and mean v [mm/s] over the cycle
  WearLaw wear;              ///< of p, v, t, s, x0 and h = d
  double wear_by_pressure;   ///< typical Wdot / p [mm/s/MPa]
  double duration;           ///< of the run [s]
  double mean_depth;         ///< at the end, about [mm]
  std::vector<double> x;     ///< positions of the points [mm]
  std::vector<double> area;  ///< A_i [mm]

  double profile(double at) const { return at * at / (2 * radius); }
  double mean_pressure() const { return force / width; }
};

/// What a wear law sees of a point in a phase; `seen` has pressure, depth and the time, and gets
/// the rest.
inline WearInput wear_input(const Foundation& f, const Phase& phase, std::size_t point,
                            WearInput seen) {
  seen.speed = phase.speed;
  seen.moment.slid = f.speed * seen.moment.time;
  seen.initial = {f.x[point], f.profile(f.x[point]), 0};
  return seen;
}

/// Unknowns d_0, p_0, d_1, p_1, ..., delta; or p_0, p_1, ..., delta with d frozen. In a cycle of P
/// phases every point has P pressures after its d, and there are P deltas. The Jacobian is an
/// arrow: a delta is coupled with every point, a point with no other.
class WinklerSystem : public System {
public:
  WinklerSystem(std::shared_ptr<const Foundation> foundation, bool coupled)
      : foundation_(std::move(foundation)), coupled_(coupled), frozen_(points(), 0.0) {
    structure_.pattern = pattern();
    set_magnitudes();
    structure_.breakpoints = foundation_->wear.breakpoints();
    structure_.stops = foundation_->wear.stops();
    for (int i = 0; i < points(); ++i)
      for (int q = 0; q < phases(); ++q) {
        places_.push_back(
            {position(p(i, q), p(i, q)), position(delta(q), p(i, q)), position(p(i, q), delta(q))});
        if (!coupled_) continue;
        places_.back().wear = position(d(i), p(i, q));
        places_.back().depth = position(p(i, q), d(i));
      }
    for (int q = 0; q < phases(); ++q) in_delta_.push_back(position(delta(q), delta(q)));
    for (int i = 0; coupled_ && i < points(); ++i) in_d_.push_back(position(d(i), d(i)));
  }

  const Structure& structure() const override { return structure_; }

  void residual(const Point& at, std::span<double> F) const override {
    const Foundation& f = *foundation_;
    for (int q = 0; q < phases(); ++q) {
      const Phase& phase = f.phases[q];
      F[delta(q)] = phase.held ? at.y[delta(q)] - phase.press : -phase.press;
    }
    for (int i = 0; i < points(); ++i) {
      if (coupled_) F[d(i)] = at.ydot[d(i)] - mean_wear(at, i);
      for (int q = 0; q < phases(); ++q) {
        const double pressure = at.y[p(i, q)], spring = f.modulus * gap(at.y, i, q);
        F[p(i, q)] = pressure + (closed(at.branch, i, q, spring) ? spring : 0);
        if (!f.phases[q].held) F[delta(q)] += f.area[i] * pressure;
      }
    }
  }

  void jacobian(const Point& at, double alpha, std::span<double> values) const override {
    const Foundation& f = *foundation_;
    std::fill(values.begin(), values.end(), 0.0);
    for (int q = 0; q < phases(); ++q) values[in_delta_[q]] = f.phases[q].held;
    for (int i = 0; i < points(); ++i) {
      if (coupled_) values[in_d_[i]] = alpha;
      for (int q = 0; q < phases(); ++q) {
        const Place& place = places_[i * phases() + q];
        const bool in_contact = closed(at.branch, i, q, f.modulus * gap(at.y, i, q));
        const double by_gap = in_contact ? f.modulus : 0;
        values[place.diagonal] = 1;
        values[place.force] = f.phases[q].held ? 0 : f.area[i];
        values[place.approach] = -by_gap;
        if (!coupled_) continue;
        const WearRate rate = wear(at, i, q);
        values[in_d_[i]] -= f.phases[q].weight * rate.by_depth;
        values[place.wear] = -f.phases[q].weight * rate.by_pressure;
        values[place.depth] = by_gap;
      }
    }
  }

  void switching(const Point& at, std::span<double> values) const override {
    for (int i = 0; i < points(); ++i)
      for (int q = 0; q < phases(); ++q) {
        const std::span<double> own = values.subspan(first_switch(i, q), switches());
        own.front() = foundation_->modulus * gap(at.y, i, q);
        foundation_->wear.switching(wear_input(at, i, q), own.subspan(1));
      }
  }

  /// Mean wear rate of a point of the coupled system over the cycle, on its branch.
  double mean_wear(const Point& at, int i) const {
    double sum = 0;
    for (int q = 0; q < phases(); ++q) sum += foundation_->phases[q].weight * wear(at, i, q).value;
    return sum;
  }

  std::vector<AlgebraicStage> algebraic_stages() const override {
    auto algebraic = std::make_unique<WinklerSystem>(foundation_, false);
    AlgebraicStage stage;
    for (int i = 0; i < points(); ++i)
      for (int q = 0; q < phases(); ++q) stage.unknowns.push_back(p(i, q));
    for (int q = 0; q < phases(); ++q) stage.unknowns.push_back(delta(q));
    stage.freeze = [this, system = algebraic.get()](double, std::span<const double> y) {
      for (int i = 0; i < points(); ++i) system->frozen_[i] = y[d(i)];
    };
    stage.system = std::move(algebraic);
    std::vector<AlgebraicStage> stages;
    stages.push_back(std::move(stage));
    return stages;
  }

  int points() const { return static_cast<int>(foundation_->x.size()); }
  int phases() const { return static_cast<int>(foundation_->phases.size()); }
  int d(int i) const { return (phases() + 1) * i; }
  int p(int i, int q) const { return coupled_ ? d(i) + 1 + q : phases() * i + q; }
  int delta(int q) const { return (phases() + (coupled_ ? 1 : 0)) * points() + q; }
  /// Negative where the springs are compressed [length].
  double gap(std::span<const double> y, int i, int q) const {
    return foundation_->profile(foundation_->x[i]) + (coupled_ ? y[d(i)] : frozen_[i]) -
           y[delta(q)];
  }

private:
  struct Place {
    int diagonal, force, approach;  // positions in the values
    int wear = -1, depth = -1;
  };

  SparsePattern pattern() const {
    PatternBuilder builder(delta(phases()));
    for (int i = 0; i < points(); ++i) {
      if (coupled_) builder.add({d(i)}, {d(i)});
      for (int q = 0; q < phases(); ++q) {
        builder.add({p(i, q), delta(q)}, {p(i, q), delta(q)});
        if (coupled_) builder.add({d(i)}, {p(i, q)}), builder.add({p(i, q)}, {d(i)});
      }
    }
    return builder.build();
  }

  /// A point is a group where it has few unknowns. In a cycle its pressures are not coupled with
  /// each other, and groups, which are stored as if all were, would be nearly full.
  void set_groups(int size) {
    structure_.group.assign(size, points());
    for (int i = 0; i < size; ++i)
      if (phases() > 1)
        structure_.group[i] = i;
      else if (i < delta(0))
        structure_.group[i] = i / (coupled_ ? 2 : 1);
  }

  void set_magnitudes() {
    const Foundation& f = *foundation_;
    const int n = points(), size = delta(phases());
    const double compression = f.mean_pressure() / f.modulus;
    structure_.size = size;
    set_groups(size);
    structure_.differential.assign(size, 0);
    structure_.row_scale.assign(size, f.mean_pressure());
    structure_.unknown_scale.assign(size, f.mean_pressure());
    for (int q = 0; q < phases(); ++q) {
      structure_.row_scale[delta(q)] = f.phases[q].held ? compression : f.force;
      structure_.unknown_scale[delta(q)] = compression;
    }
    for (int i = 0; i < n; ++i) {
      structure_.switch_node.insert(structure_.switch_node.end(), phases() * switches(), i);
      for (int q = 0; q < phases(); ++q) {
        structure_.switch_jumps.push_back(0);
        for (std::size_t k = 0; k + 1 < switches(); ++k)
          structure_.switch_jumps.push_back(f.wear.may_jump(k));
      }
      if (!coupled_) continue;
      structure_.differential[d(i)] = 1;
      structure_.row_scale[d(i)] = f.mean_depth / f.duration;
      structure_.unknown_scale[d(i)] = f.mean_depth;
    }
  }

  /// Wear rate in a phase. A point without pressure has none.
  WearRate wear(const Point& at, int i, int q) const {
    const auto branches =
        at.branch
            ? std::span<const char>(*at.branch).subspan(first_switch(i, q) + 1, switches() - 1)
            : std::span<const char>();
    return foundation_->wear.rate(wear_input(at, i, q), branches);
  }
  WearInput wear_input(const Point& at, int i, int q) const {
    const WearMoment moment{.time = at.t, .within = at.within.value_or(at.t)};
    return winkler::wear_input(
        *foundation_, foundation_->phases[q], i,
        {.pressure = at.y[p(i, q)], .depth = coupled_ ? at.y[d(i)] : frozen_[i], .moment = moment});
  }
  /// Contact in a phase, then the kinks of the wear law.
  std::size_t switches() const { return 1 + foundation_->wear.kinks(); }
  std::size_t first_switch(int i, int q) const {
    return (static_cast<std::size_t>(i) * phases() + q) * switches();
  }
  int position(int row, int column) const { return structure_.pattern.find(row, column); }
  bool closed(const ActiveSet* branch, int i, int q, double switching) const {
    return branch ? (*branch)[first_switch(i, q)] != 0 : switching <= 0;
  }

  std::shared_ptr<const Foundation> foundation_;
  bool coupled_;
  std::vector<double> frozen_;  // d
  Structure structure_;
  std::vector<Place> places_;  // of each point, phase by phase
  std::vector<int> in_d_, in_delta_;
};

}  // namespace gnomon::winkler
