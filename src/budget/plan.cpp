#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/budget/plan.hpp>

#include "budget/choices.hpp"
#include "budget/extrapolation.hpp"
#include "budget/pilots.hpp"
#include "budget/trade.hpp"
#include "budget/wanted.hpp"

namespace gnomon {

namespace {

using namespace budget;

class Planner {
public:
  Planner(const Scene& scene, const BudgetHooks& hooks)
      : asked_(scene), within_(read_within(scene)), pilots_(scene, budget_, hooks, remarks_) {
    trade_.free_time = pilots_.time && !scene.is_set(pilots_.time->name);
    trade_.free_mesh = pilots_.mesh && !scene.is_set(pilots_.mesh->name);
  }

  Plan operator()() {
    if (trade_.free_time) pilot_.time = time_of_pilots;
    coarse_ = pilots_.coarsest(pilot_);
    places_ = wanted_places(asked_, coarse_->goals.values);
    const bool fewer_phases = takes_fewer_phases();
    for (const Key& key : asked_.controlling_keys())
      if (key.controls->source == ErrorSource::model) try_simpler(key);
    knows_mesh_ = attempt("mesh", [&] { measure_mesh(); });
    trade_.free_mesh &= knows_mesh_;
    knows_time_ = attempt("time", [&] { measure_time(); });
    trade_.free_time &= knows_time_;
    if (!fewer_phases) attempt("phases", [&] { measure_phases(); });
    Plan plan{.scene = settings_for(choice_for(within_), within_),
              .lines = {},
              .known = {},
              .remarks = {}};
    for (const double part : {2.0, 1.0, 0.5, 0.25}) plan.lines.push_back(line_for(part * within_));
    plan.pilot_seconds = budget_.companion_seconds;
    plan.known = std::move(known_);
    plan.remarks = std::move(remarks_);
    remark_on_given(plan);
    return plan;
  }

private:
  /// A pilot that fails leaves a part of the error unknown; the scene's own setting stays then.
  bool attempt(const std::string& part, const std::function<void()>& measure) {
    const auto failure = failure_of(measure);
    if (failure)
      remarks_.push_back(
          fmt::format("the error of the {} is not part of the plan: {}", part, *failure));
    return !failure;
  }

  /// Goes on with a quarter, or half, of the phases that the plan has taken, where that changes
  /// little: all other runs cost as much less. Returns whether it does.
  bool takes_fewer_phases() {
    for (const Key& key : pilots_.scene.controlling_keys())
      for (const double factor : {4.0, 2.0}) {
        if (key.controls->source != ErrorSource::phases || asked_.is_set(key.name)) break;
        const Scene base = pilots_.with(pilot_);
        const auto fewer = key.controls->scaled(base, factor);
        if (!fewer || !goes_on_with(*fewer, key, change_text(base, *fewer))) continue;
        pilots_.scene = *key.controls->scaled(pilots_.scene, factor);
        return true;
      }
    return false;
  }

  bool goes_on_with(const Scene& fewer, const Key& key, const std::string& how) {
    constexpr double little = 0.1;  // of what may be
    bool is_enough = false;
    failure_of([&] {
      Trial trial = pilots_.run(fewer, how);
      const double error = largest_inside(differences(coarse_->goals, trial.goals));
      is_enough = error <= little * within_;
      if (!is_enough) return;
      choices_.phases = {key, error};
      coarse_ = std::move(trial);
    });
    return is_enough;
  }

