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

}  // namespace gnomon::hdf5
