// Does the runs of a study, and continues where an earlier process stopped.

#include <signal.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <gnomon/base/error.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/study/study.hpp>
#include <map>

#include "study/process_pool.hpp"
#include "study/run_claim.hpp"
#include "study/run_files.hpp"
#include "study/study_folder.hpp"
#include "study/text_file.hpp"

namespace gnomon {

namespace {

namespace fs = std::filesystem;
using namespace study;
using Clock = std::chrono::steady_clock;

/// Every run once, with a sweep point it belongs to; references come first, because they take
/// longest.
std::vector<std::pair<std::size_t, std::size_t>> runs_in_order(const Study& study) {
  std::vector<std::pair<std::size_t, std::size_t>> runs;
  std::vector<bool> seen(study.runs.size(), false);
  const auto add = [&](std::size_t run, std::size_t sweep) {
    if (!seen[run]) runs.push_back({run, sweep});
    seen[run] = true;
  };
  for (std::size_t i = 0; i < study.sweep.size(); ++i)
    for (const std::size_t run : study.sweep[i].references) add(run, i);
  for (const StudyPoint& point : study.points) {
    add(point.run, point.sweep);
    if (point.half) add(*point.half, point.sweep);
  }
  return runs;
}

/// The record of a run that is done. A finished run whose surfaces cannot be read is useless; a
/// failed run may have none.
std::optional<RunRecord> record_of_done(const Study& study, const fs::path& folder, std::size_t run,
                                        const SweepPoint& sweep) try {
  const RunFiles files = files_of_run(folder, study.runs[run].name);
  const auto record = read_record(files, study.runs[run]);
  if (!record || !record->complete) return std::nullopt;
  if (record->status == "finished") read_observed(files);
  if (record->status == "finished" && study.compared) read_surfaces(files, sweep.times);
  return record;
} catch (const Error&) {
  return std::nullopt;
}

class StudyRunner {
public:
  StudyRunner(const Study& study, const StudyOptions& options, const StudyHooks& hooks,
              bool wait_for_others)
      : study_(study), options_(options), hooks_(hooks), wait_for_others_(wait_for_others) {
    for (const auto& [run, sweep] : runs_in_order(study)) sweep_of_[run] = sweep;
  }

  StudyProgress operator()(const std::vector<std::size_t>& runs) {
    progress_.total = runs.size();
    for (const std::size_t run : runs)
      if (!keep_if_done(run)) waiting_.push_back({run, std::nullopt});
    hooks_.on_progress(progress_);
    while (!hooks_.interrupted() && (!waiting_.empty() || !watched_.empty() || !claims_.empty())) {
      while (!waiting_.empty() && claims_.size() < static_cast<std::size_t>(options_.jobs))
        begin_next();
      pool_.wait([&](std::size_t run, const ProcessEnd& end) { finish(run, end); });
      give_signs();
      watch_others();
      if (claims_.empty() && waiting_.empty() && !watched_.empty()) ProcessPool::pause();
    }
    pool_.stop([&](std::size_t run, const ProcessEnd& end) { finish(run, end); });
    return progress_;
  }

private:
  /// A run that this process does.
  struct Active {
    RunClaim claim;
    bool resumed = false;
  };
  /// A run to begin; `lost`: the sign of another process that has lost it.
  struct Waiting {
    std::size_t run;
    std::optional<Sign> lost;
  };
  /// A run that another process does, and when its sign of life was last seen to change.
  struct Watched {
    Sign sign;
    Clock::time_point since;
  };

  bool keep_if_done(std::size_t run) {
    const SweepPoint& sweep = study_.sweep[sweep_of_.at(run)];
    const auto record = record_of_done(study_, options_.folder, run, sweep);
    if (!record) return false;
    ++progress_.kept;
    ++progress_.done;
    progress_.failed += record->status != "finished";
    progress_.ended.clear();
    return true;
  }

