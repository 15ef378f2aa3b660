// The messages about a run that has ended; they are the same for new and resumed runs.
#pragma once

#include <gnomon/budget/plan.hpp>
#include <gnomon/run/run.hpp>
#include <gnomon/run/setup.hpp>
#include <string>
#include <vector>

#include "app/commands.hpp"

namespace gnomon::app {

/// Called before anything that takes time.
void warn_of_slow_blas();

/// One line each; empty ones are left out.
void print_remarks(const std::vector<std::string>& remarks);

/// Makes the plan of a scene with accuracy.within, and shows the progress.
Plan planned(const Scene& scene, bool quiet);

/// Integrates, writes to `writer` and shows the progress. `plan`: that of the scene, if it has one.
RunOutcome integrate(const Setup& setup, const IntegratorSettings& settings, ResultWriter& writer,
                     bool quiet, const Resumption* from = nullptr, const Plan* plan = nullptr);

/// Prints how a run with these options ended, and returns the exit code. `has_mesh`: so that there
/// is a file for ParaView beside the result; `kept`: an earlier result of this name was not
/// replaced. Throws SolutionError when the run failed.
int report_end(const RunOutcome& outcome, const RunOptions& options, bool has_mesh, bool kept);

}  // namespace gnomon::app
