#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <gnomon/base/error.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/study/study.hpp>
#include <map>
#include <sstream>

#include "study/process_pool.hpp"
#include "study/run_claim.hpp"
#include "study/run_files.hpp"
#include "study/study_folder.hpp"

namespace gnomon {

namespace {

namespace fs = std::filesystem;
using namespace study;
using Clock = std::chrono::steady_clock;

/// Slurm's default of MaxArraySize allows numbers of array tasks up to this.
constexpr std::size_t largest_task = 1000;

/// Jobs of a run, one after the other, without progress: then it is left.
constexpr int most_fruitless = 3;

/// Text as one word of a shell.
std::string shell_word(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

/// The number in the last line "JOB" or "JOB;CLUSTER" that sbatch has printed: a site's own sbatch
/// may print further ones. Throws Error without any.
std::string job_in(const std::string& output) {
  std::string job;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    const std::string number = line.substr(0, line.find(';'));
    if (!number.empty() && number.find_first_not_of("0123456789") == std::string::npos)
      job = number;
  }
  if (job.empty())
    throw Error(
        fmt::format("sbatch --parsable has printed no number of a job, but `{}`; its job, if "
                    "there is one, is not waited for",
                    first_line(output)));
  return job;
}

Captured run_slurm(const std::vector<std::string>& command) {
  Captured end = run_captured(command);
  if (end.exit_code == 127)
    throw Error(fmt::format("cannot start {}: is Slurm installed here?", command.front()));
  return end;
}

class SlurmExecutor {
public:
  SlurmExecutor(const Study& study, const StudyOptions& options, const SlurmOptions& slurm,
                const StudyHooks& hooks)
      : study_(study),
        options_(options),
        slurm_(slurm),
        hooks_(hooks),
        folder_(fs::absolute(options.folder)),
        own_(folder_ / "slurm") {}

  StudyProgress operator()() {
    fs::create_directories(own_ / "log");
    missing_ = missing_runs(study_, folder_);
    progress_.total = study_.runs.size();
    progress_.kept = progress_.done = progress_.total - missing_.size();
    hooks_.on_progress(progress_);
    jobs_ = jobs_of_before();
    while (wait_for_jobs() && !missing_.empty()) {
      judge_progress();
      const std::vector<std::size_t> worth = worth_another_job();
      if (worth.empty()) break;
      if (submitted_)
        hooks_.on_warning(fmt::format(
            "runs that are not done and have no job in the queue are submitted again: {}",
            worth.size()));
      submit(worth);
      submitted_ = true;
    }
    return progress_;
  }

private:
  /// Until all are done or no job is left. False after an interruption.
  bool wait_for_jobs() {
    for (;;) {
      const bool left = look_at_jobs();  // before the folder, which then holds all they have made
      look_at_folder();
      if (missing_.empty() || !left) return !hooks_.interrupted();
      for (const auto end = Clock::now() + std::chrono::duration<double>(slurm_.poll);
           Clock::now() < end; ProcessPool::pause())
        if (hooks_.interrupted()) return false;
    }
  }

  void look_at_folder() {
    const std::vector<std::size_t> missing = missing_runs(study_, folder_);
    if (missing.size() == missing_.size()) return;
    missing_ = missing;
    progress_.done = progress_.total - missing_.size();
    hooks_.on_progress(progress_);
  }

  /// Whether a job is waiting or runs. Forgets those that Slurm does not know any more.
  bool look_at_jobs() {
    std::erase_if(jobs_, [this](const std::string& job) {
      const Captured seen = run_slurm({"squeue", "--noheader", "--format=%i", "--jobs=" + job});
      if (seen.exit_code == 0) {
        last_refusal_.clear();
        return seen.out.find(job) == std::string::npos;
      }
      if (seen.err.find("Invalid job id") != std::string::npos) return true;
      const std::string reason = first_line(seen.err);  // Slurm does not answer
      if (reason != last_refusal_)
        hooks_.on_warning(fmt::format("squeue has failed and is asked again: {}", reason));
      last_refusal_ = reason;
      return false;
    });
    return !jobs_.empty();
  }

