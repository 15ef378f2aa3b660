// The error budget of a run that has ended, by companions that cost little: larger elements, small
// strains, and wear as a gap over a condensed stiffness.

#include <algorithm>
#include <gnomon/budget/budget.hpp>

#include "budget/companions.hpp"

namespace gnomon {

namespace {

using namespace budget;

/// Of the work of the run; and what may always be spent, about two seconds.
constexpr double part_of_work = 0.2, always = 1e8;

class QuickSearch {
public:
  QuickSearch(const Scene& scene, const Goals& goals, double work, const BudgetHooks& hooks)
      : scene_(ending_at(scene, goals.time)),
        companions_(budget_, hooks),
        own_(scene_),
        ledger_(goals.ledger),
        nodes_(goals.nodes),
        condensation_pays_(condensation_pays(goals, 2)),
        is_small_(0.5 * work <= always) {
    budget_.values = goals.values;
  }

  Budget operator()() {
    const std::vector<Key> keys = scene_.controlling_keys();
    const auto is_mesh = [](const Key& key) { return key.controls->source == ErrorSource::mesh; };
    try {
      if (const auto mesh = std::ranges::find_if(keys, is_mesh); mesh != keys.end())
        companions_.add(*mesh, [&](BudgetPart& part) { find_mesh(*mesh, part); });
      for (const Key& key : keys)
        if (!is_mesh(key)) add_other(key);
    } catch (const Interrupted&) {  // the user does not want to wait for the rest
    }
    respect_ledger(budget_, ledger_);
    return std::move(budget_);
  }

private:
  /// With models that neglect what they can; where they are refused, those of the scene.
  Trial cheap(const Scene& scene, const std::string& what, long unlike = 0) {
    Scene simple = scene;
    for (const Key& key : scene.controlling_keys())
      if (key.controls->source == ErrorSource::model)
        simple = key.controls->scaled(simple, 2).value_or(simple);
    if (!condensation_pays_) simple = without_condensation(simple);
    try {
      if (simpler_) return companions_.run(simple, what, unlike);
    } catch (const MeshUnchanged&) {
      throw;
    } catch (const InputError&) {
      simpler_ = false;
    }
    return companions_.run(scene, what, unlike);
  }

  void find_mesh(const Key& key, BudgetPart& part) {
    if (!key.controls->scaled(scene_, 2)) throw InputError(no_other_mesh);
    for (const double factor : {8, 4}) {
      if (factor == 8 && is_small_) continue;
      try {
        return find_mesh(key, part, factor);
      } catch (const Interrupted&) {
        throw;
      } catch (const Error&) {  // a mesh so coarse cannot be made, or carries no contact
      }
    }
    find_mesh(key, part, 2);
  }

  /// From elements `factor` times as large, and half of that.
  void find_mesh(const Key& key, BudgetPart& part, double factor) {
    const auto larger = key.controls->scaled(scene_, factor),
               smaller = key.controls->scaled(scene_, factor / 2);
    if (!larger || !smaller) throw InputError(no_other_mesh);
    own_ = *larger;
    coarse_ = cheap(own_, "a coarse mesh", nodes_);
    const Trial fine = cheap(*smaller, "a finer mesh", coarse_->goals.nodes);
    part.how = change_text(scene_, fine.scene) + " against " + change_text(scene_, coarse_->scene);
    part.errors = mesh_differences(coarse_->goals, fine.goals);
    const std::vector<double> further = coarser_differences(key, 2 * factor);
    for (std::size_t i = 0; i < further.size(); ++i) {
      const auto [error, order] = extrapolated(part.errors[i], further[i]);
      part.errors[i] = error * std::pow(factor / 2, -order);
    }
  }

  /// Between the coarse mesh and a coarser one, which costs little; not known where there is none.
  std::vector<double> coarser_differences(const Key& key, double factor) {
    try {
      if (const auto scene = key.controls->scaled(scene_, factor))
        return mesh_differences(cheap(*scene, "a coarser mesh", coarse_->goals.nodes).goals,
                                coarse_->goals);
    } catch (const Interrupted&) {
      throw;
    } catch (const Error&) {  // it cannot be made, or carries no contact
    }
    return std::vector<double>(budget_.values.size(), not_known);
  }

  void add_other(const Key& key) {
    const double factor = Finer(key.controls->source).factor;
    if (!key.controls->scaled(scene_, factor)) return;
    companions_.add(key, [&](BudgetPart& part) {
      if (!coarse_) coarse_ = cheap(own_, "the same mesh");
      std::optional<Trial> own;  // of the scene's own model
      if (part.source == ErrorSource::model) own = companions_.run(own_, "the models of the scene");
      const Trial& base = own ? *own : *coarse_;
      const auto scene = key.controls->scaled(base.scene, factor);
      if (!scene) throw InputError("the companions cannot have it finer");
      companions_.compare(part, base, *scene);
    });
  }

  Scene scene_;
  Budget budget_;
  Companions companions_;
  std::optional<Trial> coarse_{};
  Scene own_;  ///< of the companions' mesh, with the scene's own models
  double ledger_;
  long nodes_;
  bool simpler_ = true, condensation_pays_;
  bool is_small_;  ///< companions on elements of twice the size take half of its work, all together
};

}  // namespace

Budget quick_budget(const Scene& scene, const Goals& goals, double work, const BudgetHooks& hooks) {
  BudgetHooks limited = hooks;
  limited.limit = std::min(hooks.limit, std::max(always, part_of_work * work));
  return QuickSearch(scene, goals, work, limited)();
}

}  // namespace gnomon