  /// Goes on with the simpler of two models, where the scene does not give one and the error is a
  /// small part of what may be. One that is given is judged.
  void try_simpler(const Key& key) {
    const bool given = asked_.is_set(key.name);
    const auto other = key.controls->scaled(pilots_.scene, given ? 0.5 : 2);
    if (!other) return;
    const Scene own = pilots_.scene;
    const std::string how = change_text(own, *other);
    const auto failure = failure_of([&] {
      pilots_.scene = *other;
      Trial trial = pilots_.run(pilot_, how);
      std::vector<double> errors = differences(coarse_->goals, trial.goals);
      bool goes_on = !given && largest_inside(errors) <= small_part * within_;
      if (!given && !goes_on && pilot_.mesh > 1 && pilots_.scales(pilot_.mesh / 2)) {
        errors = differences_on_finer(own, *other, how);
        goes_on = largest_inside(errors) <= small_part * within_;
      }
      if (!given)
        choices_.models.push_back({.key = key,
                                   .error = largest_inside(errors),
                                   .rest = largest(errors, places_),
                                   .saved = coarse_->cpu_seconds / trial.cpu_seconds,
                                   .is_taken = goes_on});
      if (goes_on || given)
        add_known({.source = ErrorSource::model, .key = key.name, .how = how, .errors = errors});
      if (goes_on)
        coarse_ = std::move(trial);
      else
        pilots_.scene = own;
    });
    if (failure) pilots_.scene = own;  // the model does not suit the scene
  }

  double largest_inside(const std::vector<double>& errors) const {
    return largest(errors, without_ends(places_, coarse_->goals.values));
  }

  /// Between two models, where the nodes that touch are twice as many: on few of them one that
  /// closes earlier makes more of a difference than the models do.
  std::vector<double> differences_on_finer(const Scene& own, const Scene& other,
                                           const std::string& how) {
    const Factors finer{pilot_.mesh / 2, pilot_.time};
    pilots_.scene = own;
    const Trial base = pilots_.run(finer, "a pilot on elements of half this size");
    pilots_.scene = other;
    return differences(base.goals, pilots_.run(finer, how).goals);
  }

  /// A part of the error that stays, known from a pilot run.
  void add_known(BudgetPart part) {
    for (double& each : part.errors) each = std::abs(each);
    part.how += ", by a pilot run";
    trade_.rest += largest(part.errors, places_);
    known_.push_back(std::move(part));
  }

  void measure_mesh() {
    trade_.seconds = coarse_->cpu_seconds;
    trade_.coarsest = pilot_.mesh;
    if (!pilots_.mesh || !pilots_.scales(pilot_.mesh / 2)) return judge_mesh();
    const Factors finer{pilot_.mesh / 2, pilot_.time};
    std::optional<Trial> finer_trial;
    try {
      finer_trial = pilots_.run(pilots_.with(finer), "a pilot on elements of half this size",
                                &coarse_->goals);
    } catch (const MeshUnchanged&) {
      if (pilot_.mesh > 1) {  // the geometry makes them as large; others may be smaller
        pilot_ = finer;
        return measure_mesh();
      }
      trade_.free_mesh = false;
      pilot_.mesh = 1;
      return judge_mesh();
    }
    // Large elements may follow each other on lines so short that they are the same there.
    if (pilot_.mesh > 1 && !why_not_refined(coarse_->goals, finer_trial->goals).empty()) {
      coarse_ = std::move(finer_trial);
      pilot_ = finer;
      return measure_mesh();
    }
    learn_mesh(*coarse_, *finer_trial, finer.mesh, places_, trade_);
    measure_finer(std::move(*finer_trial), finer.mesh);
  }

  /// Few nodes touch on coarse elements, so that chance has a part in what they differ by: goes on
  /// to elements that are less than four times as large as those that the plan would take.
  void measure_finer(Trial last, double factor) {
    while (trade_.free_mesh && 4 * cheapest(trade_, within_).mesh <= factor) {
      factor /= 2;
      const auto failure = failure_of([&] {
        Trial next = pilots_.run({factor, pilot_.time}, "a pilot on elements of half this size");
        learn_mesh(last, next, factor, places_, trade_);
        last = std::move(next);
      });
      if (failure) return;
    }
  }

  /// A mesh that is given stays; what it is wrong by, a finer one tells.
  void judge_mesh() {
    std::string failure = "there is no other mesh";
    for (const OtherMesh& other : other_meshes(asked_)) {
      if (other.is_coarser) continue;
      const auto failed = failure_of([&] { judge_mesh_by(other.key); });
      if (!failed) return;
      failure = *failed;
    }
    throw InputError(failure);
  }

