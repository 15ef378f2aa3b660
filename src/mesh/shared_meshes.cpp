#include "mesh/shared_meshes.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <optional>
#include <utility>

#include "mesh/mesh_stream.hpp"

namespace gnomon {

namespace fs = std::filesystem;

namespace {

/// Names the folder, in the environment.
constexpr const char* variable = "GNOMON_SHARED_MESHES";

}  // namespace

SharedMeshes::SharedMeshes() {
  std::error_code none;
  std::string name = (fs::temp_directory_path(none) / "gnomon-meshes-XXXXXX").string();
  if (std::getenv(variable) || none || !mkdtemp(name.data())) return;
  folder_ = name;
  setenv(variable, name.c_str(), 1);
}

SharedMeshes::~SharedMeshes() {
  if (folder_.empty()) return;
  unsetenv(variable);
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

namespace {

/// What is not whole, or of another key, is no mesh.
std::optional<ImportedMesh> left_by_another(const fs::path& place, const std::string& key) try {
  std::ifstream file(place, std::ios::binary);
  file.exceptions(std::ios::badbit | std::ios::failbit | std::ios::eofbit);
  const auto get = [&file](void* bytes, std::size_t count) {
    file.read(static_cast<char*>(bytes), static_cast<std::streamsize>(count));
  };
  mesh_stream::Stream<true, decltype(get)> reader{get};
  std::string own;
  ImportedMesh mesh;
  reader(own);
  if (own != key) return std::nullopt;
  reader(mesh);
  return mesh;
} catch (const std::ios::failure&) {
  return std::nullopt;
}

/// Others see all of it or nothing. A folder that is full or gone is no mistake.
void leave(const fs::path& place, std::string key, ImportedMesh& mesh) {
  const fs::path unfinished = place.string() + fmt::format("-{}", getpid());
  bool is_whole = false;
  {
    std::ofstream file(unfinished, std::ios::binary);
    const auto put = [&file](const void* bytes, std::size_t count) {
      file.write(static_cast<const char*>(bytes), static_cast<std::streamsize>(count));
    };
    mesh_stream::Stream<false, decltype(put)> writer{put};
    writer(key);
    writer(mesh);
    file.flush();
    is_whole = file.good();
  }
  std::error_code failed;
  if (is_whole) fs::rename(unfinished, place, failed);
  if (!is_whole || failed) fs::remove(unfinished, failed);
}

}  // namespace

ImportedMesh shared_mesh(const std::string& key, const std::function<ImportedMesh()>& make) {
  const char* folder = std::getenv(variable);
  if (!folder || !*folder) return make();
  const fs::path place = fs::path(folder) / fmt::format("{:016x}", std::hash<std::string>()(key));
  if (auto mesh = left_by_another(place, key)) return std::move(*mesh);
  ImportedMesh mesh = make();
  leave(place, key, mesh);
  return mesh;
}

}  // namespace gnomon
