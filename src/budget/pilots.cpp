#include "budget/pilots.hpp"

#include <fmt/format.h>

#include <gnomon/base/error.hpp>

namespace gnomon::budget {

namespace {

bool has_enough_contact(const Goals& goals) {
  return touching_nodes(goals) >= (goals.surface.dim == 2 ? 7 : 12);
}

}  // namespace

Pilots::Pilots(const Scene& asked, Budget& budget, const BudgetHooks& hooks,
               std::vector<std::string>& remarks)
    : scene(asked.without("accuracy.within").without("accuracy.of")), companions_(budget, hooks) {
  for (const Key& key : asked.controlling_keys()) {
    const bool is_choice = !key.controls->judges_only && key.controls->scaled(asked, 2);
    if (key.controls->source == ErrorSource::mesh && is_choice) mesh = key;
    if (key.controls->source == ErrorSource::time && key.controls->scaled(asked, 0.1)) time = key;
  }
  for (const bool of_mesh : {false, true})  // elements by where bodies touch in the chosen phases
    for (const Key& key : asked.controlling_keys()) {
      if (!key.controls->chosen || (key.controls->source == ErrorSource::mesh) != of_mesh) continue;
      const auto failure = failure_of([&] { scene = key.controls->chosen(scene).value_or(scene); });
      if (failure) remarks.push_back(fmt::format("{} stays as it is: {}", key.name, *failure));
    }
}

Scene Pilots::with(Factors factors, Scene other) const {
  if (mesh && factors.mesh != 1)
    other = mesh->controls->scaled(other, factors.mesh).value_or(other);
  if (time && factors.time != 1)
    other = time->controls->scaled(other, factors.time).value_or(other);
  return other;
}

bool Pilots::scales(double factor) const {
  return factor == 1 || (mesh && mesh->controls->scaled(scene, factor));
}

Trial Pilots::coarsest(Factors& factors) {
  std::optional<Trial> found;
  std::string failure;
  for (const double factor : {8.0, 4.0, 2.0, 1.0, 0.5}) {
    if (!scales(factor)) continue;
    try {
      found =
          run({factor, factors.time}, fmt::format("a pilot on {} times as large elements", factor));
      factors.mesh = factor;
      if (!mesh || has_enough_contact(found->goals)) break;
    } catch (const Interrupted&) {
      throw;
    } catch (const SolutionError& error) {
      failure = error.what();
    } catch (const InputError& error) {
      if (factor == 1 || !mesh) throw;
      failure = error.what();
    }
  }
  if (!found) throw SolutionError("no pilot run succeeds: " + failure);
  return std::move(*found);
}

}  // namespace gnomon::budget
