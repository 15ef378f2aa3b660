// Runs the processes of a study, and continues where an earlier call stopped.

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <gnomon/base/error.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/study/study.hpp>
#include <set>

#include "study/process_pool.hpp"
#include "study/run_files.hpp"

namespace gnomon {

namespace {

namespace fs = std::filesystem;
using namespace study;

constexpr const char* marker = "study.toml";  // its presence shows that a folder is that of a study
constexpr const char* name_file = "study.name";  // holds the name of the study

/// Locks the folder against a second study while it exists; the lock ends with the process.
class FolderLock {
public:
  explicit FolderLock(const fs::path& folder)
      : descriptor_(open((folder / marker).c_str(), O_RDONLY | O_CLOEXEC)) {
    if (descriptor_ >= 0 && flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
    const int error = errno;
    if (descriptor_ >= 0) close(descriptor_);
    throw InputError(fmt::format(
        "{}: {}", folder.string(),
        error == EWOULDBLOCK ? "another study is running there, expected none" : strerror(error)));
  }
  ~FolderLock() { close(descriptor_); }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

private:
  int descriptor_;
};

void write_in_place(const fs::path& file, const std::string& text) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  const bool written = descriptor >= 0 && write(descriptor, text.data(), text.size()) ==
                                              static_cast<ssize_t>(text.size());
  const int error = errno;
  if (descriptor >= 0) close(descriptor);
  if (!written)
    throw InputError(fmt::format("cannot write {}: {}", file.string(), std::strerror(error)));
}

void check_folder(const StudyOptions& options) {
  std::error_code error;
  if (!fs::exists(options.folder, error)) return;
  if (!fs::is_directory(options.folder, error))
    throw InputError(fmt::format("{}: is a file, expected a folder for the study's results",
                                 options.folder.string()));
  if (fs::is_empty(options.folder, error)) return;
  if (!holds_study(options.folder))
    throw InputError(fmt::format("{}: is not the folder of a study, expected one or a new name",
                                 options.folder.string()));
  if (!options.resume)
    throw InputError(fmt::format("{}: exists already, expected a new name, or --resume to continue",
                                 options.folder.string()));
}

void prepare_folder(const StudyOptions& options, const Study& study) {
  std::error_code error;
  fs::create_directories(options.folder / "runs", error);
  if (error)
    throw InputError(
        fmt::format("cannot make {}: {}", (options.folder / "runs").string(), error.message()));
  // Not replaced by renaming: the lock is on this very file.
  if (!holds_study(options.folder)) write_in_place(options.folder / marker, study.text);
}

/// Prevents that one study replaces the tables of another. A folder without a name is one whose
/// study stopped before it wrote its name.
void claim_folder(const fs::path& folder, const std::string& name) {
  const fs::path file = folder / name_file;
  std::string holder;
  if (std::ifstream stream(file); std::getline(stream, holder) && holder != name)
    throw InputError(fmt::format("{}: holds study \"{}\", expected \"{}\" or an empty folder",
                                 folder.string(), holder, name));
  if (holder.empty()) write_file(file, name + "\n", Earlier::replaced);
}

class StudyRunner {
public:
  StudyRunner(const Study& study, const StudyOptions& options, const StudyHooks& hooks)
      : study_(study), options_(options), hooks_(hooks) {}

  StudyProgress operator()() {
    find_done_runs();
    hooks_.on_progress(progress_);
    std::size_t next = 0;
    while (next < waiting_.size() || pool_.running() > 0) {
      if (hooks_.interrupted()) break;
      while (next < waiting_.size() && pool_.running() < static_cast<std::size_t>(options_.jobs))
        start(waiting_[next++]);
      pool_.wait([&](std::size_t run, const ProcessEnd& end) { finish(run, end); });
    }
    pool_.stop();
    return progress_;
  }

private:
  /// References come first, because they take longest.
  void find_done_runs() {
    progress_.total = study_.runs.size();
    std::set<std::size_t> seen;
    const auto look = [&](std::size_t run, const SweepPoint& sweep) {
      if (!seen.insert(run).second) return;
      const auto record = read_record(files(run), study_.runs[run]);
      if (!record || !is_done(run, *record, sweep)) {
        waiting_.push_back(run);
        return;
      }
      ++progress_.kept;
      ++progress_.done;
      progress_.failed += record->status != "finished";
    };
    for (const SweepPoint& sweep : study_.sweep)
      for (const std::size_t run : sweep.references) look(run, sweep);
    for (const StudyPoint& point : study_.points) look(point.run, study_.sweep[point.sweep]);
  }

  /// A finished run whose surfaces cannot be read is useless; a failed run may have none.
  bool is_done(std::size_t run, const RunRecord& record, const SweepPoint& sweep) const try {
    if (record.status == "finished") read_surfaces(files(run), sweep.times);
    return record.complete;
  } catch (const Error&) {
    return false;
  }

  RunFiles files(std::size_t run) const { return {options_.folder, study_.runs[run].name}; }

  void start(std::size_t run) {
    const RunFiles files = this->files(run);
    remove_files(files);
    write_file(files.scene, study_.runs[run].scene.resolved(), Earlier::replaced);
    Command command{
        .arguments = {options_.program.string(), "run", files.scene.string(), "-o",
                      files.result.string(), "--summary", files.summary.string(), "--quiet"},
        .log = files.log,
        .limit = options_.limit};
    for (const std::string& override_text : study_.runs[run].overrides)
      command.arguments.insert(command.arguments.end(), {"--set", override_text});
    pool_.start(run, command);
  }

  void finish(std::size_t run, const ProcessEnd& end) {
    const RunFiles files = this->files(run);
    if (hooks_.interrupted()) return;  // the same signal may have ended the run
    write_process_end(files, study_.runs[run], end);
    const auto record = read_record(files, study_.runs[run]);
    std::error_code ignored;
    if (fs::is_empty(files.log, ignored)) fs::remove(files.log, ignored);
    ++progress_.done;
    progress_.ended = study_.runs[run].name;
    progress_.reason = record && record->status != "finished" ? record->reason : "";
    progress_.failed += !record || record->status != "finished";
    hooks_.on_progress(progress_);
  }

  const Study& study_;
  const StudyOptions& options_;
  const StudyHooks& hooks_;
  StudyProgress progress_;
  std::vector<std::size_t> waiting_;
  ProcessPool pool_;
};

}  // namespace

bool holds_study(const fs::path& folder) {
  std::error_code ignored;
  return fs::exists(folder / marker, ignored);
}

StudyProgress run_study(const Study& study, const StudyOptions& options, const StudyHooks& hooks) {
  check_folder(options);
  prepare_folder(options, study);
  const FolderLock lock(options.folder);
  claim_folder(options.folder, study.name);
  write_in_place(options.folder / marker, study.text);
  return StudyRunner(study, options, hooks)();
}

}  // namespace gnomon
