#include "results/hdf5_handles.hpp"

namespace gnomon::hdf5 {

namespace {

// Keeps the first description; the walk goes upward, so this is the innermost and most specific
// one.
herr_t keep_first(unsigned /*depth*/, const H5E_error2_t* entry, void* text) {
  auto& reason = *static_cast<std::string*>(text);
  if (reason.empty() && entry->desc != nullptr) reason = entry->desc;
  return 0;
}

std::recursive_mutex in_use;

}  // namespace

Session::Session() : alone_(in_use) {
  // HDF5 leaks identifiers when it refuses a damaged file, and its clean-up at exit then loops or
  // crashes. gnomon needs no clean-up: every handle has an owner, and data that must be on disk are
  // flushed.
  [[maybe_unused]] static const herr_t once = H5dont_atexit();
  H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

Session::~Session() {
  H5Eset_auto2(H5E_DEFAULT, function_, data_);
}

void fail(const char* what) {
  std::string reason;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason);
  for (char& c : reason) {
    if (c == '\n') c = ' ';
  }
  throw Failure(std::string("cannot ") + what + (reason.empty() ? "" : ": " + reason));
}

namespace {
constexpr hsize_t kChunkRows = 256;
}

GrowingTable GrowingTable::create(hid_t parent, const std::string& name, Handle row_type) {
  const hsize_t none = 0;
  const hsize_t unlimited = H5S_UNLIMITED;
  const Handle space = own(H5Screate_simple(1, &none, &unlimited), H5Sclose, "describe a table");
  const Handle properties = own(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "describe a table");
  check(H5Pset_chunk(properties.id(), 1, &kChunkRows), "describe a table");
  check(H5Pset_obj_track_times(properties.id(), false), "describe a table");
  GrowingTable table;
  table.dataset_ = own(H5Dcreate2(parent, name.c_str(), row_type.id(), space.id(), H5P_DEFAULT,
                                  properties.id(), H5P_DEFAULT),
                       H5Dclose, "create a table");
  table.type_ = std::move(row_type);
  return table;
}

void GrowingTable::append(const void* row) {
  const hsize_t size = rows_ + 1;
  check(H5Dset_extent(dataset_.id(), &size), "append to a table");
  const hsize_t one = 1;
  const Handle memory = own(H5Screate_simple(1, &one, nullptr), H5Sclose, "append to a table");
  const Handle file = own(H5Dget_space(dataset_.id()), H5Sclose, "append to a table");
  check(H5Sselect_hyperslab(file.id(), H5S_SELECT_SET, &rows_, nullptr, &one, nullptr),
        "append to a table");
  check(H5Dwrite(dataset_.id(), type_.id(), memory.id(), file.id(), H5P_DEFAULT, row),
        "append to a table");
  rows_ = size;
}

}  // namespace gnomon::hdf5
