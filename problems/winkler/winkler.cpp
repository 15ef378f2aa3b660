// winkler: the worn pin on a bed of springs instead of an elastic body (a Winkler foundation; K. L.
// Johnson, Contact Mechanics, sec. 4.3), inexpensive with thousands of points and solved in closed
// form.
//
// Points x_i, equally spaced over [-L/2, L/2] with both ends, carry the trapezoidal areas A_i. With
// the gap g_i = x_i^2/(2R) + d_i - delta of the undeformed surface, d the wear depth, delta the
// approach:
//
//   d_i:    ddot_i - Wdot(p_i, v, d_i, t) = 0, by default k v p_i
//   p_i:    p_i + K_w g_i = 0 (closed, g_i <= 0)   or   p_i = 0 (open)
//   delta:  sum_i A_i p_i - F = 0
//
// so that with the default the wear flux, sum_i A_i k v p_i, is k v F exactly. The switching
// functions are K_w g_i, and the kinks of the wear law. In a cycle (docs/cycles.md) each phase has
// its p_i and delta, by its own force or with its own given delta, and d the mean of their wear.
//
// Closed form of the continuum for that default in steady sliding. The contact half width a grows;
// at its edge p = d = 0, so that delta = a^2/(2R), and the balance of forces with the worn area k v
// F t gives
//
//   2 a^3/(3R) = F/K_w + k v F t:   a = a_0 s^(1/3),  delta = delta_0 s^(2/3),  s = 1 + kappa t,
//
// kappa = K_w k v, a_0^3 = 3 R F/(2 K_w), delta_0 = a_0^2/(2R). Where there is contact,
// ddot = kappa (delta - x^2/(2R) - d); from the first touch, s_0 = max(1, xi^3) with xi = |x|/a_0,
//
//   d(x, t) = delta_0 integral from s_0 to s of (sigma^(2/3) - xi^2) exp(sigma - s) dsigma,
//   p(x, t) = K_w (delta - x^2/(2R) - d),
//
// which holds as long as a <= L/2. The discrete pressure differs from it by O(h^2) and the depth by
// O(h^3), h = L/(n - 1) (see the tests).

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/stepper.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/newton/algebraic_solver.hpp>

#include "foundation_scene.hpp"
#include "winkler_system.hpp"

namespace gnomon {

namespace {

using winkler::Foundation;
using winkler::Phase;
using winkler::WinklerSystem;

/// Integral over [low, high] by Gauss-Legendre with ten points in each panel of length at most one.
template <class Function>
double integral(double low, double high, const Function& f) {
  constexpr double node[] = {0.14887433898163121, 0.43339539412924719, 0.67940956829902441,
                             0.86506336668898451, 0.97390652851717172};
  constexpr double weight[] = {0.29552422471475287, 0.26926671930999636, 0.21908636251598204,
                               0.14945134915058059, 0.06667134430868814};
  if (high <= low) return 0;
  const int panels = static_cast<int>(std::ceil(high - low));
  const double half = (high - low) / (2 * panels);
  double sum = 0;
  for (int k = 0; k < panels; ++k) {
    const double middle = low + (2 * k + 1) * half;
    for (int g = 0; g < 5; ++g)
      sum += half * weight[g] * (f(middle - half * node[g]) + f(middle + half * node[g]));
  }
  return sum;
}

class WinklerModel : public Model {
public:
  /// `steady`: one phase, whose wear rate is proportional to the pressure: the solution is known.
  WinklerModel(std::shared_ptr<const Foundation> foundation, bool steady)
      : foundation_(std::move(foundation)), system_(foundation_, true) {
    const long n = system_.points();
    phases = system_.phases();
    blocks = {{"worn_surface", "d", n, "points (differential)"},
              {"pressure", "p", n * phases, "points, each phase"},
              {"approach", "delta", phases, "the pin, each phase"}};
    differential_scale = foundation_->mean_depth;
    remarks = foundation_->remarks;
    wear_flux = [this](const Point& at) { return flux(at); };
    if (steady) exact = [this](double t) { return solution(t); };
    if (foundation_->phase_set)
      phase_error = [this](const State& state) {
        std::vector<double> depths;
        for (int i = 0; i < system_.points(); ++i) depths.push_back(state.y[system_.d(i)]);
        return winkler::phase_error(*foundation_, state.t, depths);
      };
  }

  const System& system() const override { return system_; }

  State start(Counters& counters) const override {
    const Foundation& f = *foundation_;
    State state{0, std::vector<double>(system_.structure().size, 0.0), {}};
    // From full contact Newton only ever opens points: the force is convex in delta.
    for (int q = 0; q < system_.phases(); ++q) {
      const Phase& phase = f.phases[q];
      state.y[system_.delta(q)] =
          phase.held ? phase.press : f.profile(f.width / 2) + phase.press / f.width / f.modulus;
    }
    const std::string reason = AlgebraicSolver(system_, counters).solve(state.t, state.y);
    if (!reason.empty()) throw SolutionError("no equilibrium at t = 0: " + reason);
    set_rates(system_, nullptr, state);
    return state;
  }

