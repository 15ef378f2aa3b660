// gnomon run: integrates a scene, writes its result and summary, and reports how it ended.

#include <fmt/format.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/mesh_file.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/run/run.hpp>
#include <gnomon/run/setup.hpp>
#include <gnomon/run/summary.hpp>
#include <optional>
#include <utility>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/run_end.hpp"

namespace gnomon::app {

namespace {

namespace fs = std::filesystem;

/// A run that has ended, and what belongs to it.
struct Run {
  Setup setup;
  RunHeader header;
  IntegratorSettings settings;
  RunOutcome outcome;
};

/// `make_way`: for the result, once a signal no longer ends the program.
Run run_scene(
    Scene scene, const RunOptions& options, Earlier earlier, const Plan* plan = nullptr,
    const std::function<void()>& make_way = [] {}) {
  Setup setup = [&] {
    const LiveLine line(making_the_model, options.quiet);
    return set_up(std::move(scene));
  }();
  if (!options.quiet) {
    print_remarks(remarks_on_keys(setup));
    print_remarks(setup.model->remarks);
  }
  const RunHeader header = run_header(setup);
  const IntegratorSettings settings = integrator_settings(setup.scene, *setup.model);
  const InterruptGuard guard(
      !options.quiet);  // before the result is created, so that it is always closed
  make_way();
  ResultWriter writer(options.result, header, setup.model->grid, earlier);
  RunOutcome outcome = integrate(setup, settings, writer, options.quiet, nullptr, plan);
  return {std::move(setup), header, settings, std::move(outcome)};
}

/// "failed: DIAGNOSIS", "was interrupted"
std::string ended_text(const RunOutcome& outcome) {
  using Status = RunOutcome::Status;
  return outcome.status == Status::interrupted ? "was interrupted" : outcome.text();
}

void print_unless(bool quiet, const std::string& text) {
  if (quiet) return;
  fmt::print("{}", text);
  std::fflush(stdout);  // what follows takes long
}

/// A result and its sidecar, aside while another run may replace them; they come back unless that
/// one is wanted.
class PutAside {
public:
  explicit PutAside(const fs::path& result) : names_(names_of(result)) {
    for (const fs::path& name : names_) move(name, aside(name));
  }
  PutAside(const PutAside&) = delete;
  PutAside& operator=(const PutAside&) = delete;
  ~PutAside() {
    for (const fs::path& name : names_) move(aside(name), name);
  }
  void drop() {
    std::error_code ignored;
    for (const fs::path& name : names_) fs::remove(aside(name), ignored);
  }
  /// Throws InputError where a killed program has left some, unless they may be removed.
  static void require_none(const fs::path& result, bool may_remove) {
    for (const fs::path& name : names_of(result)) {
      std::error_code ignored;
      if (may_remove)
        fs::remove(aside(name), ignored);
      else if (fs::exists(aside(name), ignored))
        throw InputError(fmt::format(
            "{} exists, of a planned run that was killed in its second run; give it another name, "
            "or --force to remove it",
            aside(name).string()));
    }
  }

private:
  static std::array<fs::path, 2> names_of(const fs::path& result) {
    return {result, fs::path(result).replace_extension(".xdmf")};
  }
  static fs::path aside(fs::path name) { return name += ".before"; }
  static void move(const fs::path& from, const fs::path& to) {
    std::error_code ignored;
    if (fs::exists(from, ignored)) fs::rename(from, to, ignored);
  }
  std::array<fs::path, 2> names_;
};

/// Runs with settings that meet accuracy.within, and again with finer ones where a budget shows
/// that they do not, or not surely.
class PlannedRun {
public:
  PlannedRun(const Scene& asked, const RunOptions& options)
      : asked_(asked), options_(options), quiet_(options.quiet || options.summary == "-") {}

  Run operator()(Earlier earlier) {
    print_unless(quiet_, plan_text(plan_));
    Run run = run_scene(settings_, options_, earlier, &plan_);
    for (int runs = 1; again(run, runs); ++runs) {
    }
    print_unless(quiet_, (run.outcome.budget.empty() ? unknown_accuracy_text(run.outcome)
                                                     : last_text(run.outcome)) +
                             "\n");
    return run;
  }

private:
  std::string unknown_accuracy_text(const RunOutcome& outcome) const {
    using Status = RunOutcome::Status;
    return fmt::format("asked for {:.2g} % in {}: not known, for {}",
                       100 * asked_.real("accuracy.within"),
                       fmt::join(asked_.texts("accuracy.of"), ", "),
                       outcome.status == Status::interrupted ? "the run was interrupted"
                       : outcome.status == Status::failed    ? "the run failed"
                                                             : "it has nothing to compare");
  }

  std::string last_text(const RunOutcome& outcome) const {
    const Budget shown = budget_of_json(outcome.budget);
    const std::string finer = finer_fails_ ? "" : finer_text(asked_, settings_, shown);
    return accuracy_text(asked_, shown) + (finer.empty() ? "" : "; finer would be " + finer);
  }

  /// False: the run stays as it is.
  bool again(Run& run, int runs) {
    if (run.outcome.budget.empty()) return false;
    const Budget shown = budget_of_json(run.outcome.budget);
    const auto finer = refined(plan_, asked_, settings_, shown, runs);
    if (!finer) return false;
    const bool met = wanted_error(asked_, shown) <= asked_.real("accuracy.within");
    print_unless(quiet_, fmt::format("{}\nonce more, {}: {}\n", accuracy_text(asked_, shown),
                                     met ? "to be sure" : "finer", change_text(settings_, *finer)));
    std::optional<PutAside> before;
    finer_fails_ = true;
    try {
      Run next = run_scene(*finer, options_, Earlier::replaced, &plan_,
                           [&] { before.emplace(options_.result); });
      if (next.outcome.status == RunOutcome::Status::finished) {
        before->drop();
        run = std::move(next);
        settings_ = *finer;
        finer_fails_ = false;
        return true;
      }
      print_remarks(
          {"once more it " + ended_text(next.outcome) + ": the result is that of before"});
    } catch (const InputError& error) {  // of the finer mesh
      print_remarks({fmt::format("not done once more: {}", error.what())});
    }
    return false;
  }

  const Scene& asked_;
  const RunOptions& options_;
  bool quiet_;
  KeptMeshes meshes_;
  Plan plan_ = planned(asked_, options_.quiet);
  Scene settings_ = plan_.scene;  ///< of the last run
  bool finer_fails_ = false;
};

}  // namespace

int run_command(const RunOptions& given) {
  RunOptions options = given;
  const Scene scene = checked_scene(options.scene, options.overrides);
  if (options.result.empty())
    options.result = options.scene.stem().string() + "-" + scene.text("integrator.name") + ".h5";
  check_outputs(options);  // before anything that takes time
  const bool was_there = is_taken(options.result);
  if (scene.has("accuracy.within")) PutAside::require_none(options.result, options.force);

  if (!options.quiet) warn_of_slow_blas();
  const Earlier earlier = options.force ? Earlier::replaced : Earlier::refused;
  const auto [setup, header, settings, outcome] = scene.has("accuracy.within")
                                                      ? PlannedRun(scene, options)(earlier)
                                                      : run_scene(scene, options, earlier);
  write_summary(options, summary_json(setup.scene, header, settings, outcome, setup.model->remarks),
                outcome.last.has_value());
  return report_end(outcome, options, setup.model->grid.has_value(), was_there && !outcome.last);
}

}  // namespace gnomon::app
