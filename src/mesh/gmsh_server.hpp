// The process that has loaded Gmsh's library, which takes as long as a small mesh, and makes each
// mesh in a fork of its own (src/gmsh): the faults of one are not those of the next, or of gnomon.
#pragma once

#include <sys/types.h>

#include <array>
#include <functional>
#include <optional>
#include <string>

#include "mesh/mesh_request.hpp"

namespace gnomon {

/// One for each process of gnomon. It ends with that, and where nobody asks it for some seconds.
class GmshServer {
public:
  using Words = std::array<std::string, mesh_request::words>;
  using Take = std::function<void(int input)>;

  /// Has a mesh made, which `take` reads from a descriptor until it has all or nothing more comes.
  /// Returns how the making ended (waitpid). Throws Error where Gmsh's process cannot be started.
  /// One at a time, whatever thread asks.
  static int ask(const Words& words, const Take& take);

private:
  GmshServer() = default;
  ~GmshServer() { end(); }
  void start();
  void end();
  bool is_running() const;
  bool send(const std::string& message, int output) const;
  std::optional<int> answer(const std::string& message, const Take& take);

  int socket_ = -1;
  pid_t process_ = -1, owner_ = -1;  ///< the server; the process of gnomon that has started it
};

}  // namespace gnomon
