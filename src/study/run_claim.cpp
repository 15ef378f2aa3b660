#include "study/run_claim.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <gnomon/base/error.hpp>
#include <gnomon/base/number_text.hpp>
#include <gnomon/results/result_files.hpp>
#include <gnomon/results/versions.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "study/process_pool.hpp"
#include "study/run_files.hpp"
#include "study/text_file.hpp"

namespace gnomon::study {

namespace {

namespace fs = std::filesystem;

constexpr const char* owner_file = "owner.json";
constexpr const char* ended_file = "ended.json";

fs::path attempts_of(const fs::path& study, const std::string& name) {
  return study / "tries" / name;
}

/// When a process of this machine was started, in a form that no later process with its number has;
/// empty if there is none.
std::string start_of(long process) {
  std::istringstream fields(process_stat(process));
  std::string field;
  for (int i = 3; i <= 22; ++i) fields >> field;
  return field;
}

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

/// Where numbers of processes have a meaning: since the machine started, among the processes that
/// see each other (a container sees its own).
std::string place_of_processes() {
  std::error_code ignored;
  return read_text("/proc/sys/kernel/random/boot_id") +
         fs::read_symlink("/proc/self/ns/pid", ignored).string();
}

/// Whether the owner was a process of this machine that has ended.
bool is_dead(const Json& owner) {
  const long process = owner.value("process", 0L);
  if (process <= 0 || owner.value("place", "") != place_of_processes()) return false;
  return start_of(process) != owner.value("start", "");
}

/// The greatest number of an attempt; 0 without any.
int latest_attempt(const fs::path& attempts) {
  int latest = 0;
  std::error_code error;
  for (fs::directory_iterator entry(attempts, error), end; !error && entry != end;
       entry.increment(error)) {
    const auto number = parsed_number<int>(entry->path().filename().string());
    latest = std::max(latest, number.value_or(0));
  }
  return latest;
}

Sign sign_of(const fs::path& attempt, int number) {
  return {number, read_json(attempt / owner_file).value("beat", 0L)};
}

bool has_ended(const fs::path& attempt) {
  std::error_code ignored;
  return fs::exists(attempt / ended_file, ignored) || is_dead(read_json(attempt / owner_file));
}

/// What an attempt has told of itself, at its end or before: costs, versions.
Json account_of(const fs::path& attempt) {
  const Json ended = read_json(attempt / ended_file);
  return ended.empty() ? read_json(attempt / owner_file) : ended;
}

void add_account(nlohmann::ordered_json& json, const ProcessEnd& sum) {
  json["cpu_seconds"] = sum.cpu_seconds;
  json["peak_memory_mb"] = sum.peak_memory_mb;
  json["versions"] = library_versions();
}

[[noreturn]] void fail(const fs::path& folder, int error) {
  throw Error(fmt::format("cannot make {}: {}", folder.string(), std::strerror(error)));
}

/// Makes the folder; false if another process was faster.
bool make_alone(const fs::path& folder) {
  if (mkdir(folder.c_str(), 0777) == 0) return true;
  if (errno != EEXIST && errno != ENOENT) fail(folder, errno);  // no parent: just removed
  return false;
}

}  // namespace

double reached_by_attempts(const fs::path& study, const std::string& name) {
  const fs::path attempts = attempts_of(study, name);
  double reached = 0;
  for (int number = latest_attempt(attempts); number > 0; --number)
    reached =
        std::max(reached, checkpointed_time(RunFiles(attempts / std::to_string(number), name)));
  return reached;
}

RunClaim::RunClaim(fs::path study, std::string name, int number)
    : study_(std::move(study)),
      folder_(attempts_of(study_, name) / std::to_string(number)),
      name_(std::move(name)),
      number_(number) {}

std::optional<RunClaim> RunClaim::take(const fs::path& study, const std::string& name,
                                       const std::optional<Sign>& lost, Sign& busy) {
  const fs::path attempts = attempts_of(study, name);
  for (;;) {
    std::error_code error;
    fs::create_directories(attempts, error);
    if (error) fail(attempts, error.value());
    const int latest = latest_attempt(attempts);
    const fs::path before = attempts / std::to_string(latest);
    if (latest > 0) {
      busy = sign_of(before, latest);
      if (!has_ended(before) && busy != lost) return std::nullopt;
    }
    RunClaim claim(study, name, latest + 1);
    if (!make_alone(claim.folder_)) continue;
    if (!claim.is_latest()) {  // made where others had begun anew in the meantime
      fs::remove(claim.folder_, error);
      continue;
    }
    claim.before_ = claim.attempt_before();
    claim.beat(claim.before_ ? claim.before_->sum : ProcessEnd{});
    return claim;
  }
}

/// The latest with a result: one after it may have been lost before it took the result over.
std::optional<EndedAttempt> RunClaim::attempt_before() const {
  for (int number = number_ - 1; number > 0; --number) {
    const fs::path attempt = folder_.parent_path() / std::to_string(number);
    std::error_code ignored;
    if (!fs::exists(RunFiles(attempt, name_).result, ignored)) continue;
    const Json account = account_of(attempt);
    if (account.value("versions", Json()) != Json(library_versions())) return std::nullopt;
    EndedAttempt before{attempt, has_ended(attempt), {}};
    before.sum.cpu_seconds = account.value("cpu_seconds", 0.0);
    before.sum.peak_memory_mb = account.value("peak_memory_mb", 0.0);
    return before;
  }
  return std::nullopt;
}

std::optional<Sign> RunClaim::sign(const fs::path& study, const std::string& name) {
  const fs::path attempts = attempts_of(study, name);
  const int latest = latest_attempt(attempts);
  const fs::path attempt = attempts / std::to_string(latest);
  if (latest == 0 || has_ended(attempt)) return std::nullopt;
  return sign_of(attempt, latest);
}

bool RunClaim::is_latest() const {
  return latest_attempt(folder_.parent_path()) == number_;
}

bool RunClaim::beat(const ProcessEnd& sum) {
  if (!is_latest()) return false;
  nlohmann::ordered_json owner;
  owner["host"] = host_name();
  owner["process"] = getpid();
  owner["start"] = start_of(getpid());
  owner["place"] = place_of_processes();
  owner["beat"] = ++beats_;
  add_account(owner, sum);
  write_file(folder_ / owner_file, owner.dump(2) + "\n", Earlier::replaced);
  return true;
}

void RunClaim::end(const ProcessEnd& sum) const {
  nlohmann::ordered_json ended;
  add_account(ended, sum);
  write_file(folder_ / ended_file, ended.dump(2) + "\n", Earlier::replaced);
}

bool RunClaim::publish() const {
  if (!is_latest()) return false;
  const RunFiles mine = files(), own = files_of_run(study_, name_);
  fs::remove(own.process);
  for (const auto file :
       {&RunFiles::result, &RunFiles::sidecar, &RunFiles::summary, &RunFiles::log})
    if (fs::exists(mine.*file))
      fs::rename(mine.*file, own.*file);
    else
      fs::remove(own.*file);
  fs::rename(mine.process, own.process);
  remove_attempts();
  return true;
}

/// What is left does no harm.
void RunClaim::remove_attempts() const {
  std::error_code ignored;
  for (int number = 1; number <= number_; ++number)
    fs::remove_all(folder_.parent_path() / std::to_string(number), ignored);
  fs::remove(folder_.parent_path(), ignored);
}

}  // namespace gnomon::study
