#include "study/keyed_table.hpp"

#include <fmt/format.h>

#include <gnomon/base/error.hpp>
#include <gnomon/scene/keys.hpp>
#include <span>

#include "scene/key_check.hpp"
#include "scene/unknown_key.hpp"

namespace gnomon::study {

namespace {

constexpr Range positive{.min = 0, .min_open = true};

Key integrator_key() {
  return text_key("integrator", required(), "time integration method (gnomon list integrators)");
}

Key name_key() {
  return text_key("name", absent("that of its integrator"), "its name in tables and figures");
}

/// What gives this key in place of the study's settings; empty if nothing does.
std::string owner(const std::string& key, MethodFrom method) {
  const auto by_method = [&](const char* name) {
    return method == MethodFrom::method
               ? fmt::format("`method.{}`", name)
               : fmt::format("the scene, or by `{}` of a [[method]]", name);
  };
  if (key == "problem") return "the scene";
  if (method == MethodFrom::reference) {
    if (key == "integrator.name") return "`reference.integrator`";
    if (key == "integrator.rtol") return "`reference.tolerances`";
    if (key == "integrator.step") return "`reference.tolerances`, which chooses the steps";
  }
  if (key == "integrator.name") return by_method("integrator");
  if (key == "integrator.step") return by_method("steps");
  if (key == "integrator.rtol") return by_method("tolerances");
  if (key == "output.times") return "`times`";
  // They change steps, or what a stopped run loses, not what is stored.
  if (key == "output.settle" || key == "output.checkpoint_seconds") return {};
  if (key.starts_with("output.")) return "the study itself";
  return {};
}

/// In TOML every key below the head of a table belongs to this table.
void require_not_of_the_top(const std::string& name, const std::string& origin) {
  if (find_key(top_keys(), name))
    throw InputError(fmt::format(
        "{}: `{}` is a key of the study, expected it above the first table", origin, name));
}

}  // namespace

std::vector<Key> top_keys() {
  return {
      text_key("scene", required(), "scene file, relative to the study file"),
      reals_key("times", "s",
                absent("five equal parts of time.end; none with reference = \"none\""), positive,
                "times at which errors are measured, besides time.end; steps end there exactly"),
      text_key("reference", absent("a closed form, or two runs: those of two [[reference]] tables"),
               "\"none\": no errors are measured, as for a parameter sweep; methods may be absent",
               {"none"}),
      text_key("self_reference.method", absent("no errors against a run of the study itself"),
               "the method whose run is a second reference, as in the paper"),
      real_key("self_reference.step", "s", absent("self_reference.tolerance is given"), positive,
               "fixed step of this run"),
      real_key("self_reference.tolerance", "", absent("self_reference.step is given"),
               relative_tolerance, "relative tolerance of this run"),
  };
}

std::vector<Key> sweep_keys() {
  return {text_key("key", required(), "the scene key that is varied; `values` holds its values")};
}

std::vector<Key> method_keys() {
  return {name_key(),
          integrator_key(),
          {.name = "steps",
           .kind = KeyKind::reals,
           .unit = "s",
           .absent_meaning = "`tolerances` are given",
           .range = positive,
           .or_single = positive,
           .help = "fixed steps (integrator.step), one run each; `step` is the same"},
          {.name = "tolerances",
           .kind = KeyKind::reals,
           .absent_meaning = "`steps` are given",
           .range = relative_tolerance,
           .or_single = relative_tolerance,
           .help = "relative tolerances (integrator.rtol), one run each; `tolerance` is the same"}};
}

std::vector<Key> reference_keys() {
  return {name_key(),
          integrator_key(),
          {.name = "tolerances",
           .kind = KeyKind::reals,
           .range = relative_tolerance,
           .length = 1,
           .or_single = relative_tolerance,
           .help = "relative tolerance (integrator.rtol); `tolerance` is the same"}};
}

void require_settable(const std::string& key, const std::string& origin, MethodFrom method) {
  if (const std::string by = owner(key, method); !by.empty())
    throw InputError(fmt::format("{}: expected another key, `{}` is given by {}", origin, key, by));
}

SceneSetting scene_setting(const std::string& given, const RawValue& raw, const std::string& origin,
                           const SceneKeys& scene_keys) {
  const std::string name = scene_keys.numbered(given, origin);
  const auto key = find_key(scene_keys.keys, name);
  if (!key) {
    require_not_of_the_top(name, origin);
    refuse_unknown_key(origin, name, raw, scene_keys.keys, "gnomon help scene");
  }
  require_settable(name, origin, scene_keys.method);
  if (scene_keys.impossible == Impossible::kept &&
      std::holds_alternative<Complaint>(check_value(*key, raw)))
    return {name, raw, origin};
  return {name, raw_value(checked_value(*key, raw, origin)), origin};
}

KeyedTable::KeyedTable(const std::string& file, int line, const std::vector<RawEntry>& entries,
                       const TableSpec& spec)
    : file_(file), line_(line), prefix_(spec.prefix) {
  for (const RawEntry& entry : entries) read(entry, spec);
  for (const Key& key : spec.keys)
    if (key.required() && !has(key.name)) refuse_missing_key(where(key.name), key);
  if (!spec.open_key.empty() && open_values_.empty())
    throw InputError(where(spec.open_key) + ": expected an array of one or more values");
}

void KeyedTable::read(const RawEntry& entry, const TableSpec& spec) {
  const std::string origin = message_about(file_, entry.line, prefix_ + entry.name);
  if (!lines_.emplace(entry.name, entry.line).second)
    throw InputError(origin + ": given twice, expected once");
  if (!spec.open_key.empty() && entry.name == spec.open_key) {
    open_values_ = entry.elements;
    return;
  }
  if (spec.scene_keys && entry.name == "set" && is_table(entry.value)) return;  // empty
  if (spec.scene_keys && entry.name.starts_with("set.")) {
    settings_.push_back(scene_setting(entry.name.substr(4), entry.value, origin, *spec.scene_keys));
    for (const SceneSetting& earlier : std::span(settings_).first(settings_.size() - 1))
      if (earlier.key == settings_.back().key)
        throw InputError(
            fmt::format("{}: `{}` is given twice, expected once", origin, earlier.key));
    return;
  }
  if (const auto key = find_key(spec.keys, entry.name)) {
    values_[entry.name] = checked_value(*key, entry.value, origin);
    return;
  }
  require_not_of_the_top(entry.name, origin);
  std::vector<Key> keys = spec.keys;
  if (!spec.open_key.empty()) keys.push_back({.name = spec.open_key});
  refuse_unknown_key(origin, entry.name, entry.value, keys, "gnomon help studies", prefix_);
}

const std::string& KeyedTable::text(const std::string& key) const {
  return std::get<std::string>(values_.at(key));
}

double KeyedTable::real(const std::string& key) const {
  return std::get<double>(values_.at(key));
}

const std::vector<double>& KeyedTable::reals(const std::string& key) const {
  return std::get<std::vector<double>>(values_.at(key));
}

std::string KeyedTable::where(const std::string& key) const {
  const auto line = lines_.find(key);
  return message_about(file_, line == lines_.end() ? line_ : line->second, prefix_ + key);
}

}  // namespace gnomon::study

namespace gnomon {

std::string describe_study_keys() {
  const auto part = [](const std::string& title, const std::vector<Key>& keys) {
    return fmt::format("\n{}\n\n{}", title, describe_keys(keys));
  };
  return part("KEYS OF A STUDY", study::top_keys()) +
         part("KEYS OF EACH [[sweep]] (all combinations are run)", study::sweep_keys()) +
         "values: array of values of that key\n" +
         part("KEYS OF EACH [[method]] (none with reference = \"none\": the scene's integrator)",
              study::method_keys()) +
         part("KEYS OF EACH [[reference]] (two, of different families)", study::reference_keys());
}

}  // namespace gnomon
