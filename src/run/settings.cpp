// What the `integrator.*` and `output.*` keys of a scene mean for a run.

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/error.hpp>
#include <gnomon/run.hpp>

namespace gnomon {

StorePolicy store_policy(const Scene& scene) {
  const double end = scene.real("time.end");
  StorePolicy policy;
  policy.every = scene.integer("output.every");
  policy.times = scene.reals("output.times");
  policy.last = scene.flag("output.last");
  std::sort(policy.times.begin(), policy.times.end());
  policy.times.erase(std::unique(policy.times.begin(), policy.times.end()), policy.times.end());
  if (!policy.times.empty() && policy.times.back() > end)
    throw InputError(fmt::format("{}: expected times up to time.end = {:g} s, got {:g}",
                                 scene.where("output.times"), end, policy.times.back()));
  // The start is stored anyway.
  if (!policy.times.empty() && policy.times.front() == 0) policy.times.erase(policy.times.begin());
  return policy;
}

IntegratorSettings integrator_settings(const Scene& scene, const Model& model) {
  constexpr int default_steps = 200;  // the paper's finest plotted run: 1000 s by 5 s
  IntegratorSettings settings;
  settings.end = scene.real("time.end");
  settings.step = scene.real_if("integrator.step").value_or(settings.end / default_steps);
  settings.rtol = scene.real("integrator.rtol");
  settings.atol = scene.has("integrator.atol") ? scene.real("integrator.atol")
                                               : settings.rtol * model.differential_scale();
  settings.max_step = scene.real_if("integrator.max_step").value_or(0.0);
  settings.max_order = static_cast<int>(scene.integer("integrator.max_order"));
  return settings;
}

}  // namespace gnomon
