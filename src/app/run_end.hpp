// What is said about a run when it has ended, however it began.
#pragma once

#include <filesystem>
#include <gnomon/run/run.hpp>
#include <string>

#include "app/setup.hpp"

namespace gnomon::app {

/// Before anything that takes time.
void warn_of_slow_blas();

/// Integrates into `writer` and shows how far it is.
RunOutcome integrate(const Setup& setup, const IntegratorSettings& settings, ResultWriter& writer,
                     bool quiet, const Resumption* from = nullptr);

/// What a run says of its end, and where.
struct EndReport {
  std::filesystem::path result;
  bool kept = false;   ///< an earlier result is still there under this name
  bool quiet = false;  ///< nothing but errors
  bool table = true;   ///< the scalars at the end, unless quiet
};

/// Prints it and returns the exit code. Throws SolutionError when the run failed.
int report_end(const RunOutcome& outcome, const EndReport& report);

}  // namespace gnomon::app
