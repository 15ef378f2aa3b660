// The worn pin for tests: built from its own scene file, as a user would.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include <gnomon/integrator.hpp>
#include <gnomon/problem.hpp>
#include <gnomon/wear_model.hpp>

namespace gnomon::testing {

using Overrides = std::vector<std::string>;

inline Scene pin_scene(const Overrides& overrides = {}) {
  return load_scene(GNOMON_SOURCE_DIR "/problems/pin_on_flat/small_deformation.toml", overrides,
                    key_table);
}

inline std::unique_ptr<Model> pin_model(const Overrides& overrides = {}) {
  const Scene scene = pin_scene(overrides);
  return Problems::find(scene.text("problem"), "problem").make(scene);
}

/// "mesh.elements=[n, n]"
inline std::string elements(int n) {
  return "mesh.elements=[" + std::to_string(n) + ", " + std::to_string(n) + "]";
}

inline double observed(const Model& model, const State& state, const std::string& name) {
  for (const Scalar& scalar : model.observe(state))
    if (scalar.name == name) return scalar.value;
  ADD_FAILURE() << "the model observes no " << name;
  return 0;
}

/// A run and all its states.
struct PinRun {
  std::unique_ptr<Model> model;
  Counters counters;
  std::vector<State> states;  ///< the start first
  std::vector<StepReport> reports;

  const State& last() const { return states.back(); }
  double observed(const std::string& name) const {
    return testing::observed(*model, last(), name);
  }
  /// Worn positions of the contact surface at the end, one after the other.
  Eigen::VectorXd worn_surface() const {
    const ContactSurface surface = model->contact(last()).value();
    Eigen::VectorXd X(3 * surface.worn.size());
    for (std::size_t c = 0; c < surface.worn.size(); ++c)
      for (int i = 0; i < 3; ++i) X[3 * c + i] = surface.worn[c][i];
    return X;
  }
};

/// Runs the pin to `end`. `tolerance` is rtol; atol = tolerance * model.differential_scale().
inline PinRun run_pin(const std::string& integrator, double step, double tolerance, double end,
                      const Overrides& overrides = {}, bool locate_events = false) {
  PinRun run;
  run.model = pin_model(overrides);
  run.states.push_back(run.model->start(run.counters));
  IntegratorSettings settings;
  settings.step = step;
  settings.rtol = tolerance;
  settings.scale = run.model->differential_scale();
  settings.atol = tolerance * settings.scale;
  settings.end = end;
  settings.locate_events = locate_events;
  const auto stepper =
      Integrators::find(integrator, "integrator").make(*run.model, settings, run.counters);
  while (run.states.back().t < end) {
    State state = run.states.back();
    run.reports.push_back(stepper->advance(state, end));
    run.states.push_back(std::move(state));
  }
  return run;
}

}  // namespace gnomon::testing
