// Who writes a file: a lock that two runs cannot both have, and that no reader runs into.
#pragma once

#include <filesystem>

namespace gnomon {

/// Claims an open file for this writer alone, as long as the descriptor is open. False when another
/// writer has it. A file system without locks lets everybody pass.
bool claim_alone(int descriptor);

/// Lets readers in that lock what they read (HDF5's do, on a network file system with the same kind
/// of lock); another writer still finds the file claimed.
void share_claim(int descriptor);

/// Whether a writer, of this process or another, has claimed the file.
bool is_claimed(const std::filesystem::path& file);

}  // namespace gnomon
