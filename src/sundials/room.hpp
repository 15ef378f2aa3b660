// The interface to SUNDIALS: owners of its handles, views of its vectors, and the only way in which
// errors and exceptions cross its C frames. Decisions are made in newton and integrators.
//
// Only this room contains version differences (6.4 and 7.x), most of them in compat.hpp.
#pragma once

#include <sundials/sundials_matrix.h>
#include <sundials/sundials_nvector.h>

#include <exception>
#include <gnomon/base/error.hpp>
#include <gnomon/fields/sparse_pattern.hpp>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>

#include "sundials/compat.hpp"

namespace gnomon::sundials {

/// Move-only owner of a handle; `destroy` takes it or, as KINFree, its address.
template <auto destroy>
struct Destroy {
  template <class T>
  void operator()(T* handle) const {
    if constexpr (std::is_invocable_v<decltype(destroy), T*>)
      destroy(handle);
    else
      destroy(&handle);
  }
};
template <class T, auto destroy>
using Owner = std::unique_ptr<T, Destroy<destroy>>;
using VectorOwner = Owner<_generic_N_Vector, N_VDestroy>;
using MatrixOwner = Owner<_generic_SUNMatrix, SUNMatDestroy>;
using TableOwner = Owner<ARKodeButcherTableMem, ARKodeButcherTable_Free>;

/// Throws Error with the function's name when a SUNDIALS call failed.
void check(int flag, const char* what);
void check(const void* handle, const char* what);

/// New serial vector of length n, zero.
VectorOwner make_vector(long n, SUNContext context);
std::span<double> view(N_Vector v);

/// Runs a callback body inside a C frame: 0, +1 after a RecoverableError (SUNDIALS may shorten its
/// step), -1 after any other exception, which is kept for rethrow().
class Guard {
public:
  template <class Body>
  int run(Body&& body) noexcept {
    try {
      body();
      return 0;
    } catch (const RecoverableError& error) {
      try {
        recoverable_ = error.what();
      } catch (...) {
        recoverable_.clear();
      }
      return 1;
    } catch (...) {
      pending_ = std::current_exception();
      return -1;
    }
  }
  /// Rethrows the exception of a callback, once.
  void rethrow() {
    if (pending_) std::rethrow_exception(std::exchange(pending_, nullptr));
  }
  /// The message of the last recoverable error; cleared by clear().
  const std::string& recoverable() const { return recoverable_; }
  void clear() { recoverable_.clear(); }

private:
  std::exception_ptr pending_;
  std::string recoverable_;
};

/// Values on a fixed pattern, which must outlive it, as a SUNMatrix. SUNMatZero does nothing:
/// every new Jacobian overwrites all values, and a kept one must not change.
MatrixOwner make_matrix(const SparsePattern& pattern, SUNContext context);
std::span<double> values(SUNMatrix matrix);

/// Throws RecoverableError when an entry is not finite.
void require_finite(std::span<const double> values, const char* what);

}  // namespace gnomon::sundials