  std::vector<std::string> jobs_of_before() const {
    std::vector<std::string> jobs;
    std::ifstream stream(own_ / "jobs");
    for (std::string job; std::getline(stream, job);)
      if (!job.empty()) jobs.push_back(job);
    return jobs;
  }

  /// Every run that is not done has had a job that is no more; one that came further is worth
  /// another.
  void judge_progress() {
    for (const std::size_t run : missing_) {
      const double reached = reached_by_attempts(folder_, study_.runs[run].name);
      History& history = histories_[run];
      history.fruitless = reached > history.reached ? 0 : history.fruitless + 1;
      history.reached = std::max(history.reached, reached);
    }
  }

  std::vector<std::size_t> worth_another_job() const {
    std::vector<std::size_t> worth;
    for (const std::size_t run : missing_)
      if (histories_.at(run).fruitless < most_fruitless) worth.push_back(run);
    return worth;
  }

  void submit(std::vector<std::size_t> runs) {
    write_script();
    std::sort(runs.begin(), runs.end());
    for (auto begin = runs.begin(); begin != runs.end();) {
      const std::size_t offset = *begin / largest_task * largest_task;
      const auto end = std::find_if(begin, runs.end(),
                                    [&](std::size_t run) { return run >= offset + largest_task; });
      std::vector<std::size_t> tasks(begin, end);
      for (std::size_t& task : tasks) task -= offset;
      submit_array(numbers_of(tasks), offset);
      begin = end;
    }
  }

  void submit_array(const std::string& tasks, std::size_t offset) {
    std::vector<std::string> command = {
        "sbatch",
        "--parsable",
        "--job-name=gnomon-" + study_.name,
        "--array=" + tasks + (slurm_.at_most > 0 ? fmt::format("%{}", slurm_.at_most) : ""),
        "--output=" + (own_ / "log" / "%A_%a").string(),
        "--open-mode=append"};
    command.insert(command.end(), slurm_.sbatch.begin(), slurm_.sbatch.end());
    command.insert(command.end(), {(own_ / "job.sh").string(), std::to_string(offset)});
    const Captured answer = run_slurm(command);
    if (answer.exit_code != 0)
      throw Error(fmt::format("sbatch refuses the study: {}", first_line(answer.err)));
    jobs_.push_back(job_in(answer.out));
    write_file(own_ / "jobs", fmt::format("{}\n", fmt::join(jobs_, "\n")), Earlier::replaced);
  }

  /// One task of an array. The shell becomes gnomon, so that signals reach it.
  void write_script() const {
    write_file(own_ / "job.sh",
               fmt::format("#!/bin/sh\n"
                           "# A run of the study; sbatch is called by gnomon study.\n"
                           "export OMP_NUM_THREADS=\"${{OMP_NUM_THREADS:-"
                           "${{SLURM_CPUS_PER_TASK:-1}}}}\"\n"
                           "exec {} study run {} \"$(($1 + SLURM_ARRAY_TASK_ID))\" --jobs 1 "
                           "--quiet --lost-after {:g}\n",
                           shell_word(options_.program.string()), shell_word(folder_.string()),
                           options_.lost_after),
               Earlier::replaced);
  }

  /// Of a run: the time its attempts have reached, and how many jobs did not bring it further.
  struct History {
    double reached = 0;
    int fruitless = -1;  // none has been submitted
  };

  const Study& study_;
  const StudyOptions& options_;
  const SlurmOptions& slurm_;
  const StudyHooks& hooks_;
  const fs::path folder_, own_;
  StudyProgress progress_;
  std::vector<std::size_t> missing_;
  std::vector<std::string> jobs_;
  std::map<std::size_t, History> histories_;
  std::string last_refusal_;  // of squeue
  bool submitted_ = false;
};

}  // namespace

StudyProgress run_study_by_slurm(const Study& study, const StudyOptions& options,
                                 const SlurmOptions& slurm, const StudyHooks& hooks) {
  const FolderLock lock = claimed_folder(study, options.folder, options.resume);
  return SlurmExecutor(study, options, slurm, hooks)();
}

}  // namespace gnomon
