// Owners and checks for the C interface of HDF5: gnomon uses it only in this way.
#pragma once

#include <hdf5.h>

#include <gnomon/base/error.hpp>
#include <mutex>
#include <string>
#include <utility>

namespace gnomon::hdf5 {

/// A failed call of HDF5, without the file's name, which the public functions of this room add.
struct Failure : Error {
  using Error::Error;
};

/// An HDF5 identifier with its close function. Closing errors are ignored: data that must reach the
/// disk are flushed before, with a check.
class Handle {
public:
  using Close = herr_t (*)(hid_t);

  Handle() = default;
  Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Handle(Handle&& other) noexcept
      : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }

  hid_t id() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

private:
  hid_t id_ = H5I_INVALID_HID;
  Close close_ = nullptr;
};

/// Work with HDF5. While it exists, other threads wait for theirs, because HDF5 may be used by one
/// thread at a time, and HDF5 prints no errors: the library never prints.
class Session {
public:
  Session();
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

private:
  std::unique_lock<std::recursive_mutex> alone_;
  H5E_auto2_t function_ = nullptr;
  void* data_ = nullptr;
};

/// Throws Failure("cannot <what>: <innermost reason>") when an HDF5 call returned a negative value.
[[noreturn]] void fail(const char* what);
template <class Value>
Value check(Value value, const char* what) {
  if (value < 0) fail(what);
  return value;
}

/// A checked handle: own(H5Dopen2(...), H5Dclose, "open the history").
inline Handle own(hid_t id, Handle::Close close, const char* what) {
  return {check(id, what), close};
}

/// The object of this path below another one.
inline Handle open_dataset(hid_t parent, const std::string& path, const char* what) {
  return own(H5Dopen2(parent, path.c_str(), H5P_DEFAULT), H5Dclose, what);
}
inline Handle open_group(hid_t parent, const std::string& path, const char* what) {
  return own(H5Gopen2(parent, path.c_str(), H5P_DEFAULT), H5Gclose, what);
}

}  // namespace gnomon::hdf5
