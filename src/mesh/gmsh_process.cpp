#include "mesh/gmsh_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <gnomon/base/error.hpp>
#include <gnomon/base/installation.hpp>
#include <optional>
#include <utility>

#include "mesh/import_nodes.hpp"
#include "mesh/mesh_stream.hpp"
#include "mesh/shared_meshes.hpp"

extern char** environ;

namespace gnomon {

#ifdef GNOMON_HAS_GMSH

namespace {

/// Closed when it goes out of scope.
struct Descriptor {
  int number = -1;

  Descriptor() = default;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close_now(); }
  void close_now() {
    if (number >= 0) close(number);
    number = -1;
  }
};

struct StreamEnds {};  // before the mesh does

void demand(int code, const char* what) {
  if (code) throw Error(fmt::format("cannot start Gmsh: {}: {}", what, std::strerror(code)));
}

/// Gmsh and what it is made of print to a terminal whatever their settings; here they have none.
pid_t start(const std::vector<std::string>& words, int output) {
  posix_spawn_file_actions_t actions;
  demand(posix_spawn_file_actions_init(&actions), "actions");
  demand(posix_spawn_file_actions_adddup2(&actions, output, mesh_stream::descriptor), "output");
  for (int stream : {0, 1, 2})
    demand(posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0), "streams");
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t process = 0;
  const int failed =
      posix_spawn(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  demand(failed, arguments[0]);
  return process;
}

int wait_for(pid_t process) {
  int status = 0;
  while (waitpid(process, &status, 0) < 0)
    if (errno != EINTR) throw Error(std::string("cannot wait for Gmsh: ") + std::strerror(errno));
  return status;
}

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

/// Size, then four numbers for each ball. A word of a command may have 128 kB.
std::string text_of(const FineZone& zone) {
  std::string text = fmt::format("{}", zone.size);
  for (const FineZone::Ball& ball : zone.balls)
    text += fmt::format(" {:.7g}", fmt::join(ball, " "));
  return text;
}

/// Starts the process that uses Gmsh, takes what it hands over and waits for its end.
ImportedMesh ask_gmsh(const std::filesystem::path& file, const MeshFileOptions& options) {
  int ends[2];
  if (pipe2(ends, O_CLOEXEC)) demand(errno, "pipe");
  Descriptor input, output;
  input.number = ends[0];
  output.number = ends[1];
  std::vector<std::string> words = {installed("libexec/gnomon/gnomon_gmsh").string(), file.string(),
                                    fmt::format("{}", options.size),
                                    fmt::format("{}", options.factor)};
  if (!options.fine.balls.empty()) words.push_back(text_of(options.fine));
  const pid_t process = start(words, output.number);
  output.close_now();
  std::optional<Handed> handed = take(input.number);
  input.close_now();
  const int status = wait_for(process);
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
