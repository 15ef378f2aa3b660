#include "results/crash_safe_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "results/replaced_file.hpp"

namespace gnomon::hdf5 {

namespace {

constexpr haddr_t kPage = 4096;

/// Where a change has its place in a commit: smaller ranks first. An index of chunks is a tree of
/// nodes that begin with a signature, their type and their level, 0 for leaves. When a node is
/// split, its parent must lead to the new sibling before the node itself is cut: higher levels go
/// first.
int rank_of(H5FD_mem_t type, const unsigned char* bytes, size_t size) {
  constexpr int superblock = 0, raw_data = 1, highest_level = 2, most_levels = 256;
  constexpr int other = highest_level + most_levels, object_header = other + 1;
  constexpr size_t level_at = 5;
  switch (type) {
    case H5FD_MEM_SUPER:
      return superblock;
    case H5FD_MEM_DRAW:
      return raw_data;
    case H5FD_MEM_BTREE:
      if (size <= level_at || std::memcmp(bytes, "TREE", 4) != 0) return other;
      return highest_level + (most_levels - 1 - bytes[level_at]);
    case H5FD_MEM_OHDR:
      return object_header;
    default:
      return other;
  }
}

bool is_named(int descriptor, const std::filesystem::path& path) {
  struct stat here = {}, there = {};
  return fstat(descriptor, &here) == 0 && stat(path.c_str(), &there) == 0 &&
         here.st_dev == there.st_dev && here.st_ino == there.st_ino;
}

/// Reads what there is, `got` bytes, fewer than `size` at the end of the file. 0 or an errno value.
int read_all(int descriptor, haddr_t address, unsigned char* bytes, size_t size, size_t& got) {
  for (got = 0; got < size;) {
    const ssize_t done =
        pread(descriptor, bytes + got, size - got, static_cast<off_t>(address + got));
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) return errno;
    if (done == 0) break;
    got += static_cast<size_t>(done);
  }
  return 0;
}

int write_all(int descriptor, haddr_t address, const unsigned char* bytes, size_t size) {
  while (size > 0) {
    const ssize_t done = pwrite(descriptor, bytes, size, static_cast<off_t>(address));
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return done < 0 ? errno : ENOSPC;
    address += static_cast<haddr_t>(done);
    bytes += done;
    size -= static_cast<size_t>(done);
  }
  return 0;
}

}  // namespace

// Emptied only once it is claimed, and only if it still has its name: another writer may have
// published it (and be done) since it was opened.
CrashSafeFile::CrashSafeFile(const std::filesystem::path& path)
    : descriptor_(open_part(path, "\x89HDF\r\n\x1a\n")) {
  std::string trouble;
  if (!claim_alone(descriptor_) || !is_named(descriptor_, path)) {
    trouble = "another run is writing it";
  } else if (ftruncate(descriptor_, 0) != 0) {
    trouble = std::strerror(errno);
  }
  if (trouble.empty()) return;
  ::close(descriptor_);
  throw Failure(trouble);
}

CrashSafeFile::~CrashSafeFile() {
  ::close(descriptor_);
}

bool CrashSafeFile::has_name(const std::filesystem::path& path) const {
  return is_named(descriptor_, path);
}

void CrashSafeFile::share() {
  share_claim(descriptor_);
}

void CrashSafeFile::sync() {
  if (fsync(descriptor_) != 0) throw Failure(std::strerror(errno));
}

int CrashSafeFile::read(haddr_t address, size_t size, void* buffer) const {
  auto* out = static_cast<unsigned char*>(buffer);
  size_t got = 0;
  if (const int error = read_all(descriptor_, address, out, size, got)) return error;
  std::memset(out + got, 0, size - got);   // allocated, not written yet
  for (const Change& change : changes_) {  // what waits lies over what is on disk
    const haddr_t from = std::max(address, change.address);
    const haddr_t to = std::min(address + size, change.address + change.bytes.size());
    if (from < to) {
      std::memcpy(out + (from - address), change.bytes.data() + (from - change.address), to - from);
    }
  }
  return 0;
}

void CrashSafeFile::require_written() const {
  if (error_ != 0) throw Failure(std::string("cannot write: ") + std::strerror(error_));
}

bool CrashSafeFile::succeeds(int error) {
  if (error == 0) return true;
  error_ = error;
  abandoned_ = true;
  return false;
}

void CrashSafeFile::write(H5FD_mem_t type, haddr_t address, size_t size, const void* buffer) {
  const auto* bytes = static_cast<const unsigned char*>(buffer);
  // Once abandoned, everything waits: HDF5 continues in memory.
  if (!abandoned_ && address >= committed_end_ &&
      succeeds(write_all(descriptor_, address, bytes, size)))
    return;
  const auto same = std::find_if(changes_.begin(), changes_.end(), [&](const Change& change) {
    return change.address == address && change.bytes.size() == size;
  });
  Change change{rank_of(type, bytes, size), address, {bytes, bytes + size}};
  if (same != changes_.end()) {
    *same = std::move(change);
  } else {
    changes_.push_back(std::move(change));
  }
}

void CrashSafeFile::commit() {
  if (abandoned_ || !succeeds(publish_all())) return;
  changes_.clear();
  committed_end_ = end_;
}

// The file is long enough before anything, first of all the superblock, says so.
int CrashSafeFile::publish_all() {
  struct stat status = {};
  if (fstat(descriptor_, &status) != 0) return errno;
  if (static_cast<haddr_t>(status.st_size) < end_ &&
      ftruncate(descriptor_, static_cast<off_t>(end_)) != 0) {
    return errno;
  }
  std::stable_sort(changes_.begin(), changes_.end(),
                   [](const Change& a, const Change& b) { return a.rank < b.rank; });
  for (const Change& change : changes_) {
    if (const int error = publish(change); error != 0) return error;
  }
  return 0;
}

// Only the bytes from the first that differs to the last, page by page. More than one page is there
// only for raw data, which no object header shows yet.
int CrashSafeFile::publish(const Change& change) const {
  std::vector<unsigned char> old(change.bytes.size());
  size_t got = 0;
  if (const int error = read_all(descriptor_, change.address, old.data(), old.size(), got))
    return error;
  if (got < old.size()) return EIO;
  const auto first = std::mismatch(old.begin(), old.end(), change.bytes.begin()).first;
  const auto last =
      std::mismatch(old.rbegin(), std::make_reverse_iterator(first), change.bytes.rbegin())
          .first.base();
  auto from = static_cast<size_t>(first - old.begin());
  const auto to = static_cast<size_t>(last - old.begin());
  while (from < to) {
    const haddr_t address = change.address + from;
    const size_t size = std::min<size_t>(to - from, kPage - address % kPage);
    const int error = write_all(descriptor_, address, change.bytes.data() + from, size);
    if (error != 0) return error;
    from += size;
  }
  return 0;
}

// Takes space at the end only. Structures of HDF5 that fit into a page never cross a page border.
haddr_t CrashSafeFile::allocate(H5FD_mem_t type, hsize_t size) {
  haddr_t address = (end_ + 7) / 8 * 8;
  const bool crosses = address / kPage != (address + size - 1) / kPage;
  if (type != H5FD_MEM_DRAW && size <= kPage && crosses) address = (address / kPage + 1) * kPage;
  end_ = address + size;
  return address;
}

}  // namespace gnomon::hdf5
