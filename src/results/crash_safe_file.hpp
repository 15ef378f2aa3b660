// A file on disk that holds a readable HDF5 image at every instant, so that a run killed anywhere
// leaves every step that was committed. The rules, and what they rest on, are in docs/results.md.
#pragma once

#include <hdf5.h>

#include <filesystem>
#include <vector>

#include "results/hdf5_handles.hpp"

namespace gnomon::hdf5 {

/// Stands between the HDF5 library and the disk as its file driver. HDF5 overwrites its structures
/// in place and in any order; here
/// - new space is only ever taken at the end of the file and is written at once (nothing refers to
///   it yet),
/// - changes to what is already committed wait in memory until H5Fflush, and then go out in an
/// order
///   in which each leaves a valid file: the superblock (length of the file), raw data, chunk
///   indices, and last the object headers that make the new things visible,
/// - no structure that changes in place crosses a page border, so that the kernel writes each of
///   them as a whole or not at all.
class CrashSafeFile {
public:
  /// Creates the file, or takes over what a dead writer has left there. Throws Failure with the
  /// system's reason, or when another writer has claimed the file.
  explicit CrashSafeFile(const std::filesystem::path& path);
  ~CrashSafeFile();
  CrashSafeFile(const CrashSafeFile&) = delete;
  CrashSafeFile& operator=(const CrashSafeFile&) = delete;

  /// A file access list with which H5Fcreate works on this file. The file must outlive it.
  Handle access_list();

  /// Nothing more goes to the disk, which keeps what it holds. HDF5 goes on without knowing (it
  /// reads what it writes, from memory), and can be closed.
  void abandon() { abandoned_ = true; }
  /// Throws Failure with the system's reason when a write has failed, which abandons the file. HDF5
  /// is not told: told of it, it writes what refers to that place all the same, and may crash.
  void require_written() const;
  /// From here on the file is for readers too (write_claim.hpp).
  void share();
  /// Asks the system to bring the file to the medium itself. Throws Failure.
  void sync();

  // What the driver's callbacks call. read() returns 0 or an errno value.
  int read(haddr_t address, size_t size, void* buffer) const;
  void write(H5FD_mem_t type, haddr_t address, size_t size, const void* buffer);
  void commit();
  haddr_t allocate(H5FD_mem_t type, hsize_t size);
  haddr_t end() const { return end_; }
  void set_end(haddr_t end) { end_ = end; }
  haddr_t committed_end() const { return committed_end_; }

private:
  struct Change {
    int rank = 0;  ///< position in the order of the commit
    haddr_t address = 0;
    std::vector<unsigned char> bytes;
  };

  int publish_all();
  int publish(const Change& change) const;
  bool succeeds(int error);

  int descriptor_ = -1;
  int error_ = 0;  ///< errno of the first write that failed
  bool abandoned_ = false;
  haddr_t end_ = 0;            ///< allocated by HDF5
  haddr_t committed_end_ = 0;  ///< what the image on disk reaches to
  std::vector<Change> changes_;
};

}  // namespace gnomon::hdf5
