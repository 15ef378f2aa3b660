// Models and runs of any shipped scene, and the derivative test of any system.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <gnomon/base/error.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/controlled_settings.hpp>
#include <gnomon/model/problem.hpp>
#include <gnomon/system/system.hpp>
#include <memory>
#include <string>
#include <vector>

namespace gnomon::testing {

using Overrides = std::vector<std::string>;

/// `scene` below problems/, for example "winkler/pin.toml".
inline std::unique_ptr<Model> model_of(const std::string& scene, const Overrides& overrides = {}) {
  const Scene loaded =
      load_scene(std::string(GNOMON_SOURCE_DIR "/problems/") + scene, overrides, key_table);
  return Problems::find(loaded.text("problem"), "problem").make(loaded);
}

/// What is wrong in a scene, or "accepted".
inline std::string refusal(const std::string& scene, const Overrides& overrides) {
  try {
    model_of(scene, overrides);
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

inline double observed(const Model& model, const State& state, const std::string& name) {
  if (const auto value = value_of(model.observe(state), name)) return *value;
  ADD_FAILURE() << "the model observes no " << name;
  return 0;
}

struct ModelRun {
  Counters counters;
  std::vector<State> states;  ///< the start first
  std::vector<StepReport> reports;
  const State& last() const { return states.back(); }
};

/// For run_model: every solve goes on to rounding, so that forces are in balance to rounding.
inline constexpr double to_rounding = 0;

/// `step` 0: error control chooses the steps. `tolerance` is rtol; atol = tolerance *
/// differential_scale. `nonlinear_fraction` is by default that of scenes, and in fixed steps, by
/// which tests compare methods and models, that to rounding.
inline ModelRun run_model(const Model& model, const std::string& integrator, double step,
                          double tolerance, double end, bool locate_events = false,
                          std::optional<double> nonlinear_fraction = {}) {
  ModelRun run;
  run.states.push_back(model.start(run.counters));
  IntegratorSettings settings = controlled_settings(model, tolerance, end);
  settings.step = step;
  settings.nonlinear_fraction = nonlinear_fraction.value_or(step > 0 ? to_rounding : 0.01);
  settings.locate_events = locate_events;
  const auto stepper =
      Integrators::find(integrator, "integrator").make(model.system(), settings, run.counters);
  while (run.last().t < end) {
    State state = run.last();
    run.reports.push_back(stepper->advance(state, end));
    run.states.push_back(std::move(state));
  }
  return run;
}

/// Largest error of the differential components against Model::exact.
inline double error_of(const Model& model, const State& state) {
  const State exact = model.exact(state.t).value();
  const auto& differential = model.system().structure().differential;
  double error = 0;
  for (std::size_t i = 0; i < state.y.size(); ++i)
    if (differential[i]) error = std::max(error, std::abs(state.y[i] - exact.y[i]));
  return error;
}

inline Eigen::MatrixXd dense(const SparsePattern& pattern, const std::vector<double>& values) {
  Eigen::MatrixXd J = Eigen::MatrixXd::Zero(pattern.size(), pattern.size());
  for (int j = 0; j < pattern.size(); ++j)
    for (int k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k)
      J(pattern.row_index[k], j) = values[k];
  return J;
}

/// J = dF/dy + alpha dF/dydot against central differences of F(y + e, ydot + alpha e), with steps
/// of `relative` times the typical size of each unknown. Fails for rows that are zero.
inline void check_jacobian(const System& system, double t, const std::vector<double>& y,
                           double alpha, const ActiveSet* branch = nullptr,
                           double relative = 1e-5) {
  const Structure& structure = system.structure();
  const long n = structure.size;
  std::vector<double> values(structure.pattern.nonzeros());
  std::vector<double> ydot(n);
  for (long i = 0; i < n; ++i) ydot[i] = structure.differential[i] ? 0.01 * double(i + 1) : 0;
  system.jacobian({t, y, ydot, branch}, alpha, values);
  const Eigen::MatrixXd J = dense(structure.pattern, values);
  Eigen::MatrixXd differences(n, n);
  for (long j = 0; j < n; ++j) {
    const double h = relative * structure.unknown_scale[j];
    std::vector<double> up = y, down = y, up_dot = ydot, down_dot = ydot, F_up(n), F_down(n);
    up[j] += h, down[j] -= h;
    up_dot[j] += alpha * h, down_dot[j] -= alpha * h;
    system.residual({t, up, up_dot, branch}, F_up);
    system.residual({t, down, down_dot, branch}, F_down);
    for (long i = 0; i < n; ++i) differences(i, j) = (F_up[i] - F_down[i]) / (2 * h);
  }
  // Row by row, because rows have different units.
  for (long i = 0; i < n; ++i) {
    const double size = differences.row(i).cwiseAbs().maxCoeff();
    ASSERT_GT(size, 0) << "row " << i << " of the Jacobian is zero";
    EXPECT_LE((J.row(i) - differences.row(i)).cwiseAbs().maxCoeff(), 2e-6 * size) << "row " << i;
  }
}

}  // namespace gnomon::testing
