// The summary of a run as JSON, for scripts.
#pragma once

#include <filesystem>
#include <gnomon/run/run.hpp>
#include <string>

namespace gnomon {

/// JSON text, indented, with the same keys however the run ended. `step` and `rtol` are the
/// settings that the integrator was given; scalars of Model::observe appear under their names (null
/// when the start itself failed), counters under the names of Counters, unknowns per block.
/// `diagnosis` is empty unless the run failed.
std::string summary_json(const Scene& scene, const RunHeader& header,
                         const IntegratorSettings& settings, const RunOutcome& outcome);

/// Whether the file holds such a text.
bool is_summary(const std::filesystem::path& file);

}  // namespace gnomon
