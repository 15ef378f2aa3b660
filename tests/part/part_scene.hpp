// Scenes of parts for tests, in a folder of their own.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <gnomon/base/error.hpp>
#include <gnomon/mesh/mesh_file.hpp>
#include <sstream>
#include <string>

#include "support/problem_run.hpp"

namespace gnomon::testing {

/// A folder that is removed at the end.
class SceneFolder {
public:
  SceneFolder()
      : path_(std::filesystem::temp_directory_path() /
              ("gnomon-part-" + std::to_string(::getpid()) + "-" +
               ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(path_);
  }
  ~SceneFolder() { std::filesystem::remove_all(path_); }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }

private:
  std::filesystem::path path_;
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

inline std::filesystem::path shipped(const std::string& name) {
  return std::filesystem::path(GNOMON_SOURCE_DIR "/problems/worn_body") / name;
}

/// Tests of scenes that are one text, beside the files that they name.
class PartScenes : public ::testing::Test {
protected:
  void SetUp() override {
    if (!reads_mesh_files()) GTEST_SKIP() << "built without Gmsh's library";
  }
  std::unique_ptr<Model> model(const std::string& text, const Overrides& overrides = {}) const {
    return make_model(load_scene(folder_.write("scene.toml", text), overrides, key_table));
  }
  std::string refusal(const std::string& text, const Overrides& overrides = {}) const {
    try {
      model(text, overrides);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  }

  /// The reason why a scene has no start; empty: it has one.
  std::string failed_start(const std::string& text, const Overrides& overrides = {}) const {
    const auto model = this->model(text, overrides);
    Counters counters;
    try {
      model->start(counters);
    } catch (const SolutionError& error) {
      return error.what();
    }
    return "";
  }

  SceneFolder folder_;
};

}  // namespace gnomon::testing
