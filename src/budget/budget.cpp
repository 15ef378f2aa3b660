#include <algorithm>
#include <cmath>
#include <gnomon/budget/budget.hpp>

#include "budget/companions.hpp"
#include "budget/extrapolation.hpp"

namespace gnomon {

namespace {

using namespace budget;

class Search {
public:
  /// `must_be_sure`: the error in time costs more than the run.
  Search(Trial run, const BudgetHooks& hooks, bool must_be_sure)
      : hooks_(hooks),
        companions_(budget_, hooks),
        run_(std::move(run)),
        must_be_sure_(must_be_sure) {
    budget_.values = run_.goals.values;
    budget_.run_seconds = run_.cpu_seconds;
    run_.scene = ending_at(run_.scene, run_.goals.time);
  }

  Budget operator()() {
    try {
      find();
    } catch (const Interrupted&) {
      if (must_be_sure_) throw;
    }  // else the run has ended, and the user does not want to wait for the rest
    respect_ledger(budget_, run_.goals.ledger);
    return std::move(budget_);
  }

private:
  void find() {
    if (hooks_.wants(ErrorSource::mesh))
      companions_.add_mesh(run_.scene, run_.goals, [&](const OtherMesh& other, BudgetPart& part) {
        other.is_coarser ? find_mesh(other.key, part) : find_mesh_by_finer(other.key, part);
      });
    if (hooks_.wants(ErrorSource::phases)) companions_.add_given_phases(run_.scene);
    for (const Key& key : run_.scene.controlling_keys())
      if (key.controls->source != ErrorSource::mesh && hooks_.wants(key.controls->source))
        add_other(key);
  }

  void find_mesh(const Key& key, BudgetPart& part) {
    const Scene twice = *key.controls->scaled(run_.scene, 2);
    Trial coarse = companions_.run(twice, "twice as large elements", &run_.goals);
    part.how = change_text(run_.scene, twice);
    require_refined_contact(coarse.goals, run_.goals);
    const std::vector<double> before = coarser_differences(key, coarse, part);
    std::vector<double> changes = mesh_differences(coarse.goals, run_.goals);
    forget_without_value(coarse.goals, budget_.values, changes, part.doubt);
    extrapolate(part, budget_.values, changes, before);
    coarse_ = std::move(coarse);
    coarse_is_ = change_text(run_.scene, twice);
  }

  void find_mesh_by_finer(const Key& key, BudgetPart& part) {
    const Scene half = *key.controls->scaled(run_.scene, 0.5);
    const Trial fine = companions_.run(half, "elements of half the size", &run_.goals);
    part.how = change_text(run_.scene, half);
    require_refined_contact(run_.goals, fine.goals);
    part.errors = errors_of_coarser(run_.goals, fine.goals);
  }

  /// From the mesh of twice as large elements to that of four times as large ones. Not known where
  /// there is no such mesh, or no run on it.
  std::vector<double> coarser_differences(const Key& key, const Trial& coarse, BudgetPart& part) {
    std::vector<double> found(budget_.values.size(), not_known);
    failure_of([&] {
      const auto four = key.controls->scaled(run_.scene, 4);
      if (!four) return;
      const Trial coarser = companions_.run(*four, "four times as large elements", &coarse.goals);
      part.how += ", " + change_text(run_.scene, *four);
      found = mesh_differences(coarser.goals, coarse.goals);
    });
    return found;
  }

  void add_other(const Key& key) {
    // Steps that follow nodes as they close depend on the mesh, and so do phases: in which the last
    // node closes, and which nodes wear deepest.
    const ErrorSource source = key.controls->source;
    const bool on_own_mesh =
        !coarse_ || source == ErrorSource::phases || (must_be_sure_ && source == ErrorSource::time);
    const Trial& base = on_own_mesh ? run_ : *coarse_;
    if (!key.controls->scaled(base.scene, Finer(source).factor)) return;
    companions_.add(key, [&](BudgetPart& part) {
      companions_.compare(part, base, key);
      if (!on_own_mesh) part.how += ", with " + coarse_is_;
    });
  }

  const BudgetHooks& hooks_;
  Budget budget_;
  Companions companions_;
  Trial run_;
  bool must_be_sure_;
  std::optional<Trial> coarse_{};
  std::string coarse_is_{};
};

}  // namespace

Budget find_budget(const Scene& scene, const BudgetHooks& hooks) {
  hooks.on_run("the run itself");
  const KeptMeshes meshes;
  return Search(try_scene(scene, [&](double) { return hooks.interrupted(); }), hooks, true)();
}

Budget find_budget(const Scene& scene, const Goals& goals, const BudgetHooks& hooks) {
  return Search({.scene = scene, .goals = goals}, hooks, false)();
}

bool BudgetHooks::wants(ErrorSource source) const {
  return std::ranges::find(sources, source) != sources.end();
}

double Budget::total(std::size_t value) const {
  double sum = not_known;
  for (const BudgetPart& part : parts) {
    const double error = part.errors[value];
    if (std::isnan(error) && !part.doubt.empty()) return not_known;
    if (!std::isnan(error)) sum = std::isnan(sum) ? error : sum + error;
  }
  return sum;
}

}  // namespace gnomon
