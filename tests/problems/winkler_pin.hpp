// A pin on springs under a cycle, for tests.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <gnomon/system/system.hpp>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "support/problem_run.hpp"

namespace gnomon::winkler_pin {

using namespace testing;

constexpr double R = 5, L = 2, modulus = 70, k = 2e-6, pi = std::numbers::pi;
constexpr int n = 21;

inline double at(int i) {
  return L * (double(i) / (n - 1) - 0.5);
}
inline double profile(int i) {
  return at(i) * at(i) / (2 * R);
}
inline double area(int i) {
  return L / (n - 1) * (i == 0 || i == n - 1 ? 0.5 : 1);
}

inline std::unique_ptr<Model> pin(const std::string& cycle, const Overrides& overrides = {}) {
  const std::string text = fmt::format(R"(problem = "winkler"
pin = {{ radius = {}, width = {} }}
foundation = {{ modulus = {}, points = {} }}
wear.coefficient = {}
integrator = {{ name = "esdirk-4", rtol = 1e-4 }}
time.cycles = 100000
[cycle]
period = 1.0
{})",
                                       R, L, modulus, n, k, cycle);
  return make_model(parse_scene(text, "pin.toml", overrides, key_table));
}

/// d of every point.
using Depths = std::vector<double>;

inline Depths depths_of(const Model& model, const State& state) {
  Depths depths;
  for (std::size_t i = 0; i < state.y.size(); ++i)
    if (model.system().structure().differential[i]) depths.push_back(state.y[i]);
  return depths;
}

/// Pressures at worn depths d under a force: delta by its monotonic balance.
inline std::vector<double> pressures(const Depths& d, double force) {
  double delta = 0;
  for (int i = 0; i < n; ++i) delta = std::max(delta, profile(i) + d[i]);
  delta += force / modulus / L;
  for (double change = 1; change > 1e-16;) {  // Newton's method from above
    double sum = -force, slope = 0;
    for (int i = 0; i < n; ++i)
      if (const double g = delta - profile(i) - d[i]; g > 0)
        sum += area(i) * modulus * g, slope += area(i) * modulus;
    change = sum / slope;
    delta -= change;
  }
  std::vector<double> p;
  for (int i = 0; i < n; ++i) p.push_back(modulus * std::max(0.0, delta - profile(i) - d[i]));
  return p;
}

inline double speed_of_sine(double tau) {
  return 0.1 * pi * std::abs(std::cos(2 * pi * tau));
}

}  // namespace gnomon::winkler_pin
