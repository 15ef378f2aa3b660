#include <unistd.h>

#include <fstream>
#include <gnomon/model/problem.hpp>
#include <iterator>
#include <stdexcept>

#include "fuzz/targets.hpp"

namespace gnomon::fuzz {

bool is_small(const Scene& scene) {
  constexpr double bytes = 42e6;  // about 1,400 nodes in the plane, 200 in space
  constexpr long points = 1000;
  if (scene.text("problem") == "winkler") return scene.integer("foundation.points") <= points;
  return estimated_memory(scene) < bytes;
}

Folder::Folder(const std::string& target)
    : path_(std::filesystem::temp_directory_path() /
            ("gnomon-fuzz-" + target + "-" + std::to_string(getpid()))) {
  std::filesystem::create_directories(path_);
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::filesystem::path Folder::put(const std::string& name, std::string_view bytes) const {
  const std::filesystem::path path = file(name);
  std::ofstream(path, std::ios::binary).write(bytes.data(), std::ssize(bytes));
  return path;
}

std::string read_file(const std::string& name) {
  std::ifstream stream(GNOMON_SOURCE_DIR "/tests/fuzz/" + name, std::ios::binary);
  demand(stream.is_open(), "a file of tests/fuzz can be read");
  return {std::istreambuf_iterator<char>(stream), {}};
}

void demand(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

}  // namespace gnomon::fuzz
