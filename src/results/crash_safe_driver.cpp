// The callbacks that make a CrashSafeFile a file driver of HDF5. No exception leaves them. A failed
// read is put on HDF5's error stack as an errno value and is reported by check(); a failed write is
// stored in the file object and reported by require_written().
#include <cstring>

#include "results/crash_safe_file.hpp"

namespace gnomon::hdf5 {

namespace {

struct DriverFile {
  H5FD_t base = {};  // must be the first member, because HDF5 casts
  CrashSafeFile* file = nullptr;
};

CrashSafeFile& file_of(H5FD_t* base) {
  return *reinterpret_cast<DriverFile*>(base)->file;
}
const CrashSafeFile& file_of(const H5FD_t* base) {
  return *reinterpret_cast<const DriverFile*>(base)->file;
}

// The name is not used: the file is open already.
H5FD_t* open_file(const char* /*name*/, unsigned /*flags*/, hid_t access, haddr_t /*max*/) {
  const auto* info = static_cast<CrashSafeFile* const*>(H5Pget_driver_info(access));
  if (info == nullptr) return nullptr;
  auto* file = new DriverFile;
  file->file = *info;
  return &file->base;
}

herr_t close_file(H5FD_t* base) {
  delete reinterpret_cast<DriverFile*>(base);
  return 0;
}

herr_t query(const H5FD_t* /*base*/, unsigned long* flags) {
  // No aggregation of small allocations and no caches of the driver layer: HDF5 then writes one
  // structure at a time. For every other driver the file is an ordinary one.
  *flags = H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t allocate(H5FD_t* base, H5FD_mem_t type, hid_t /*transfer*/, hsize_t size) {
  return file_of(base).allocate(type, size);
}

haddr_t get_end(const H5FD_t* base, H5FD_mem_t /*type*/) {
  return file_of(base).end();
}

herr_t set_end(H5FD_t* base, H5FD_mem_t /*type*/, haddr_t end) {
  file_of(base).set_end(end);
  return 0;
}

herr_t read(H5FD_t* base, H5FD_mem_t /*type*/, hid_t /*transfer*/, haddr_t address, size_t size,
            void* buffer) {
  const int error = file_of(base).read(address, size, buffer);
  if (error == 0) return 0;
  H5Epush2(H5E_DEFAULT, __FILE__, __func__, __LINE__, H5E_ERR_CLS, H5E_IO, H5E_READERROR, "%s",
           std::strerror(error));
  return -1;
}

herr_t write(H5FD_t* base, H5FD_mem_t type, hid_t /*transfer*/, haddr_t address, size_t size,
             const void* buffer) {
  file_of(base).write(type, address, size, buffer);
  return 0;
}

herr_t flush(H5FD_t* base, hid_t /*transfer*/, hbool_t /*closing*/) {
  file_of(base).commit();
  return 0;
}

H5FD_class_t driver_class() {
  H5FD_class_t driver = {};
#if H5_VERSION_GE(1, 14, 0)
  // A number identifies a driver, too: those above 511 are not reserved for anyone.
  driver.version = H5FD_CLASS_VERSION;
  driver.value = 26081;
#endif
  driver.name = "gnomon_crash_safe";
  driver.maxaddr = (haddr_t{1} << 62) - 1;
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.fapl_size = sizeof(CrashSafeFile*);
  driver.open = open_file;
  driver.close = close_file;
  driver.query = query;
  driver.alloc = allocate;
  driver.get_eoa = get_end;
  driver.set_eoa = set_end;
  driver.get_eof = get_end;
  driver.read = read;
  driver.write = write;
  driver.flush = flush;
  const H5FD_mem_t one_list[H5FD_MEM_NTYPES] = H5FD_FLMAP_SINGLE;
  std::copy(std::begin(one_list), std::end(one_list), driver.fl_map);
  return driver;
}

// Registered once per process and never released.
hid_t driver_id() {
  static const H5FD_class_t driver = driver_class();
  static const hid_t id = check(H5FDregister(&driver), "register the file driver");
  return id;
}

}  // namespace

Handle CrashSafeFile::access_list() {
  Handle list = own(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "prepare the file");
  CrashSafeFile* self = this;
  check(H5Pset_driver(list.id(), driver_id(), &self), "prepare the file");
  // The format of HDF5 1.8: every reader understands it, and it has no mark "open for writing" that
  // would remain after a killed run.
  check(H5Pset_libver_bounds(list.id(), H5F_LIBVER_V18, H5F_LIBVER_V18), "prepare the file");
  return list;
}

}  // namespace gnomon::hdf5
