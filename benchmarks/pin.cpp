#include "pin.hpp"

#include <gnomon/base/error.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <gnomon/model/problem.hpp>
#include <map>

namespace gnomon::bench {

std::unique_ptr<Model> pin_model(int n) {
  const std::string size = std::to_string(n);
  const Scene scene = load_scene(GNOMON_SOURCE_DIR "/problems/pin_on_flat/small_deformation.toml",
                                 {"mesh.elements=[" + size + ", " + size + "]"}, key_table);
  return Problems::find(scene.text("problem"), "problem").make(scene);
}

State wear(const Model& model, double step, double end, Counters& counters) {
  IntegratorSettings settings;
  settings.step = step;
  settings.end = end;
  const auto stepper =
      Integrators::find("backward-euler", "integrator").make(model.system(), settings, counters);
  State state = model.start(counters);
  while (state.t < end) stepper->advance(state, end);
  return state;
}

namespace {

State first_step(const Model& model) {
  Counters counters;
  return wear(model, PinSystem::step, PinSystem::step, counters);
}

}  // namespace

PinSystem::PinSystem(int n)
    : model(pin_model(n)),
      state(first_step(*model)),
      F(structure().size),
      values(structure().pattern.row_index.size()),
      right_side(structure().row_scale),
      x(structure().size),
      lu(structure().pattern, structure().group) {
  jacobian();
  if (!lu.factorize(values)) throw Error("the Jacobian of the pin is singular");
}

PinSystem& pin_system(int n) {
  static std::map<int, std::unique_ptr<PinSystem>> systems;
  auto& system = systems[n];
  if (!system) system = std::make_unique<PinSystem>(n);
  return *system;
}

}  // namespace gnomon::bench
