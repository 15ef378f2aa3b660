// The worn pin for tests, made from its scene file, as by a user.
#pragma once

#include <algorithm>
#include <gnomon/model/wear_model.hpp>
#include <memory>
#include <string>

#include "support/problem_run.hpp"

namespace gnomon::testing {

inline Scene pin_scene(const Overrides& overrides = {}) {
  return load_scene(GNOMON_SOURCE_DIR "/problems/pin_on_flat/small_deformation.toml", overrides,
                    key_table);
}

inline std::unique_ptr<Model> pin_model(const Overrides& overrides = {}) {
  return model_of("pin_on_flat/small_deformation.toml", overrides);
}

/// "mesh.elements=[n, n]"
inline std::string elements(int n) {
  return "mesh.elements=[" + std::to_string(n) + ", " + std::to_string(n) + "]";
}

/// A run and all its states.
struct PinRun : ModelRun {
  std::unique_ptr<Model> model;

  double observed(const std::string& name) const { return testing::observed(*model, last(), name); }
  /// Largest worn depth at the end [mm].
  double worn_depth() const { return std::ranges::max(model->contact(last()).value().wear_depth); }
  /// Worn positions of the contact surface at the end, one after the other.
  Eigen::VectorXd worn_surface() const {
    const ContactSurface surface = model->contact(last()).value();
    Eigen::VectorXd X(3 * surface.worn.size());
    for (std::size_t c = 0; c < surface.worn.size(); ++c)
      for (int i = 0; i < 3; ++i) X[3 * c + i] = surface.worn[c][i];
    return X;
  }
};

/// Runs the pin to `end`. `tolerance` is rtol; atol = tolerance * model.differential_scale.
inline PinRun run_pin(const std::string& integrator, double step, double tolerance, double end,
                      const Overrides& overrides = {}, bool locate_events = false,
                      std::optional<double> nonlinear_fraction = {}) {
  auto model = pin_model(overrides);
  ModelRun run =
      run_model(*model, integrator, step, tolerance, end, locate_events, nonlinear_fraction);
  return {std::move(run), std::move(model)};
}

}  // namespace gnomon::testing
