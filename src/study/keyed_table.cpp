#include "study/keyed_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <gnomon/base/error.hpp>

#include "scene/chosen_name.hpp"
#include "scene/key_check.hpp"
#include "scene/toml_text.hpp"

namespace gnomon::study {

namespace {

[[noreturn]] void fail_unknown(const std::string& origin, const std::string& name,
                               const std::string& prefix, const std::vector<std::string>& names,
                               const std::string& help) {
  const std::string near = nearest_name(name, names);
  throw InputError(fmt::format("{}: unknown key, {}", origin,
                               near.empty() ? "expected one of `" + help + "`"
                                            : fmt::format("did you mean `{}{}`?", prefix, near)));
}

std::vector<std::string> names_of(const std::vector<Key>& keys) {
  std::vector<std::string> names;
  for (const Key& key : keys) names.push_back(key.name);
  return names;
}

bool is_table(const RawValue& value) {
  const auto* scalar = std::get_if<RawScalar>(&value.content);
  const auto* foreign = scalar ? std::get_if<ForeignValue>(scalar) : nullptr;
  return foreign && foreign->is_table;
}

SceneValue checked(const Key& key, const RawValue& raw, const std::string& origin) {
  const auto result = check_value(key, raw);
  if (const auto* complaint = std::get_if<Complaint>(&result))
    throw InputError(origin + ": " + complaint->text);
  return std::get<SceneValue>(result);
}

std::string text_of(const RawScalar& value) {
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* integer = std::get_if<long>(&value)) return fmt::format("{}", *integer);
  if (const auto* real = std::get_if<double>(&value))
    return std::isfinite(*real) ? toml_text(*real) : fmt::format("{}", *real);
  if (const auto* text = std::get_if<std::string>(&value)) return toml_text(*text);
  return "{}";  // a table or a date: no value of any key either
}

/// The value in TOML, whatever its key says of it.
std::string unchecked_text(const RawValue& raw) {
  if (const auto* scalar = std::get_if<RawScalar>(&raw.content)) return text_of(*scalar);
  std::vector<std::string> parts;
  for (const RawScalar& scalar : std::get<RawArray>(raw.content)) parts.push_back(text_of(scalar));
  return fmt::format("[{}]", fmt::join(parts, ", "));
}

/// Why a study gives this key itself; empty if it does not.
std::string owner(const std::string& key) {
  if (key == "problem") return "the scene";
  if (key == "integrator.name") return "`method.integrator`";
  if (key == "integrator.step") return "`method.steps`";
  if (key == "integrator.rtol") return "`method.tolerances`";
  if (key == "output.times") return "`times`";
  if (key.starts_with("output.")) return "the study itself";
  return {};
}

const Key* find(const std::vector<Key>& keys, const std::string& name) {
  const auto key = std::find_if(keys.begin(), keys.end(), [&](const Key& k) {
    return k.name == name || chosen_name(k.name, name);
  });
  return key == keys.end() ? nullptr : &*key;
}

}  // namespace

std::string message_about(const std::string& file, int line, const std::string& key) {
  return line ? fmt::format("{}:{}: key `{}`", file, line, key)
              : fmt::format("{}: key `{}`", file, key);
}

SceneSetting scene_setting(const std::string& name, const RawValue& raw, const std::string& origin,
                           const std::vector<Key>& scene_keys, Impossible impossible) {
  const Key* key = find(scene_keys, name);
  if (!key) fail_unknown(origin, name, "", names_of(scene_keys), "gnomon help scene");
  if (const std::string by = owner(name); !by.empty())
    throw InputError(
        fmt::format("{}: expected another key, `{}` is given by {}", origin, name, by));
  if (impossible == Impossible::kept && std::holds_alternative<Complaint>(check_value(*key, raw)))
    return {name, unchecked_text(raw), origin};
  return {name, toml_text(checked(*key, raw, origin)), origin};
}

KeyedTable::KeyedTable(const std::string& file, int line, const std::vector<RawEntry>& entries,
                       const TableSpec& spec)
    : file_(file), line_(line), prefix_(spec.prefix) {
  for (const RawEntry& entry : entries) read(entry, spec);
  for (const Key& key : spec.keys)
    if (key.presence == Key::Presence::required && !has(key.name))
      throw InputError(fmt::format("{}: missing, expected {}", where(key.name), expectation(key)));
  if (!spec.open_key.empty() && open_values_.empty())
    throw InputError(where(spec.open_key) + ": expected an array of one or more values");
}

void KeyedTable::read(const RawEntry& entry, const TableSpec& spec) {
  const std::string origin = message_about(file_, entry.line, prefix_ + entry.name);
  lines_[entry.name] = entry.line;
  if (!spec.open_key.empty() && entry.name == spec.open_key) {
    open_values_ = entry.elements;
    return;
  }
  if (spec.scene_keys && entry.name == "set" && is_table(entry.value)) return;  // empty
  if (spec.scene_keys && entry.name.starts_with("set.")) {
    settings_.push_back(scene_setting(entry.name.substr(4), entry.value, origin, *spec.scene_keys,
                                      spec.impossible));
    return;
  }
  if (const Key* key = find(spec.keys, entry.name)) {
    values_[entry.name] = checked(*key, entry.value, origin);
    return;
  }
  std::vector<std::string> names = names_of(spec.keys);
  if (!spec.open_key.empty()) names.push_back(spec.open_key);
  fail_unknown(origin, entry.name, prefix_, names, "gnomon help studies");
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