  void judge_mesh_by(const Key& key) {
    const Scene base = pilots_.with(pilot_), half = *key.controls->scaled(base, 0.5);
    const Trial fine = pilots_.run(half, "a pilot on a finer mesh", &coarse_->goals);
    BudgetPart part{.source = ErrorSource::mesh,
                    .key = key.name,
                    .how = change_text(base, half),
                    .errors = errors_of_coarser(coarse_->goals, fine.goals)};
    remarks_.push_back(fmt::format(
        "the mesh is given, its error is {:.2g} %; with {} it would be less, for {:.2g} "
        "times the work",
        100 * largest(part.errors, places_), part.how, fine.work / coarse_->work));
    add_known(std::move(part));
  }

  void measure_time() {
    if (!pilots_.time) return;
    const Trial finer =
        pilots_.run({pilot_.mesh, pilot_.time / 10}, "a pilot with a tenth of the tolerance");
    const double difference = largest(differences(coarse_->goals, finer.goals), places_);
    trade_.time = difference * Finer(ErrorSource::time).part_of_coarser / pilot_.time;
    trade_.cost_time = std::clamp(std::log10(finer.work / coarse_->work), 0.05, 1.0);
    trade_.seconds *= std::pow(pilot_.time, trade_.cost_time);
  }

  /// Those that the scene gives stay, with what they are wrong by; otherwise there are so many that
  /// this is a small part of what may be.
  void measure_phases() {
    for (const Key& key : pilots_.scene.controlling_keys()) {
      if (key.controls->source != ErrorSource::phases) continue;
      const Finer finer(ErrorSource::phases);
      const auto scene = key.controls->scaled(pilots_.with(pilot_), finer.factor);
      if (!scene) continue;
      const Trial trial = pilots_.run(*scene, "a pilot with more phases");
      const double error =
          largest_inside(differences(coarse_->goals, trial.goals)) * finer.part_of_coarser;
      if (asked_.is_set(key.name)) {
        remarks_.push_back(
            fmt::format("{} is given: its error is {:.2g} %", key.name, 100 * error));
        trade_.rest += error;
      } else {
        choices_.phases = {key, error};
      }
    }
  }

  Choice choice_for(double within) const {
    return choices_.for_error(within, {pilots_.scene, trade_});
  }

  Scene settings_for(const Choice& choice, double within) const {
    return pilots_.with(cheapest(choice.trade, within), choice.scene);
  }

  PlanLine line_for(double within) const {
    const Choice choice = choice_for(within);
    PlanLine line = predicted(choice.trade, cheapest(choice.trade, within));
    line.within = within;
    if (!knows_mesh_) line.mesh = not_known;
    if (!knows_time_) line.time = not_known;
    line.settings = change_text(asked_.without("accuracy.of"), settings_for(choice, within));
    return line;
  }

  /// What it costs that the scene gives settings.
  void remark_on_given(Plan& plan) const {
    Trade all = choice_for(within_).trade;
    all.free_mesh = trade_.mesh > 0;
    all.free_time = pilots_.time.has_value();
    const double seconds = predicted(all, cheapest(all, within_)).cpu_seconds;
    std::vector<std::string> given;
    if (all.free_mesh && !trade_.free_mesh) given.push_back(pilots_.mesh->name);
    if (all.free_time && !trade_.free_time) given.push_back(pilots_.time->name);
    if (!given.empty())
      plan.remarks.push_back(fmt::format(
          "{} {} given: the run takes about {:.2g} s of CPU, with the plan's own choice "
          "about {:.2g} s",
          fmt::join(given, ", "), given.size() == 1 ? "is" : "are", plan.chosen().cpu_seconds,
          seconds));
  }

  static constexpr double time_of_pilots = 10;  ///< times the default of the tolerance

  const Scene& asked_;
  double within_;
  Budget budget_;
  std::vector<std::string> remarks_;
  Pilots pilots_;
  Factors pilot_;
  std::optional<Trial> coarse_{};
  std::vector<std::size_t> places_;
  Trade trade_;
  bool knows_mesh_ = false, knows_time_ = false;
  std::vector<BudgetPart> known_;
  Choices choices_;
};

}  // namespace

Plan plan_of(const Scene& scene, const BudgetHooks& hooks) {
  return Planner(scene, hooks)();
}

}  // namespace gnomon
