// A file on disk that holds a readable HDF5 image at every instant, so that a run killed anywhere
// leaves every step that was committed. The rules, and what they rest on: docs/notes/results.md.
#pragma once

#include <hdf5.h>

#include <filesystem>
#include <vector>

#include "results/hdf5_handles.hpp"

namespace gnomon::hdf5 {

/// The file driver of HDF5 that stands between the library and the disk. HDF5 changes its
/// structures in place and in any order, so that a process killed between two of its writes leaves
/// a file that no reader opens. Here the bytes on disk are, after each single system call, a valid
/// HDF5 file that holds all that was committed:
///
/// 1. allocate() takes new space at the end only, and space is never given back. Whatever lies
///    behind committed_end_ is therefore unknown to the file on disk.
/// 2. write() behind committed_end_ goes to the disk at once. A write before it would change what
///    readers see: it waits in memory, where read() finds it.
/// 3. commit(), called by H5Fflush, lengthens the file to all that is allocated, and writes the
///    waiting changes, in an order in which each refers only to what is on disk already:
///    superblock   the length of the file: nothing may lie behind it
///    raw data     rows beyond the length of their table: nobody reads them yet
///    indices      of chunks, from the root down
///    headers      of objects: the length of tables, links; what makes the new things visible
/// 4. Each change is one system call within one page of memory, which Linux carries out as a
///    whole even for a process that is being killed: allocate() lets no small structure cross the
///    border of a page.
///
/// All this orders what processes see. What a power failure leaves depends on sync().
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

  /// Nothing more goes to the disk, which keeps what it holds. HDF5 continues without an error (it
  /// reads what it writes, from memory), and can be closed.
  void abandon() { abandoned_ = true; }
  /// Throws Failure with the system's reason when a write has failed, which abandons the file. HDF5
  /// gets none: with one it would still write what refers to that place, and may crash.
  void require_written() const;
  /// From here on the file is for readers too (replaced_file.hpp).
  void share();
  /// Whether the file is the one of this name.
  bool has_name(const std::filesystem::path& path) const;
  /// Asks the system to bring the file to the medium itself. Throws Failure.
  void sync();

  // What the driver's callbacks call. read() returns 0 or an errno value.
  int read(haddr_t address, size_t size, void* buffer) const;
  void write(H5FD_mem_t type, haddr_t address, size_t size, const void* buffer);
  void commit();
  haddr_t allocate(H5FD_mem_t type, hsize_t size);
  haddr_t end() const { return end_; }
  void set_end(haddr_t end) { end_ = end; }

private:
  struct Change {
    int rank = 0;  ///< smaller ones go first
    haddr_t address = 0;
    std::vector<unsigned char> bytes;
  };

  // These return 0 or an errno value.
  int publish_all();
  int publish(const Change& change) const;
  bool succeeds(int error);  ///< keeps the error and abandons the file if there is one

  int descriptor_ = -1;
  int error_ = 0;  ///< errno of the first write that failed
  bool abandoned_ = false;
  haddr_t end_ = 0;            ///< allocated by HDF5
  haddr_t committed_end_ = 0;  ///< what the image on disk reaches to
  std::vector<Change> changes_;
};

}  // namespace gnomon::hdf5
