#include "study/methods.hpp"

#include <fmt/format.h>

#include <gnomon/base/error.hpp>
#include <gnomon/integrators/integrator.hpp>
#include <optional>
#include <utility>

#include "scene/toml_text.hpp"

namespace gnomon::study {

namespace {

using Kind = StudySetting::Kind;

/// One word for one value and for several.
std::vector<RawEntry> with_plurals(std::vector<RawEntry> entries) {
  for (RawEntry& entry : entries)
    if (entry.name == "step" || entry.name == "tolerance") entry.name += "s";
  return entries;
}

/// What a method and a reference may both have.
Method common_of(const KeyedTable& keyed) {
  Method method;
  method.integrator = keyed.text("integrator");
  method.name = keyed.has("name") ? keyed.text("name") : method.integrator;
  method.settings = keyed.settings();
  for (const SceneSetting& setting : method.settings)
    if (setting.key == "time.end" || setting.key == "time.cycles")
      throw InputError(setting.origin +
                       ": cannot differ between methods, expected it in [set] or a [[sweep]]");
  method.origin = keyed.where("integrator");
  try {
    Integrators::find(method.integrator, "integrator");
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", method.origin, error.what()));
  }
  return method;
}

void add_ladder(Method& method, const KeyedTable& keyed, const std::string& key, Kind kind) {
  if (!keyed.has(key)) return;
  for (const double value : keyed.reals(key)) {
    for (const StudySetting& earlier : method.ladder)
      if (earlier.kind == kind && earlier.value == value)
        throw InputError(fmt::format("{}: {} is given twice, expected once", keyed.where(key),
                                     number_text(value)));
    method.ladder.push_back({kind, value});
  }
}

}  // namespace

void add_method(const std::string& file, const RawTable& table, const SceneKeys& scene_keys,
                std::vector<Method>& methods) {
  const KeyedTable keyed(file, table.line, with_plurals(table.entries),
                         {.prefix = "method.", .keys = method_keys(), .scene_keys = &scene_keys});
  Method method = common_of(keyed);
  add_ladder(method, keyed, "steps", Kind::step);
  add_ladder(method, keyed, "tolerances", Kind::tolerance);
  if (method.ladder.empty())
    throw InputError(fmt::format("{}: `{}` has nothing to run, expected steps or tolerances",
                                 method.origin, method.name));
  if (keyed.has("steps") && !Integrators::find(method.integrator, "integrator").fixed_steps)
    throw InputError(fmt::format("{}: expected tolerances, {} chooses its own steps",
                                 keyed.where("steps"), method.integrator));
  for (const Method& earlier : methods)
    if (earlier.name == method.name)
      throw InputError(fmt::format("{}: two methods are called \"{}\", expected different names",
                                   keyed.where(keyed.has("name") ? "name" : "integrator"),
                                   method.name));
  methods.push_back(std::move(method));
}

Method method_of_scene(const Scene& scene) {
  Method method;
  method.integrator = method.name = scene.text("integrator.name");
  method.origin = scene.where("integrator.name");
  const std::optional<double> step = scene.real_if("integrator.step");
  method.ladder = {step ? StudySetting{Kind::step, *step}
                        : StudySetting{Kind::tolerance, scene.real("integrator.rtol")}};
  return method;
}

Method read_reference(const std::string& file, const RawTable& table, SceneKeys scene_keys) {
  scene_keys.method = MethodFrom::reference;
  const KeyedTable keyed(
      file, table.line, with_plurals(table.entries),
      {.prefix = "reference.", .keys = reference_keys(), .scene_keys = &scene_keys});
  Method method = common_of(keyed);
  method.ladder = {{Kind::tolerance, keyed.reals("tolerances").front()}};
  return method;
}

std::vector<Method> default_references(const std::string& file) {
  const std::string origin = file + ": default reference";
  // On the pin, the error of the first is 1e-10 mm and that of the second 1e-9 mm.
  return {{"esdirk-5",
           "esdirk-5",
           {{Kind::tolerance, 1e-8}},
           {{"integrator.events", {RawScalar("locate")}, origin}},
           origin},
          {"bdf", "bdf", {{Kind::tolerance, 1e-9}}, {}, origin}};
}

void require_two_families(const std::vector<Method>& references) {
  const auto family = [](const Method& method) {
    return Integrators::find(method.integrator, "integrator").family;
  };
  if (references.size() != 2)
    throw InputError(
        fmt::format("{}: expected two [[reference]] tables, or none of them for the default ones "
                    "(or reference = \"none\" for a study without errors), got {}",
                    references.back().origin, references.size()));
  if (family(references[0]) == family(references[1]))
    throw InputError(fmt::format("{}: expected references of two families, both are {}",
                                 references[1].origin, family(references[0])));
}

std::string kind_name(Kind kind) {
  return kind == Kind::step ? "step" : "rtol";
}

std::string number_text(double value) {
  std::string text = toml_text(value);
  return text.ends_with(".0") ? text.substr(0, text.size() - 2) : text;
}

}  // namespace gnomon::study
