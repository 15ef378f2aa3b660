#include "study/study_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <gnomon/base/error.hpp>
#include <gnomon/results/result_files.hpp>

namespace gnomon {

namespace study {

namespace {

namespace fs = std::filesystem;

constexpr const char* marker = "study.toml";  // its presence shows that a folder is that of a study
constexpr const char* name_file = "study.name";  // holds the name of the study

void write_in_place(const fs::path& file, const std::string& text) {
  const int descriptor = open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  const bool written = descriptor >= 0 && write(descriptor, text.data(), text.size()) ==
                                              static_cast<ssize_t>(text.size());
  const int error = errno;
  if (descriptor >= 0) close(descriptor);
  if (!written)
    throw InputError(fmt::format("cannot write {}: {}", file.string(), std::strerror(error)));
}

void check_folder(const fs::path& folder, bool resume) {
  std::error_code error;
  if (!fs::exists(folder, error)) return;
  if (!fs::is_directory(folder, error))
    throw InputError(
        fmt::format("{}: is a file, expected a folder for the study's results", folder.string()));
  if (fs::is_empty(folder, error)) return;
  if (!holds_study(folder))
    throw InputError(fmt::format("{}: is not the folder of a study, expected one or a new name",
                                 folder.string()));
  if (!resume)
    throw InputError(fmt::format("{}: exists already, expected a new name, or --resume to continue",
                                 folder.string()));
}

void prepare_folder(const fs::path& folder, const std::string& text) {
  std::error_code error;
  fs::create_directories(folder / "runs", error);
  if (error)
    throw InputError(
        fmt::format("cannot make {}: {}", (folder / "runs").string(), error.message()));
  // Not replaced by renaming: the lock is on this very file.
  if (!holds_study(folder)) write_in_place(folder / marker, text);
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

}  // namespace

/// Opened for writing, which network file systems require of a lock for one alone. On one without
/// locks there is none: the claims of single runs suffice for correct results.
FolderLock::FolderLock(const fs::path& folder)
    : descriptor_(open((folder / marker).c_str(), O_RDWR | O_CLOEXEC)) {
  if (descriptor_ >= 0 && flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  const int error = errno;
  if (descriptor_ >= 0 && error != EWOULDBLOCK) return;
  if (descriptor_ >= 0) close(descriptor_);
  throw InputError(fmt::format(
      "{}: {}", folder.string(),
      error == EWOULDBLOCK ? "another study is running there, expected none" : strerror(error)));
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

FolderLock claimed_folder(const Study& study, const fs::path& folder, bool resume) {
  check_folder(folder, resume);
  prepare_folder(folder, study.text);
  FolderLock lock(folder);
  claim_folder(folder, study.name);
  write_in_place(folder / marker, study.text);
  write_plan(folder, study);
  return lock;
}

}  // namespace study

bool holds_study(const std::filesystem::path& folder) {
  std::error_code ignored;
  return std::filesystem::exists(folder / study::marker, ignored);
}

void plan_study(const Study& study, const std::filesystem::path& folder, bool resume) {
  study::claimed_folder(study, folder, resume);
}

}  // namespace gnomon
