// A file that takes its name only when it is whole: it is made beside the target and renamed.
#pragma once

#include <filesystem>
#include <gnomon/result_files.hpp>

namespace gnomon {

/// Where a file is made before it is renamed to `target`: "<target>.part" in the same folder.
std::filesystem::path part_of(const std::filesystem::path& target);

/// Follows a symbolic link, so that replacing the file keeps the link. Throws InputError when the
/// target exists and is not a regular file that may be written.
std::filesystem::path replaceable(const std::filesystem::path& target);

/// Renames the part to its target: whoever opens the target finds the old or the new file, whole.
/// Throws Error with the system's reason, or when there is an old file that is refused.
void publish_part(const std::filesystem::path& target, Earlier earlier);

}  // namespace gnomon
