// Input that users and damaged disks may give to gnomon, as functions of bytes. For all bytes each
// function returns or throws InputError with one line. Everything else is a fault of gnomon:
// another exception, a signal, a report of a sanitizer, unlimited memory or time. The functions,
// like the commands that they call, print to standard output. docs/building.md says how to run
// them.
#pragma once

#include <filesystem>
#include <gnomon/scene/scene.hpp>
#include <string>
#include <string_view>

namespace gnomon::fuzz {

/// A scene, as `gnomon check` reads it; a line "#--set KEY=VALUE" represents that option. A model
/// is made if it is small.
void scene(std::string_view bytes);

/// A study file beside the scenes of tests/fuzz/scenes, as `gnomon study` and `gnomon extremes`
/// read it. It is expanded if it has few runs.
void study(std::string_view bytes);

/// A result file, as `info`, `contact`, `compare` and `resume` read it.
void result(std::string_view bytes);

/// A valid HDF5 file that differs from a result: `bytes` say which parts of a result are changed.
void layout(std::string_view bytes);

/// The text of an expression: parsed, and evaluated on many of its branches.
void expression(std::string_view bytes);

/// A mesh of Gmsh (.msh), read by its library in a process of its own, and checked.
void mesh(std::string_view bytes);

/// The checks alone, of a mesh in lines: "node X Y Z", "cell KIND NODES", "facet KIND NODES",
/// "group NAME DIMENSION MEMBERS"; nodes, elements and members are numbered from 0.
void body(std::string_view bytes);

/// Whether the model of a scene needs very little time and memory.
bool is_small(const Scene& scene);

/// The work of result() on a file.
void read_result(const std::filesystem::path& file);

/// A folder for this process and target, removed when the process ends normally.
class Folder {
public:
  explicit Folder(const std::string& target);
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path file(const std::string& name) const { return path_ / name; }
  /// Writes a file there and returns its path.
  std::filesystem::path put(const std::string& name, std::string_view bytes) const;

private:
  std::filesystem::path path_;
};

/// The bytes of a file below tests/fuzz.
std::string read_file(const std::string& name);

/// Throws std::logic_error with the condition that was violated.
void demand(bool holds, const char* what);

}  // namespace gnomon::fuzz
