#include "results/replaced_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <gnomon/base/error.hpp>
#include <system_error>

namespace gnomon {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& target, int error) {
  throw Error(fmt::format("cannot write {}: {}", target.string(), std::strerror(error)));
}

/// Returns 0 or an errno value.
int rename_part(const std::filesystem::path& part, const std::filesystem::path& target,
                Earlier earlier) {
  if (earlier == Earlier::refused) {
    if (renameat2(AT_FDCWD, part.c_str(), AT_FDCWD, target.c_str(), RENAME_NOREPLACE) == 0)
      return 0;
    if (errno != EINVAL && errno != ENOSYS) return errno;
    if (is_taken(target)) return EEXIST;  // a file system without an atomic check and rename
  }
  return std::rename(part.c_str(), target.c_str()) == 0 ? 0 : errno;
}

bool is_left_over(int descriptor, std::string_view begins) {
  struct stat status = {};
  if (fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode) || status.st_nlink != 1)
    return false;
  std::string start(begins.size(), '\0');
  const ssize_t got = pread(descriptor, start.data(), start.size(), 0);
  if (got < 0) return false;
  start.resize(static_cast<std::size_t>(got));
  return begins.starts_with(start) || start.find_first_not_of('\0') == std::string::npos;
}

int open_text_part(const std::filesystem::path& part, std::string_view text) {
  return open_part(part, text.substr(0, 16));
}

}  // namespace

int open_part(const std::filesystem::path& part, std::string_view begins) {
  const int descriptor =
      open(part.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);
  if (descriptor >= 0 && is_left_over(descriptor, begins)) return descriptor;
  const int error = errno;
  if (descriptor < 0 && error != ELOOP) refuse(part, error);
  if (descriptor >= 0) close(descriptor);
  throw Error(
      fmt::format("{} exists, expected no such file or one that a killed run left", part.string()));
}

std::filesystem::path part_of(const std::filesystem::path& target) {
  std::filesystem::path part = target;
  part += ".part";
  return part;
}

std::filesystem::path replaceable(const std::filesystem::path& target) {
  std::error_code error;
  const auto status = std::filesystem::status(target, error);
  if (!std::filesystem::exists(status)) return target;
  if (!std::filesystem::is_regular_file(status)) {
    throw InputError(fmt::format("cannot write {}: it is not a regular file", target.string()));
  }
  if (access(target.c_str(), W_OK) != 0) {
    throw InputError(fmt::format("cannot write {}: {}", target.string(), std::strerror(errno)));
  }
  return std::filesystem::canonical(target);
}

bool is_taken(const std::filesystem::path& file) {
  std::error_code ignored;
  return std::filesystem::exists(std::filesystem::symlink_status(file, ignored));
}

void publish_part(const std::filesystem::path& target, Earlier earlier) {
  const auto part = part_of(target);
  if (const int error = rename_part(part, target, earlier); error != 0) {
    unlink(part.c_str());
    refuse(target, error);
  }
}

void require_own_part(const std::filesystem::path& target, std::string_view begins) {
  const auto part = part_of(target);
  if (is_taken(part)) close(open_text_part(part, begins));
}

void write_file(const std::filesystem::path& target, const std::string& text, Earlier earlier) {
  const auto part = part_of(target);
  const int descriptor = open_text_part(part, text);
  int error = ftruncate(descriptor, 0) == 0 ? 0 : errno;
  for (std::size_t done = 0; done < text.size() && error == 0;) {
    const ssize_t written = write(descriptor, text.data() + done, text.size() - done);
    if (written > 0) done += static_cast<std::size_t>(written);
    if (written < 0 && errno != EINTR) error = errno;
  }
  close(descriptor);
  if (error != 0) {
    unlink(part.c_str());
    refuse(target, error);
  }
  publish_part(target, earlier);
}

namespace {

// Locks of the open file description: locks of the process would be released with the first
// descriptor that it closes, which may be that of a reader.
struct flock whole_file(short type) {
  struct flock lock = {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  return lock;
}

}  // namespace

bool claim_alone(int descriptor) {
  struct flock lock = whole_file(F_WRLCK);
  return fcntl(descriptor, F_OFD_SETLK, &lock) == 0 || (errno != EAGAIN && errno != EACCES);
}

void share_claim(int descriptor) {
  struct flock lock = whole_file(F_RDLCK);
  fcntl(descriptor, F_OFD_SETLK, &lock);
}

bool is_claimed(const std::filesystem::path& file) {
  // O_NONBLOCK, so that a pipe does not block the call.
  const int descriptor = open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return false;
  struct flock lock = whole_file(F_WRLCK);
  const bool claimed = fcntl(descriptor, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  close(descriptor);
  return claimed;
}

}  // namespace gnomon
