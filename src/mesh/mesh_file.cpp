#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <deque>
#include <fstream>
#include <gnomon/base/error.hpp>
#include <gnomon/base/installation.hpp>
#include <gnomon/mesh/mesh_file.hpp>
#include <optional>
#include <utility>

#include "mesh/import_nodes.hpp"
#include "mesh/mesh_stream.hpp"
#include "scene/toml_text.hpp"

extern char** environ;

namespace gnomon {

namespace {

constexpr const char* expected = "expected .msh (Gmsh 4.1 or 2.2), .geo, .step or .stp";

std::string extension(const std::filesystem::path& file) {
  std::string result = file.extension().string();
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return result;
}

void check_kind(const std::filesystem::path& file) {
  const std::string kind = extension(file);
  if (kind == ".inp")
    refuse_mesh(
        file.string(),
        "Gmsh's library writes Abaqus files but does not read them; convert it, for example with: "
        "meshio convert part.inp part.msh (which drops its sets: name the parts in Gmsh)");
  if (kind == ".msh" || is_geometry(file)) return;
  refuse_mesh(file.string(),
              kind.empty() ? fmt::format("has no ending, {}", expected)
                           : fmt::format("files that end in {} are not read, {}", kind, expected));
}

void check_there(const std::filesystem::path& file) {
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored))
    refuse_mesh(file.string(), "is a folder, expected a mesh or a geometry");
  if (!std::filesystem::exists(file, ignored)) refuse_mesh(file.string(), "no such file");
  if (!std::ifstream(file)) refuse_mesh(file.string(), "cannot be read");
}

/// Gmsh takes a file without a known beginning for a script, and runs it.
void check_beginning(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string word;
  stream >> word;
  if (word.empty()) refuse_mesh(file.string(), "is empty");
  if (extension(file) != ".msh") return;
  // A section of comments may stand before; nothing else does.
  if (!word.starts_with("$MeshFormat") && !word.starts_with("$Comments"))
    refuse_mesh(file.string(),
                "does not begin with $MeshFormat, expected a mesh of Gmsh, version 4.1 or 2.2");
}

/// Gmsh leaves out the last line of a script that does not end with a new line, and says nothing.
void check_last_line(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  stream.seekg(-1, std::ios::end);
  if (stream.get() != '\n')
    refuse_mesh(file.string(),
                "expected an end of its last line, which Gmsh leaves out without one");
}

/// Gmsh takes what there is of a file that was cut off. Every section ends with its $End.
void check_end(const std::filesystem::path& file) {
  constexpr std::streamoff longest = 200;  // of a word and of spaces after it
  std::ifstream stream(file, std::ios::binary | std::ios::ate);
  const std::streamoff size = stream.tellg();
  stream.seekg(std::max<std::streamoff>(0, size - longest));
  std::string word, last;
  while (stream >> word) last = word;
  if (last.find("$End") == last.npos)
    refuse_mesh(file.string(), "is cut off: its last section has no end");
}

/// Gmsh's complaint of versions that it does not know is not one that helps.
void check_version(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string word;
  // The section stands at the beginning; a comment before it is short.
  for (int words = 0; words < 10'000 && stream >> word && !word.starts_with("$MeshFormat");)
    ++words;
  stream >> word;
  for (const char* known : {"4.1", "2.2", "4", "4.0", "2", "2.0", "2.1"})
    if (stream && word == known) return;
  refuse_mesh(file.string(),
              fmt::format("format {} of Gmsh is not read, expected 4.1 or 2.2; in Gmsh: "
                          "Mesh.MshFileVersion = 4.1",
                          stream ? toml_text(word.substr(0, 20)) : "without a number"));
}

void check_options(const std::filesystem::path& file, const MeshFileOptions& options) {
  if (!(options.size >= 0 && std::isfinite(options.size)))
    refuse_mesh(file.string(), fmt::format("size {}: expected a positive length", options.size));
  if (!(options.factor > 0 && std::isfinite(options.factor)))
    refuse_mesh(file.string(),
                fmt::format("factor {}: expected a positive number", options.factor));
  if (!is_geometry(file) && (options.size != 0 || options.factor != 1))
    refuse_mesh(file.string(),
                "is meshed already, so it takes no size, expected one with .geo, .step or .stp");
}

#ifdef GNOMON_HAS_GMSH

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
ImportedMesh mesh_from_process(const std::filesystem::path& file, const MeshFileOptions& options) {
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
  handed->mesh.file = file.string();
  return std::move(handed->mesh);
}

#else

ImportedMesh mesh_from_process(const std::filesystem::path& file, const MeshFileOptions&) {
  refuse_mesh(file.string(),
              "needs Gmsh's library, which this gnomon was built without (Debian: libgmsh-dev)");
}

#endif

using MeshOfFile = std::pair<std::pair<std::filesystem::path, MeshFileOptions>, ImportedMesh>;

/// The last ones, the one not asked for longest first; nothing while meshes are not kept.
thread_local std::optional<std::deque<MeshOfFile>> kept;

}  // namespace

KeptMeshes::KeptMeshes() : outermost_(!kept) {
  if (outermost_) kept.emplace();
}

KeptMeshes::~KeptMeshes() {
  if (outermost_) kept.reset();
}

bool reads_mesh_files() {
#ifdef GNOMON_HAS_GMSH
  return true;
#else
  return false;
#endif
}

bool is_geometry(const std::filesystem::path& file) {
  const std::string kind = extension(file);
  return kind == ".geo" || kind == ".step" || kind == ".stp";
}

ImportedMesh read_mesh_file(const std::filesystem::path& file, const MeshFileOptions& options) {
  check_kind(file);
  check_there(file);
  check_options(file, options);
  check_beginning(file);
  if (!is_geometry(file)) {
    check_end(file);
    check_version(file);
  }
  if (extension(file) == ".geo") check_last_line(file);
  if (!kept) return mesh_from_process(file, options);
  constexpr std::size_t most = 3, most_nodes = 200000;  // of small meshes more
  const std::pair key(std::filesystem::absolute(file), options);
  const auto known = std::ranges::find(*kept, key, &MeshOfFile::first);
  if (known != kept->end()) return std::rotate(known, known + 1, kept->end()), kept->back().second;
  kept->emplace_back(key, mesh_from_process(file, options));
  const auto nodes = [] {
    std::size_t sum = 0;
    for (const MeshOfFile& mesh : *kept) sum += mesh.second.nodes.size();
    return sum;
  };
  while (kept->size() > most && nodes() > most_nodes) kept->pop_front();
  return kept->back().second;
}

}  // namespace gnomon
