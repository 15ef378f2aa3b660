#include "results/write_claim.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>

namespace gnomon {

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
