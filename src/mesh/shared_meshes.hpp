// Meshes that the processes of a study share, so that Gmsh makes each of them once.
#pragma once

#include <filesystem>
#include <functional>
#include <gnomon/mesh/imported_mesh.hpp>
#include <string>

namespace gnomon {

/// While one exists, this process and those that it starts keep the meshes that they make in a
/// temporary folder, which ends with the outermost one. Where there can be no such folder, each
/// makes its own.
class SharedMeshes {
public:
  SharedMeshes();
  ~SharedMeshes();
  SharedMeshes(const SharedMeshes&) = delete;
  SharedMeshes& operator=(const SharedMeshes&) = delete;

  /// Empty: there is none, or that of another one.
  const std::filesystem::path& folder() const { return folder_; }

private:
  std::filesystem::path folder_;
};

/// The mesh that `key` tells from all others: as another process has left it, or made now and left
/// for others. Just made where this process shares none.
ImportedMesh shared_mesh(const std::string& key, const std::function<ImportedMesh()>& make);

}  // namespace gnomon
