#include <gnomon/model/problem.hpp>
#include <gnomon/run/setup.hpp>
#include <gnomon/system/system.hpp>
#include <sstream>

#include "fuzz/targets.hpp"

namespace gnomon::fuzz {

namespace {

std::vector<std::string> overrides_in(const std::string& text) {
  const std::string mark = "#--set ";
  std::vector<std::string> overrides;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with(mark)) overrides.push_back(line.substr(mark.size()));
  return overrides;
}

/// As Scene::resolved() promises.
void expect_resolved(const Scene& scene) {
  demand(parse_scene(scene.resolved(), "resolved.toml", {}, key_table) == scene,
         "the resolved text of a scene gives an equal scene");
}

}  // namespace

void scene(std::string_view bytes) {
  const std::string text(bytes);
  // Meshes that scenes name lie beside it.
  const Scene scene = parse_scene(text, GNOMON_SOURCE_DIR "/tests/fuzz/scenes/scene.toml",
                                  overrides_in(text), key_table);
  expect_resolved(scene);
  check_run(scene);
  if (!is_small(scene)) return;
  const Setup setup = set_up(scene);
  expect_resolved(setup.scene);
  long unknowns = 0;
  for (const BlockSize& block : setup.model->blocks) unknowns += block.size;
  demand(unknowns == setup.model->system().structure().size, "the blocks hold all unknowns");
}

}  // namespace gnomon::fuzz
