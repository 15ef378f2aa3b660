// A file that takes its name only when it is whole: it is made beside the target and renamed.
#pragma once

#include <filesystem>
#include <gnomon/results/result_files.hpp>
#include <string_view>

namespace gnomon {

/// Where a file is made before it is renamed to `target`: "<target>.part" in the same folder.
std::filesystem::path part_of(const std::filesystem::path& target);

/// Opens the part to write and read: a new one, or what a killed run left, known by `begins`, with
/// which it begins as what is to be written does, or by having no bytes yet but zeros. Returns the
/// descriptor; the file is as it was. Throws Error, also for anything else of that name: it is
/// somebody's.
int open_part(const std::filesystem::path& part, std::string_view begins);

/// Throws Error where write_file() of a text that begins with `begins` would for what has the name
/// of its part.
void require_own_part(const std::filesystem::path& target, std::string_view begins);

/// Follows a symbolic link, so that replacing the file keeps the link. Throws InputError when the
/// target exists and is not a regular file that may be written.
std::filesystem::path replaceable(const std::filesystem::path& target);

/// Renames the part to its target: whoever opens the target finds the old or the new file, whole.
/// Throws Error with the system's reason, or when there is an old file that is refused.
void publish_part(const std::filesystem::path& target, Earlier earlier);

}  // namespace gnomon
