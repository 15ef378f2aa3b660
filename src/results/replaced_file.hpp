// A file that takes its name only when it is whole: it is made beside the target and renamed.
#pragma once

#include <filesystem>
#include <string>

namespace gnomon {

/// Where a file is made before it is renamed to `target`: "<target>.part" in the same folder.
std::filesystem::path part_of(const std::filesystem::path& target);

/// Follows a symbolic link, so that replacing the file keeps the link. Throws InputError when the
/// target exists and is not a regular file that may be written.
std::filesystem::path replaceable(const std::filesystem::path& target);

/// Renames the part to its target: whoever opens the target finds the old or the new file, whole.
/// Throws Error with the system's reason.
void publish_part(const std::filesystem::path& target);

/// Replaces the target by a file with this text. Throws Error with the system's reason.
void replace_text(const std::filesystem::path& target, const std::string& text);

}  // namespace gnomon
