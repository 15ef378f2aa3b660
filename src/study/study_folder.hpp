// The folder of a study: claimed by its name, and locked while a study is planned or run as a
// whole; its plan.
#pragma once

#include <filesystem>
#include <gnomon/study/study.hpp>
#include <utility>

namespace gnomon::study {

/// Keeps another gnomon study out of the folder while it exists; it ends with the process.
/// Processes that do single runs of the study do not need it.
class FolderLock {
public:
  /// Throws InputError if another process has it.
  explicit FolderLock(const std::filesystem::path& folder);
  ~FolderLock();
  FolderLock(FolderLock&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
  FolderLock& operator=(FolderLock&&) = delete;

private:
  int descriptor_;
};

/// Makes the folder for the study, or checks that it may go on there, and locks it. Writes the
/// plan: plan.json, the numbered list plan.csv, and the scene of every run, for processes that do
/// runs without the study file.
FolderLock claimed_folder(const Study& study, const std::filesystem::path& folder, bool resume);

}  // namespace gnomon::study
