// Where a run writes, checked before anything is computed.
#pragma once

#include <filesystem>
#include <string>

#include "app/commands.hpp"

namespace gnomon::app {

/// SCENE's stem, "-", the integrator and ".h5", in the current folder.
std::filesystem::path default_result(const std::filesystem::path& scene,
                                     const std::string& integrator);

/// The XDMF file that is written beside a result.
std::filesystem::path sidecar_of(const std::filesystem::path& result);

/// Throws InputError when a file that the run writes is another one that it writes or reads, or
/// when the summary cannot be written. (The result file is checked when it is created.)
void check_outputs(const RunOptions& options);

/// Replaces `file`. Throws Error.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace gnomon::app
