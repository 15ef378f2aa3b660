#include <gnomon/model/controlled_settings.hpp>
#include <gnomon/stability/stability.hpp>

namespace gnomon {

namespace {

constexpr const char* method = "esdirk-4";

}  // namespace

std::vector<State> accurate_states(const Model& model, std::span<const double> times,
                                   Counters& counters, double rtol) {
  std::vector<State> states;
  if (times.empty()) return states;
  State state = model.start(counters);
  const auto stepper =
      Integrators::find(method, "integrator")
          .make(model.system(), controlled_settings(model, rtol, times.back()), counters);
  for (double time : times) {
    while (state.t < time) stepper->advance(state, time);
    states.push_back(state);
  }
  return states;
}

}  // namespace gnomon
