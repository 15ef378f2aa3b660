// The files that a run writes, checked before anything is computed.
#pragma once

#include <string>

#include "app/commands.hpp"

namespace gnomon::app {

/// Throws InputError if a file that the run writes is the same as another one that it writes or
/// reads, or exists and must not be replaced, or cannot be written.
void check_outputs(const RunOptions& options);

/// Writes the summary to the file that the options name. The summary of a run that failed at its
/// start does not replace an earlier one, so that the files of the earlier run stay together.
/// Throws Error.
void write_summary(const RunOptions& options, const std::string& text, bool started);

}  // namespace gnomon::app
