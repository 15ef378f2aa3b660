// What differs between SUNDIALS 6.4 (Debian 12) and 7.x, in one place.
//
//   6.4                                   7.x
//   SUNContext_Create(void* comm, ...)    SUNContext_Create(SUN_COMM_NULL, ...)
//   XXXSetErrHandlerFn (silence)          SUNContext_ClearErrHandlers
//   realtype, booleantype                 sunrealtype, sunbooleantype (6.x has both)
//   SUN_NLS_*, SUNLS_* return codes       SUN_ERR_* for errors, same recoverable codes
#pragma once

#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_types.h>

#include <utility>

namespace gnomon::sundials {

/// Move-only owner of a SUNContext that prints nothing.
class Context {
public:
  Context() {
#if SUNDIALS_VERSION_MAJOR >= 7
    SUNContext_Create(SUN_COMM_NULL, &context_);
    SUNContext_ClearErrHandlers(context_);
#else
    SUNContext_Create(nullptr, &context_);
#endif
  }
  ~Context() {
    if (context_) SUNContext_Free(&context_);
  }
  Context(Context&& other) noexcept : context_(std::exchange(other.context_, nullptr)) {}
  Context& operator=(Context&&) = delete;
  operator SUNContext() const {
    return context_;
  }

private:
  SUNContext context_ = nullptr;
};

}  // namespace gnomon::sundials

/// Silences KINSOL's or IDA's own messages: failures are reported by their return codes.
#if SUNDIALS_VERSION_MAJOR >= 7
#define GNOMON_SILENCE(set_handler, memory) (void)(memory)
#else
#define GNOMON_SILENCE(set_handler, memory) \
  set_handler(                              \
      memory, [](int, const char*, const char*, char*, void*) {}, nullptr)
#endif
