#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/model/wear_scene.hpp>
#include <gnomon/scene/toml_key.hpp>
#include <gnomon/wear_laws/wear_law_kind.hpp>

#include "expressions/expression_text.hpp"

namespace gnomon {

namespace {

bool is_expression(const Scene& scene) {
  return scene.text("wear.law") == "expression";
}

/// Whether a law that is no expression reads k.
bool law_reads_coefficient(const Scene& scene) {
  return Registry<WearLawKind>::find(scene.text("wear.law"), "wear law").reads_coefficient;
}

/// Whether the law of a surface may read k.
bool reads_coefficient(const Scene& scene, const std::string& surface) {
  if (!is_expression(scene)) return law_reads_coefficient(scene);
  const std::string own = "wear.surfaces." + toml_key(surface) + ".rate";
  return tokens_in(scene.text(scene.given(own) ? own : "wear.rate")).contains("k");
}

/// The wearing surfaces whose law reads a coefficient that they have not.
std::vector<std::string> without_coefficient(const Scene& scene) {
  if (!scene.given("wear.on")) return {};
  std::vector<std::string> names = scene.texts("wear.on");
  std::erase_if(names, [&](const std::string& name) {
    return scene.given("wear.surfaces." + toml_key(name) + ".coefficient") ||
           !reads_coefficient(scene, name);
  });
  return names;
}

}  // namespace

void require_surface_names(const Scene& scene) {
  const std::vector<std::string>& surfaces = scene.texts("wear.on");
  for (const char* key : {".rate", ".coefficient", ".path"})
    for (const std::string& name : scene.chosen_names("wear.surfaces.\"*\"" + std::string(key)))
      if (std::ranges::find(surfaces, name, toml_key) == surfaces.end())
        throw InputError(fmt::format("{}: expected one of wear.on, \"{}\", in the place of {}",
                                     scene.where("wear.surfaces." + name + key),
                                     fmt::join(surfaces, "\", \""), name));
}

void require_coefficient(const Scene& scene) {
  if (!scene.knows("wear.rate") || scene.has("wear.coefficient") || !reads_in_rates(scene, "k") ||
      (!is_expression(scene) && !law_reads_coefficient(scene)))
    return;
  if (scene.given("wear.on")) require_surface_names(scene);
  const std::vector<std::string> names = without_coefficient(scene);
  const bool by_surface = scene.given("wear.on") && !scene.texts("wear.on").empty();
  if (by_surface && names.empty()) return;
  throw InputError(scene.where("wear.coefficient") +
                   ": missing, expected a number [1/MPa]: the wear law reads it, as k" +
                   (by_surface ? fmt::format(", of \"{}\"; wear.surfaces.{}.coefficient gives it "
                                             "for one surface",
                                             fmt::join(names, "\", \""), toml_key(names.front()))
                               : ""));
}

bool asks_for_wear(const Scene& scene) {
  return scene.real_if("wear.coefficient").value_or(1) > 0;
}

}  // namespace gnomon