  void begin_next() {
    const auto [run, lost] = waiting_.front();
    waiting_.pop_front();
    Sign busy;
    const auto claim = RunClaim::take(options_.folder, study_.runs[run].name, lost, busy);
    if (!claim) {
      watched_[run] = {busy, Clock::now()};
    } else if (keep_if_done(run)) {  // by a process that has given its claim back in the meantime
      claim->remove_attempts();
      hooks_.on_progress(progress_);
    } else {
      start(run, claims_.insert_or_assign(run, Active{*claim}).first->second);
    }
  }

  void start(std::size_t run, Active& active) {
    const RunFiles files = active.claim.files();
    active.resumed = take_over(run, active.claim);
    write_file(files.scene, study_.runs[run].scene, Earlier::replaced);
    Command command{
        .arguments = {options_.program.string()}, .log = files.log, .limit = options_.limit};
    const auto add = [&](const std::vector<std::string>& arguments) {
      command.arguments.insert(command.arguments.end(), arguments.begin(), arguments.end());
    };
    if (active.resumed)
      add({"resume", files.result.string()});
    else
      add({"run", files.scene.string(), "-o", files.result.string()});
    add({"--summary", files.summary.string(), "--quiet"});
    if (!active.resumed)
      for (const std::string& override_text : study_.runs[run].overrides)
        add({"--set", override_text});
    pool_.start(run, command);
  }

  RunFiles files_before(std::size_t run, const RunClaim& claim) const {
    return {claim.before()->folder, study_.runs[run].name};
  }

  /// Takes the result of an attempt at the same run that was interrupted or lost, to be resumed.
  bool take_over(std::size_t run, const RunClaim& claim) const {
    if (!claim.before()) return false;
    const RunFiles mine = claim.files(), before = files_before(run, claim);
    if (read_text(before.scene) != study_.runs[run].scene) return false;
    std::error_code error, ignored;
    if (!claim.before()->at_rest) {
      if (!copy_at_rest(before.result, mine.result)) return false;  // a new run writes both files
      fs::copy_file(before.sidecar, mine.sidecar, ignored);
      return true;
    }
    fs::rename(before.result, mine.result, error);
    if (!error) fs::rename(before.sidecar, mine.sidecar, ignored);
    return !error;
  }

  /// Of a run with the attempts that it continues.
  static ProcessEnd sum_of(const Active& active, ProcessEnd end) {
    if (!active.resumed) return end;
    const ProcessEnd& before = active.claim.before()->sum;
    end.cpu_seconds += before.cpu_seconds;
    end.peak_memory_mb = std::max(end.peak_memory_mb, before.peak_memory_mb);
    return end;
  }

  void finish(std::size_t run, const ProcessEnd& end) {
    const auto found = claims_.find(run);
    Active& active = found->second;
    const ProcessEnd sum = sum_of(active, end);
    if (active.resumed && end.signal == 0 && end.exit_code == 2) {
      // Not to be resumed: the next attempt begins anew.
      remove_result(active.claim.files());
      remove_result(files_before(run, active.claim));
      active.claim.end({});
      waiting_.push_back({run, std::nullopt});
    } else if (was_interrupted(active.claim.files(), end)) {
      active.claim.end(sum);
      waiting_.push_back({run, std::nullopt});  // unless this process ends, too
    } else {
      record_end(run, active.claim, sum);
    }
    claims_.erase(found);
  }

  /// The signal that ends this process may have ended the run.
  bool was_interrupted(const RunFiles& files, const ProcessEnd& end) const {
    if (end.timed_out) return false;
    if (end.signal == 0) return is_interrupted(files);
    return hooks_.interrupted() || end.signal == SIGTERM || end.signal == SIGINT;
  }

