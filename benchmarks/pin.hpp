// The worn pin for benchmarks: its scene on n x n elements, and the coupled system of one of its
// steps.
#pragma once

#include <gnomon/linear/sparse_lu.hpp>
#include <gnomon/model/model.hpp>
#include <gnomon/system/system.hpp>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::bench {

/// The pin at small deformations on n x n elements, with all other keys as in its scene file.
std::unique_ptr<Model> pin_model(int n);

/// Integrates from the model's start to `end` by backward Euler. Returns the last state.
State wear(const Model& model, double step, double end, Counters& counters);

/// The data of a Newton iteration of backward Euler: the state after the first step of 50 s, its
/// Jacobian with alpha = 1/50 s, and a right side with one unit of every row.
struct PinSystem {
  static constexpr double step = 50;  // s
  static constexpr double alpha = 1 / step;

  explicit PinSystem(int n);

  const System& system() const { return model->system(); }
  const Structure& structure() const { return system().structure(); }
  void residual() { system().residual({state.t, state.y, state.ydot}, F); }
  void jacobian() { system().jacobian({state.t, state.y, state.ydot}, alpha, values); }

  std::unique_ptr<Model> model;
  State state;
  std::vector<double> F, values, right_side, x;
  SparseLu lu;  ///< factorized
};

/// The system at n, made when first asked for: Google Benchmark calls a benchmark more than once.
PinSystem& pin_system(int n);

}  // namespace gnomon::bench
