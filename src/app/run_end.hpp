// The messages about a run that has ended; they are the same for new and resumed runs.
#pragma once

#include <filesystem>
#include <gnomon/run/run.hpp>
#include <gnomon/run/setup.hpp>
#include <string>
#include <vector>

namespace gnomon::app {

/// Called before anything that takes time.
void warn_of_slow_blas();

/// One line each; empty ones are left out.
void print_remarks(const std::vector<std::string>& remarks);

/// Integrates, writes to `writer` and shows the progress.
RunOutcome integrate(const Setup& setup, const IntegratorSettings& settings, ResultWriter& writer,
                     bool quiet, const Resumption* from = nullptr);

/// Which messages a run prints at its end, and for which file.
struct EndReport {
  std::filesystem::path result;
  bool has_mesh = true;  ///< so that there is a file for ParaView beside it
  bool kept = false;     ///< an earlier result of this name was not replaced
  bool quiet = false;    ///< errors only
  bool table = true;     ///< the scalars at the end, unless quiet
};

/// Prints it and returns the exit code. Throws SolutionError when the run failed.
int report_end(const RunOutcome& outcome, const EndReport& report);

}  // namespace gnomon::app
