// The settings of a run whose steps follow the error, before a scene or a test changes more.
#pragma once

#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/model.hpp>

namespace gnomon {

/// Steps by the error to the time `end`, within rtol of the positions and of the model's typical
/// wear depth. Everything else is as in IntegratorSettings: steps are solved to rounding, and no
/// event is located.
inline IntegratorSettings controlled_settings(const Model& model, double rtol, double end) {
  IntegratorSettings settings;
  settings.rtol = rtol;
  settings.scale = model.differential_scale;
  settings.atol = rtol * settings.scale;
  settings.end = end;
  settings.max_step = model.longest_step;
  settings.behind_jump = model.behind_jump;
  return settings;
}

}  // namespace gnomon
