#include <gnomon/model/controlled_settings.hpp>

namespace gnomon {

IntegratorSettings controlled_settings(const Model& model, double rtol, double end) {
  IntegratorSettings settings;
  settings.rtol = rtol;
  settings.scale = model.differential_scale;
  settings.atol = rtol * settings.scale;
  settings.end = end;
  return settings;
}

}  // namespace gnomon
