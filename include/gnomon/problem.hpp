// A problem is a declaration: its name, its scene keys and how to make a model of a scene.
#pragma once

#include <functional>
#include <gnomon/model.hpp>
#include <gnomon/registry.hpp>
#include <gnomon/scene.hpp>
#include <memory>
#include <string>
#include <vector>

namespace gnomon {

struct Problem {
  std::string name;       ///< "pin_on_flat"
  std::string help;       ///< one line
  std::vector<Key> keys;  ///< all keys but run_keys()
  /// Throws InputError (using Scene::where) when keys contradict each other.
  std::function<std::unique_ptr<Model>(const Scene&)> make;
};

using Problems = Registry<Problem>;

/// Key table of a problem for load_scene: run_keys() followed by the problem's own.
std::vector<Key> key_table(const std::string& problem);

}  // namespace gnomon
