#include "mesh/gmsh_process.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <gnomon/base/error.hpp>
#include <optional>
#include <utility>

#include "mesh/gmsh_server.hpp"
#include "mesh/import_nodes.hpp"
#include "mesh/mesh_stream.hpp"
#include "mesh/shared_meshes.hpp"

namespace gnomon {

#ifdef GNOMON_HAS_GMSH

namespace {

struct StreamEnds {};  // before the mesh does

struct Handed {
  ImportedMesh mesh;
  std::string complaint;
};

/// Nothing where the process ended before all was there.
std::optional<Handed> take(int input) {
  const auto get = [input](void* bytes, std::size_t count) {
    auto* place = static_cast<char*>(bytes);
    while (count > 0) {
      const ssize_t now = read(input, place, count);
      if (now < 0 && errno == EINTR) continue;
      if (now <= 0) throw StreamEnds();
      place += now;
      count -= static_cast<std::size_t>(now);
    }
  };
  mesh_stream::Stream<true, decltype(get)> reader{get};
  Handed handed;
  try {
    char letter = 0;
    reader(letter);
    if (letter == mesh_stream::sound)
      reader(handed.mesh);
    else
      reader(handed.complaint);
  } catch (const StreamEnds&) {
    return std::nullopt;
  }
  return handed;
}

std::string how_it_ended(int status, bool geometry) {
  const char* advice = geometry ? "another size or algorithm of the mesh may help"
                                : "the file is damaged: save it again";
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
    return "the script ended before there was a mesh, expected one without Exit";
  if (!WIFSIGNALED(status))
    return fmt::format("Gmsh ended with exit code {}; {}", WEXITSTATUS(status), advice);
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU) return fmt::format("Gmsh does not finish reading; {}", advice);
  if (signal == SIGINT || signal == SIGTERM) return "the reading was interrupted";
  return fmt::format("Gmsh itself failed (signal {}); {}", signal, advice);
}

/// Size, then four numbers for each ball.
std::string text_of(const FineZone& zone) {
  std::string text = fmt::format("{}", zone.size);
  for (const FineZone::Ball& ball : zone.balls)
    text += fmt::format(" {:.7g}", fmt::join(ball, " "));
  return text;
}

/// Takes what the process that uses Gmsh hands over.
ImportedMesh ask_gmsh(const std::filesystem::path& file, const MeshFileOptions& options) {
  std::optional<Handed> handed;
  const int status =
      GmshServer::ask({std::filesystem::current_path().string(), file.string(),
                       fmt::format("{}", options.size), fmt::format("{}", options.factor),
                       options.fine.balls.empty() ? std::string() : text_of(options.fine)},
                      [&](int input) { handed = take(input); });
  if (!handed) refuse_mesh(file.string(), how_it_ended(status, is_geometry(file)));
  if (!handed->complaint.empty()) refuse_mesh(file.string(), handed->complaint);
  return std::move(handed->mesh);
}

}  // namespace

ImportedMesh mesh_from_process(const std::filesystem::path& file, const MeshFileOptions& options) {
  // A file that is changed is another one.
  const auto written = std::filesystem::last_write_time(file).time_since_epoch().count();
  const std::string key = fmt::format("{} {} {} {} {}", std::filesystem::absolute(file).string(),
                                      written, options.size, options.factor, text_of(options.fine));
  ImportedMesh mesh = shared_mesh(key, [&] { return ask_gmsh(file, options); });
  mesh.file = file.string();
  return mesh;
}

#else

ImportedMesh mesh_from_process(const std::filesystem::path& file, const MeshFileOptions&) {
  refuse_mesh(file.string(),
              "needs Gmsh's library, which this gnomon was built without (Debian: libgmsh-dev)");
}

#endif

}  // namespace gnomon
