// The error budget of a run that has ended, by companions that cost little: larger elements, small
// strains, and wear as a gap over a condensed stiffness.

#include <algorithm>
#include <gnomon/budget/budget.hpp>

#include "budget/companions.hpp"
#include "budget/extrapolation.hpp"

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
        goals_(goals),
        finer_is_cheap_(goals.surface.dim == 2 && 4 * work <= hooks.limit),
        is_small_(0.5 * work <= always),
        may_repeat_(8 * work <= always) {
    budget_.values = goals.values;
  }

  Budget operator()() {
    try {
      companions_.add_mesh(scene_, goals_, [&](const OtherMesh& other, BudgetPart& part) {
        other.is_coarser ? find_mesh(other.key, part) : find_mesh_by_finer(other.key, part);
      });
      companions_.add_given_phases(scene_);
      for (const Key& key : scene_.controlling_keys())
        if (key.controls->source != ErrorSource::mesh) add_other(key);
    } catch (const Interrupted&) {  // the user does not want to wait for the rest
    }
    respect_ledger(budget_, goals_.ledger);
    return std::move(budget_);
  }

private:
  /// With models that neglect what they can; where they are refused, those of the scene.
  Trial cheap(const Scene& scene, const std::string& what, const Goals* unlike = nullptr) {
    Scene simple = scene;
    for (const Key& key : scene.controlling_keys())
      if (key.controls->source == ErrorSource::model)
        simple = key.controls->scaled(simple, 2).value_or(simple);
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
    for (const double factor : {8, 4}) {
      if (factor == 8 && is_small_) continue;
      // A mesh so coarse may be one that cannot be made, or that carries no contact.
      if (!failure_of([&] { find_mesh(key, part, factor); })) return;
    }
    find_mesh(key, part, 2);
  }

  /// From elements `factor` times as large, and half of that.
  void find_mesh(const Key& key, BudgetPart& part, double factor) {
    const auto larger = key.controls->scaled(scene_, factor),
               smaller = key.controls->scaled(scene_, factor / 2);
    if (!larger || !smaller) throw InputError("there is no mesh of elements so large");
    coarse_ = cheap(*larger, "a coarse mesh", &goals_);
    own_ = *larger;
    const Trial fine = cheap(*smaller, "a finer mesh", &coarse_->goals);
    part.how = change_text(scene_, fine.scene) + " against " + change_text(scene_, coarse_->scene);
    require_refined_contact(coarse_->goals, fine.goals);
    const std::vector<double> before = coarser_differences(key, 2 * factor);
    std::vector<double> changes = mesh_differences(coarse_->goals, fine.goals);
    forget_without_value(coarse_->goals, budget_.values, changes, part.doubt);
    extrapolate(part, budget_.values, changes, before, factor / 2);
    respect_run(mesh_differences(fine.goals, goals_), mesh_differences(coarse_->goals, goals_),
                factor / 2, part.errors);
  }

  /// From elements of half the size.
  void find_mesh_by_finer(const Key& key, BudgetPart& part) {
    if (!finer_is_cheap_) throw InputError(too_long);
    const Scene half = *key.controls->scaled(scene_, 0.5);
    coarse_ = cheap(scene_, "the same mesh");
    own_ = scene_;
    const Trial fine = cheap(half, "a finer mesh", &goals_);
    part.how = change_text(scene_, half);
    require_refined_contact(coarse_->goals, fine.goals);
    part.errors = errors_of_coarser(coarse_->goals, fine.goals);
  }

  /// Between the coarse mesh and a coarser one, which costs little; not known where there is none.
  std::vector<double> coarser_differences(const Key& key, double factor) {
    std::vector<double> found(budget_.values.size(), not_known);
    failure_of([&] {
      if (const auto scene = key.controls->scaled(scene_, factor))
        found = mesh_differences(cheap(*scene, "a coarser mesh", &coarse_->goals).goals,
                                 coarse_->goals);
    });
    return found;
  }

  void add_other(const Key& key) {
    if (!key.controls->scaled(scene_, Finer(key.controls->source).factor)) return;
    companions_.add(key, [&](BudgetPart& part) {
      // Nodes that come into contact make errors of their own, on each mesh others.
      if (part.source == ErrorSource::time && may_repeat_)
        return companions_.compare(part, {scene_, goals_}, key);
      if (!coarse_) coarse_ = cheap(own_, "the same mesh");
      const Trial& base = part.source == ErrorSource::model ? with_own_models() : *coarse_;
      companions_.compare(part, base, key);
      if (part.source == ErrorSource::phases) respect_profile(budget_.values, part.errors);
    });
  }

  /// On the companions' mesh.
  const Trial& with_own_models() {
    if (own_models_) return *own_models_;
    const bool is_coarse = Scene::differing_keys(coarse_->scene, own_).empty();
    own_models_ = is_coarse ? *coarse_ : companions_.run(own_, "the models of the scene");
    return *own_models_;
  }

  Scene scene_;
  Budget budget_;
  Companions companions_;
  std::optional<Trial> coarse_{}, own_models_{};
  Scene own_;  ///< of the companions' mesh, with the scene's own models
  const Goals& goals_;
  bool simpler_ = true;
  bool finer_is_cheap_;  ///< in space it would take eight times the memory of the run
  bool is_small_;  ///< companions on elements of twice the size take half of its work, all together
  bool may_repeat_;  ///< the run itself with a smaller tolerance, as often as that takes steps
};

}  // namespace

Budget quick_budget(const Scene& scene, const Goals& goals, double work, const BudgetHooks& hooks) {
  BudgetHooks limited = hooks;
  limited.limit = std::min(hooks.limit, std::max(always, part_of_work * work));
  return QuickSearch(scene, goals, work, limited)();
}

}  // namespace gnomon
