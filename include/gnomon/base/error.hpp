// Typed exceptions of the library. The library never prints and never exits; the program maps
// these types to its exit codes.
#pragma once

#include <stdexcept>
#include <string>

namespace gnomon {

/// Base of all exceptions that gnomon throws itself. Exit code 1 unless a derived type applies.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The user's input (scene, command line, result file) is wrong. One line: what, where, and what
/// was expected. Exit code 2; nothing has been written.
struct InputError : Error {
  using Error::Error;
};

/// The solution could not be continued. The message is a diagnosis. Exit code 3.
struct SolutionError : Error {
  using Error::Error;
};

/// A state at which the residual has no value (inverted element, NaN). The solver that proposed the
/// state may shorten its step and try again,
/// so it returns +1 to SUNDIALS for this and only this type.
struct RecoverableError : Error {
  using Error::Error;
};

/// A registration that cannot be used: of a name that is taken, or without a member that is needed.
struct RegistrationError : Error {
  using Error::Error;
};

}  // namespace gnomon
