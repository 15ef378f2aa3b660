// What users and damaged disks may hand to gnomon, as functions of bytes. Whatever the bytes, each
// returns or throws InputError in one line. Anything else is a fault of gnomon: another exception,
// a signal, a report of a sanitizer, memory or time without bounds. What the functions print, as
// the commands that they call do, goes to standard output. docs/building.md tells how to run them.
#pragma once

#include <filesystem>
#include <gnomon/scene/scene.hpp>
#include <string>
#include <string_view>

namespace gnomon::fuzz {

/// A scene, as `gnomon check` reads it; a line "#--set KEY=VALUE" stands for that option. A model
/// is made where it is small.
void scene(std::string_view bytes);

/// A study file beside the scenes of tests/fuzz/scenes, as `gnomon study` and `gnomon extremes`
/// read it. It is expanded where it has few runs.
void study(std::string_view bytes);

/// A result file, as `info`, `contact`, `compare` and `resume` read it.
void result(std::string_view bytes);

/// A sound HDF5 file that is not quite a result: `bytes` say what is changed in one.
void layout(std::string_view bytes);

/// The text of an expression: parsed, and evaluated on many of its branches.
void expression(std::string_view bytes);

/// A mesh of Gmsh (.msh), read by its library in a process of its own, and checked.
void mesh(std::string_view bytes);

/// The checks alone, of a mesh in lines: "node X Y Z", "cell KIND NODES", "facet KIND NODES",
/// "group NAME DIMENSION MEMBERS"; nodes, elements and members are numbered from 0.
void body(std::string_view bytes);

/// Whether the model of a scene takes next to no time and memory.
bool is_small(const Scene& scene);

/// What result() does with a file.
void read_result(const std::filesystem::path& file);

/// A folder for this process and target, removed when the process ends as it should.
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

/// Throws std::logic_error with what did not hold.
void demand(bool holds, const char* what);

}  // namespace gnomon::fuzz
