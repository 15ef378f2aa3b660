// Meshes that the processes of a study share, so that Gmsh makes each of them once.
#pragma once

#include <filesystem>
#include <functional>
#include <gnomon/mesh/imported_mesh.hpp>
#include <string>

namespace gnomon {

/// A folder for them, which ends with the object. Throws Error.
class SharedMeshes {
public:
  /// Names the folder, in the environment of the processes that share it.
  static constexpr const char* variable = "GNOMON_SHARED_MESHES";

  SharedMeshes();
  ~SharedMeshes();
  SharedMeshes(const SharedMeshes&) = delete;
  SharedMeshes& operator=(const SharedMeshes&) = delete;

  const std::filesystem::path& folder() const { return folder_; }

private:
  std::filesystem::path folder_;
};

/// The mesh that `key` tells from all others: as another process has left it, or made now and left
/// for others. Just made where this process shares none.
ImportedMesh shared_mesh(const std::string& key, const std::function<ImportedMesh()>& make);

}  // namespace gnomon
