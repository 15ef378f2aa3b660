// The files that a run leaves, and what becomes of files that have their names already.
#pragma once

#include <filesystem>
#include <string>

namespace gnomon {

/// What happens to a file that has the name already.
enum class Earlier { refused, replaced };

/// The XDMF file of a result: the same name with .xdmf, beside the file that a link leads to.
std::filesystem::path sidecar_of(const std::filesystem::path& result);

/// Whether something has this name, be it a link that leads nowhere.
bool is_taken(const std::filesystem::path& file);

/// Whether a run can have written the file: a result (of any version, in any state), a sidecar.
bool is_result(const std::filesystem::path& file);
bool is_sidecar(const std::filesystem::path& file);

/// Makes `file` one with this text, by renaming: whoever opens it finds the old or the new file,
/// whole. Throws Error with the system's reason, or when there is an old one that is refused.
void write_file(const std::filesystem::path& file, const std::string& text, Earlier earlier);

}  // namespace gnomon
