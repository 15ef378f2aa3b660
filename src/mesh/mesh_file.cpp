#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <fstream>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/mesh_file.hpp>
#include <optional>
#include <utility>

#include "mesh/gmsh_process.hpp"
#include "mesh/import_nodes.hpp"
#include "scene/toml_text.hpp"

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
