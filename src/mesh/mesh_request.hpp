// What gnomon asks the process that uses Gmsh for (src/gmsh): one message with the words of a
// request and a descriptor, on which the mesh is written (mesh_stream.hpp); the answer is how that
// ended, as waitpid() says it.
#pragma once

namespace gnomon::mesh_request {

/// Folder in which names are relative, file, size, factor, zone; each word ends with a zero.
inline constexpr int words = 5;

/// A message of a socket has 200 kB.
inline constexpr int longest = 150'000;

/// The file descriptor of the socket in the process that is asked.
inline constexpr int descriptor = 3;

}  // namespace gnomon::mesh_request