  void record_end(std::size_t run, const RunClaim& claim, const ProcessEnd& end) {
    const RunFiles files = claim.files();
    write_process_end(files, study_.runs[run], end);
    std::error_code ignored;
    if (fs::is_empty(files.log, ignored)) fs::remove(files.log, ignored);
    if (!claim.publish()) {
      waiting_.push_back({run, std::nullopt});
      return;
    }
    const auto record =
        read_record(files_of_run(options_.folder, study_.runs[run].name), study_.runs[run]);
    ++progress_.done;
    progress_.ended = study_.runs[run].name;
    progress_.reason = record && record->status != "finished" ? record->reason : "";
    progress_.failed += !record || record->status != "finished";
    hooks_.on_progress(progress_);
  }

  /// Several signs fit into the time after which a run counts as lost.
  void give_signs() {
    if (Clock::now() < next_sign_) return;
    next_sign_ = after(options_.lost_after / 6);
    for (auto active = claims_.begin(); active != claims_.end();) {
      const std::size_t run = active->first;
      const bool mine = active->second.claim.beat(sum_of(active->second, pool_.so_far(run)));
      if (!mine) pool_.kill(run);
      active = mine ? std::next(active) : claims_.erase(active);
      if (!mine) waiting_.push_back({run, std::nullopt});
    }
  }

  /// A run whose owner gives no sign is done here; one whose owner lives is waited for, or left.
  void watch_others() {
    if (Clock::now() < next_look_) return;
    next_look_ = after(std::min(1.0, options_.lost_after / 20));
    for (auto entry = watched_.begin(); entry != watched_.end();) {
      const std::size_t run = entry->first;
      const auto now = RunClaim::sign(options_.folder, study_.runs[run].name);
      if (keep_if_done(run)) {
        hooks_.on_progress(progress_);
        entry = watched_.erase(entry);
      } else if (!now) {  // its owner has ended
        entry = watched_.erase(entry);
        waiting_.push_back({run, std::nullopt});
      } else if (*now == entry->second.sign) {
        const bool lost =
            Clock::now() - entry->second.since > std::chrono::duration<double>(options_.lost_after);
        if (lost) waiting_.push_back({run, *now});
        entry = lost ? watched_.erase(entry) : std::next(entry);
      } else if (wait_for_others_) {
        entry->second = {*now, Clock::now()};
        ++entry;
      } else {
        ++progress_.others;
        entry = watched_.erase(entry);
      }
    }
  }

  static Clock::time_point after(double seconds) {
    return Clock::now() +
           std::chrono::round<Clock::duration>(std::chrono::duration<double>(seconds));
  }

  const Study& study_;
  const StudyOptions& options_;
  const StudyHooks& hooks_;
  const bool wait_for_others_;
  std::map<std::size_t, std::size_t> sweep_of_;
  StudyProgress progress_;
  std::deque<Waiting> waiting_;
  std::map<std::size_t, Active> claims_;
  std::map<std::size_t, Watched> watched_;
  Clock::time_point next_sign_{}, next_look_{};
  ProcessPool pool_;
};

}  // namespace

StudyProgress run_study(const Study& study, const StudyOptions& options, const StudyHooks& hooks) {
  const FolderLock lock = claimed_folder(study, options.folder, options.resume);
  std::vector<std::size_t> runs;
  for (const auto& [run, sweep] : runs_in_order(study)) runs.push_back(run);
  return StudyRunner(study, options, hooks, true)(runs);
}

StudyProgress run_planned(const Study& planned, const std::vector<std::size_t>& runs,
                          const StudyOptions& options, const StudyHooks& hooks) {
  Study study = planned;
  for (const std::size_t run : runs)
    study.runs[run].scene = text_of(files_of_run(options.folder, study.runs[run].name).scene);
  return StudyRunner(study, options, hooks, false)(runs);
}

std::vector<std::size_t> missing_runs(const Study& study, const fs::path& folder) {
  std::vector<std::size_t> missing;
  for (const auto& [run, sweep] : runs_in_order(study))
    if (!record_of_done(study, folder, run, study.sweep[sweep])) missing.push_back(run);
  return missing;
}

}  // namespace gnomon
