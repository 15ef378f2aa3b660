// Who does a run of a study, where several processes, perhaps on several machines, share its
// folder.
//
// Every attempt at a run has a folder of its own, FOLDER/tries/NAME/NUMBER, in which all its files
// are made. To make this folder is to claim the run: of several processes one succeeds. The owner
// gives a sign of life again and again; an attempt without one is lost, and the next number may be
// made. So a claim is never removed by another process, and no file is written by two.
#pragma once

#include <filesystem>
#include <gnomon/study/study.hpp>
#include <optional>
#include <string>

#include "study/run_files.hpp"

namespace gnomon::study {

/// What another process shows of its attempt.
struct Sign {
  int number = 0;  ///< of the attempt
  long beat = 0;   ///< changes while the owner lives
  bool operator==(const Sign&) const = default;
};

/// An attempt that ended, or was lost, before the run did, and has left a result.
struct EndedAttempt {
  std::filesystem::path folder;
  bool at_rest = false;  ///< nobody writes the result any more; a lost owner might
  ProcessEnd sum;        ///< costs of it and of those that it continued, as far as it told them
};

/// The simulated time from which a run would go on by what earlier attempts have left; 0 without
/// any.
double reached_by_attempts(const std::filesystem::path& folder, const std::string& name);

class RunClaim {
public:
  /// Claims a run, unless another process does it: then `busy` is its sign. An attempt with the
  /// sign `lost` counts as ended. Throws Error where the folder cannot be written.
  static std::optional<RunClaim> take(const std::filesystem::path& folder, const std::string& name,
                                      const std::optional<Sign>& lost, Sign& busy);

  /// The sign of the process that does a run; none if nobody does.
  static std::optional<Sign> sign(const std::filesystem::path& folder, const std::string& name);

  /// The files of this attempt.
  RunFiles files() const { return {folder_, name_}; }
  /// The last attempt before that has left a result.
  const std::optional<EndedAttempt>& before() const { return before_; }

  /// Gives a sign of life, with the costs so far. False if another process has
  /// taken the run over in the meantime.
  bool beat(const ProcessEnd& sum);
  /// Gives the run back, to be continued from the files of this attempt.
  void end(const ProcessEnd& sum) const;
  /// Moves the files to FOLDER/runs, the one that makes the run count as done last. False, and
  /// nothing is moved, if another process has taken the run over.
  bool publish() const;
  /// Removes the attempts at a run that is done.
  void remove_attempts() const;

private:
  RunClaim(std::filesystem::path study, std::string name, int number);
  bool is_latest() const;
  std::optional<EndedAttempt> attempt_before() const;

  std::filesystem::path study_, folder_;
  std::string name_;
  int number_;
  long beats_ = 0;
  std::optional<EndedAttempt> before_;
};

}  // namespace gnomon::study
