// A file that gets its name only when it is complete: it is made beside the target and renamed; and
// who writes it: a lock that only one run can have, and that does not affect readers.
#pragma once

#include <filesystem>
#include <gnomon/results/result_files.hpp>
#include <string_view>

namespace gnomon {

/// Where a file is made before it is renamed to `target`: "<target>.part" in the same folder.
std::filesystem::path part_of(const std::filesystem::path& target);

/// Opens the part for writing and reading: a new file, or one that a killed run left. Such a file
/// begins with `begins`, like the text that will be written, or contains only zeros. Returns the
/// descriptor; the file is not changed. Throws Error, also if another file has this name, because
/// it may belong to someone.
int open_part(const std::filesystem::path& part, std::string_view begins);

/// Throws Error if write_file() of a text that begins with `begins` would throw because of a file
/// with the name of its part.
void require_own_part(const std::filesystem::path& target, std::string_view begins);

/// Follows a symbolic link, so that replacing the file keeps the link. Throws InputError if the
/// target exists and is not a writable regular file.
std::filesystem::path replaceable(const std::filesystem::path& target);

/// Renames the part to its target: a reader finds either the whole old file or the whole new one.
/// Throws Error with the system's reason, or if there is an old file that must not be replaced.
void publish_part(const std::filesystem::path& target, Earlier earlier);

/// Claims an open file for this writer alone, as long as the descriptor is open. Returns false if
/// another writer has it. On a file system without locks it always succeeds.
bool claim_alone(int descriptor);

/// Allows readers that lock the file (readers of HDF5 do; on a network file system with the same
/// kind of lock); for another writer the file is still claimed.
void share_claim(int descriptor);

/// Whether a writer, of this process or another, has claimed the file.
bool is_claimed(const std::filesystem::path& file);

}  // namespace gnomon
