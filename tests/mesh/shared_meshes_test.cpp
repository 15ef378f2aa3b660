// Meshes that processes share by a folder.
#include "mesh/shared_meshes.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace gnomon::shared_meshes_test {
namespace {

namespace fs = std::filesystem;

ImportedMesh square() {
  ImportedMesh mesh;
  mesh.dimension = 2;
  mesh.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.node_tags = {1, 2, 3, 4};
  mesh.remarks = {"a square"};
  return mesh;
}

class Shared : public ::testing::Test {
protected:
  ImportedMesh ask(const std::string& key) {
    return shared_mesh(key, [this] { return ++made_, square(); });
  }
  int made_ = 0;
};

TEST_F(Shared, IsMadeOnceForEachKey) {
  const SharedMeshes meshes;
  for (const char* key : {"one", "one", "other", "one"}) {
    const ImportedMesh mesh = ask(key);
    EXPECT_EQ(mesh.nodes, square().nodes);
    EXPECT_EQ(mesh.node_tags, square().node_tags);
    EXPECT_EQ(mesh.remarks, square().remarks);
    EXPECT_EQ(mesh.dimension, 2);
  }
  EXPECT_EQ(made_, 2);
}

TEST_F(Shared, IsMadeEachTimeWhereNothingIsShared) {
  ask("one"), ask("one");
  EXPECT_EQ(made_, 2);
  fs::path folder;
  {
    const SharedMeshes meshes;
    folder = meshes.folder();
    EXPECT_TRUE(fs::exists(folder));
    EXPECT_TRUE(SharedMeshes().folder().empty());  // that of the outer one stays
    ask("one"), ask("one");
  }
  EXPECT_FALSE(fs::exists(folder));
  ask("one"), ask("one");
  EXPECT_EQ(made_, 5);
}

TEST_F(Shared, NeedsNoFolder) {
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  setenv("TMPDIR", "/nowhere", 1);
  {
    const SharedMeshes meshes;
    ask("one"), ask("one");
  }
  before ? setenv("TMPDIR", kept.c_str(), 1) : unsetenv("TMPDIR");
  EXPECT_EQ(made_, 2);
}

TEST_F(Shared, IsMadeAgainWhereItIsNotWhole) {
  const SharedMeshes meshes;
  ask("one");
  for (const auto& entry : fs::directory_iterator(meshes.folder()))
    fs::resize_file(entry.path(), fs::file_size(entry.path()) - 8);
  ask("one"), ask("one");
  EXPECT_EQ(made_, 2);
}

}  // namespace
}  // namespace gnomon::shared_meshes_test
