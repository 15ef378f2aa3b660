#include <algorithm>
#include <gnomon/study/extremes.hpp>
#include <set>

#include "fuzz/targets.hpp"
#include "study/declaration.hpp"

namespace gnomon::fuzz {

namespace {

using study::Declaration;
using study::Method;
using study::SceneSetting;

bool sizes_a_model(const std::vector<SceneSetting>& settings) {
  return std::any_of(settings.begin(), settings.end(), [](const SceneSetting& setting) {
    return setting.key.starts_with("mesh.") || setting.key == "foundation.points";
  });
}

/// Few runs of the small models that the scenes have.
bool is_quick(const Declaration& declaration) {
  constexpr std::size_t few = 24;
  bool sizes = sizes_a_model(declaration.common);
  std::size_t runs = 0;
  for (const Method& method : declaration.methods) {
    runs += method.ladder.size();
    sizes |= sizes_a_model(method.settings);
  }
  for (const Method& reference : declaration.references) sizes |= sizes_a_model(reference.settings);
  for (const study::Sweep& sweep : declaration.sweeps) {
    if (runs <= few) runs *= sweep.values.size();
    sizes |= sizes_a_model(sweep.values);
  }
  return runs <= few && !sizes;
}

void expect_sound(const Study& study) {
  std::set<std::string> names;
  for (const StudyRun& run : study.runs)
    demand(names.insert(run.name).second, "the runs of a study have names of their own");
  for (const StudyPoint& point : study.points)
    demand(point.run < study.runs.size() && point.sweep < study.sweep.size(),
           "the points of a study name its runs and sweep points");
}

}  // namespace

void study(std::string_view bytes) {
  static const Folder folder("study");
  static const bool scenes_there = [] {
    for (const char* name : {"pin.toml", "ball.toml", "punch.toml", "springs.toml", "decay.toml"})
      folder.put(name, read_file(std::string("scenes/") + name));
    return true;
  }();
  demand(scenes_there, "the scenes are there");
  const auto file = folder.put("study.toml", bytes);
  if (!is_quick(study::read_declaration(file, Impossible::kept))) return;
  expect_sound(load_study(file, Impossible::kept));
  expect_sound(load_study(file));
}

}  // namespace gnomon::fuzz
