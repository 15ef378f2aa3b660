// The summary of a run: as JSON for scripts, and as text for users.
#pragma once

#include <filesystem>
#include <gnomon/run/run.hpp>
#include <string>

namespace gnomon {

/// JSON text, indented, with the same keys however the run ended. `step` and `rtol` are the
/// settings that the integrator was given; the columns of the last state appear under their names
/// (null when the start itself failed) and with them the ledger: worn_volume, wear_integral and
/// wear_difference, the first minus the second; counters under the names of Counters, unknowns per
/// block. `diagnosis` is empty unless the run failed.
/// `phase_errors`: of a cycle, at each time t, else empty.
/// `remarks`: those of the model.
std::string summary_json(const Scene& scene, const RunHeader& header,
                         const IntegratorSettings& settings, const RunOutcome& outcome,
                         const std::vector<std::string>& remarks);

/// The ledger in one line: "worn volume 1.99711 mm^2, wear integral 2.00000 mm^2, difference
/// -2.9e-03 mm^2 (-0.14 %)". Empty for an observation without one.
std::string ledger_text(const Observation& observed);

/// Of a cycle, in one line: "error of the mean over 16 phases: 2.1e-02 at t = 0 s, 3.0e-04 at t =
/// 18000 s". Empty without errors.
std::string phase_error_text(const std::vector<PhaseError>& errors);

/// Whether the file contains a summary.
bool is_summary(const std::filesystem::path& file);
/// Whether it is that of a run that has no state, not even the start.
bool is_summary_without_start(const std::filesystem::path& file);

}  // namespace gnomon
