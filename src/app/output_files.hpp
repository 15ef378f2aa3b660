// Where a run writes, checked before anything is computed.
#pragma once

#include <filesystem>
#include <string>

#include "app/commands.hpp"

namespace gnomon::app {

/// SCENE's stem, "-", the integrator and ".h5", in the current folder.
std::filesystem::path default_result(const std::filesystem::path& scene,
                                     const std::string& integrator);

/// Throws InputError when a file that the run writes is another one that it writes or reads, exists
/// and is not to be replaced, or cannot be written.
void check_outputs(const RunOptions& options);

/// Writes the summary to where the options say. One of a run that failed at its start replaces
/// nothing: the files of the earlier run stay together. Throws Error.
void write_summary(const RunOptions& options, const std::string& text, bool started);

}  // namespace gnomon::app
