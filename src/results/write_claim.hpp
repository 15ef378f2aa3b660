// The writer of a file: a lock that only one run can have, and that does not affect readers.
#pragma once

#include <filesystem>

namespace gnomon {

/// Claims an open file for this writer alone, as long as the descriptor is open. Returns false if
/// another writer has it. On a file system without locks it always succeeds.
bool claim_alone(int descriptor);

/// Allows readers that lock the file (readers of HDF5 do; on a network file system with the same
/// kind of lock); for another writer the file is still claimed.
void share_claim(int descriptor);

/// Whether a writer, of this process or another, has claimed the file.
bool is_claimed(const std::filesystem::path& file);

}  // namespace gnomon