  /// The same scalars as for a worn body (WearModel), without the quality of elements: of a cycle
  /// mean force and flux, the largest pressure and half width.
  Observation observe(const State& state) const override {
    const Foundation& f = *foundation_;
    const int phases = system_.phases();
    double force = 0, worn = 0, depth = 0, pressure = 0, half_width = 0;
    long active = 0;
    for (int i = 0; i < system_.points(); ++i) {
      worn += f.area[i] * state.y[system_.d(i)];
      depth = std::max(depth, state.y[system_.d(i)]);
      active += touches(state.y, i);
      for (int q = 0; q < phases; ++q) {
        const double p = state.y[system_.p(i, q)];
        force += f.phases[q].weight * f.area[i] * p;
        pressure = std::max(pressure, p);
      }
    }
    for (int q = 0; q < phases; ++q) half_width = std::max(half_width, half_width_in(q, state.y));
    const double wear = flux({.t = state.t, .y = state.y, .branch = state.own_branch()});
    return {common("contact_nodes", double(active)),
            common("contact_force", force),
            common("max_pressure", pressure),
            common("worn_volume", worn),
            common("wear_flux", wear),
            common("contact_half_width", half_width),
            common("wear_depth", depth)};
  }
  std::vector<GridField> fields(const State&) const override { return {}; }

  std::optional<ContactSurface> contact(const State& state) const override {
    const Foundation& f = *foundation_;
    ContactSurface surface;
    const int n = system_.points(), phases = system_.phases();
    for (int i = 0; i < n; ++i) {
      const double y = f.profile(f.x[i]), d = state.y[system_.d(i)];
      double mean = 0;
      for (int q = 0; q < phases; ++q) mean += f.phases[q].weight * pressure(state.y, i, q);
      surface.node.push_back(i);
      surface.initial.push_back({f.x[i], y, 0});
      surface.worn.push_back({f.x[i], y + d, 0});
      surface.current.push_back({f.x[i], std::max(0.0, system_.gap(state.y, i, 0)), 0});
      surface.pressure.push_back(mean);
      surface.wear_depth.push_back(d);
      surface.active.push_back(touches(state.y, i));
    }
    for (int q = 0; phases > 1 && q < phases; ++q) {
      surface.phase_position.push_back(f.phases[q].position);
      surface.phase_weight.push_back(f.phases[q].weight);
      for (int i = 0; i < n; ++i) surface.phase_pressure.push_back(pressure(state.y, i, q));
    }
    return surface;
  }

private:
  std::optional<State> solution(double t) const {
    constexpr double memory = 40;  // exp(-40) is below rounding
    const Foundation& f = *foundation_;
    const double a_0 = std::cbrt(1.5 * f.radius * f.force / f.modulus);
    const double kappa = f.modulus * f.wear_by_pressure, s = 1 + kappa * t;
    if (a_0 * std::cbrt(s) > f.width / 2) return std::nullopt;
    State state{t, std::vector<double>(system_.structure().size, 0.0), {}};
    state.ydot = state.y;
    for (int i = 0; i < system_.points(); ++i) {
      const double xi = std::abs(f.x[i]) / a_0;
      const double first = std::max(1.0, xi * xi * xi);
      if (s < first) continue;
      const double depth = integral(std::max(first, s - memory), s, [=](double sigma) {
        return (std::cbrt(sigma * sigma) - xi * xi) * std::exp(sigma - s);
      });
      const double delta_0 = f.profile(a_0);
      state.y[system_.d(i)] = delta_0 * depth;
      state.ydot[system_.d(i)] = kappa * delta_0 * (std::cbrt(s * s) - xi * xi - depth);
    }
    return state;
  }

  double flux(const Point& at) const {
    double sum = 0;
    for (int i = 0; i < system_.points(); ++i)
      sum += foundation_->area[i] * system_.mean_wear(at, i);
    return sum;
  }
  double pressure(std::span<const double> y, int i, int q) const {
    return std::max(0.0, y[system_.p(i, q)]);
  }
  /// In any phase.
  bool touches(std::span<const double> y, int i) const {
    for (int q = 0; q < system_.phases(); ++q)
      if (system_.gap(y, i, q) <= 0) return true;
    return false;
  }

  /// Half the distance between the zeros of the gap, linear between points.
  double half_width_in(int phase, std::span<const double> y) const {
    const int n = system_.points();
    int first = 0, last = n - 1;
    while (first < n && system_.gap(y, first, phase) > 0) ++first;
    while (last > first && system_.gap(y, last, phase) > 0) --last;
    if (first == n) return 0;
    const auto edge = [&](int in, int out) {
      if (out < 0 || out >= n) return foundation_->x[in];
      const double g_in = system_.gap(y, in, phase), g_out = system_.gap(y, out, phase);
      return foundation_->x[in] +
             (foundation_->x[out] - foundation_->x[in]) * g_in / (g_in - g_out);
    };
    return (edge(last, last + 1) - edge(first, first - 1)) / 2;
  }

  std::shared_ptr<const Foundation> foundation_;
  WinklerSystem system_;
};

std::unique_ptr<Model> make(const Scene& scene) {
  const bool known = !scene.has("cycle.period") && winkler::has_archard_rate(scene);
  return std::make_unique<WinklerModel>(winkler::read_foundation(scene), known);
}

const Registration<Problem> registration({
    .name = "winkler",
    .help = "2D parabolic pin on a bed of springs, worn by a sliding rigid flat; solved exactly",
    .keys = winkler::foundation_keys(),
    .make = make,
});

}  // namespace

}  // namespace gnomon
