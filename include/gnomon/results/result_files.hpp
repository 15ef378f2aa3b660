// The files that a run writes, and the treatment of existing files with the same names.
#pragma once

#include <filesystem>
#include <string>

namespace gnomon {

/// The treatment of an existing file of the same name.
enum class Earlier { refused, replaced };

/// The XDMF file of a result: the same name with .xdmf; if the result is a link, beside its target.
std::filesystem::path sidecar_of(const std::filesystem::path& result);

/// Whether something has this name, even a link without a target.
bool is_taken(const std::filesystem::path& file);

/// Whether a run can have written the file: a result (of any version, in any state), a sidecar.
bool is_result(const std::filesystem::path& file);
bool is_sidecar(const std::filesystem::path& file);

/// Writes `file` with this text, by renaming: a reader finds either the whole old file or the whole
/// new one. Throws Error with the system's reason, or if there is an old file that must not be
/// replaced.
void write_file(const std::filesystem::path& file, const std::string& text, Earlier earlier);

}  // namespace gnomon
