#include "scene/scene_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <gnomon/base/error.hpp>
#include <gnomon/scene/toml_key.hpp>
#include <set>
#include <system_error>

#include "scene/chosen_name.hpp"
#include "scene/key_check.hpp"
#include "scene/retired_keys.hpp"
#include "scene/toml_reader.hpp"
#include "scene/unknown_key.hpp"

namespace gnomon {

namespace {

const GivenValue* find(const std::vector<GivenValue>& given, const std::string& name) {
  for (const GivenValue& candidate : given)
    if (candidate.name == name) return &candidate;
  return nullptr;
}

std::string read_file(const std::filesystem::path& file) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status))
    throw InputError(fmt::format("{}: no such file, expected a scene", file.string()));
  if (std::filesystem::is_directory(status))
    throw InputError(fmt::format("{}: is a folder, expected a scene file", file.string()));
  std::ifstream stream(file, std::ios::binary);
  constexpr std::size_t most = 1 << 24;  // bytes; a device may have no end
  std::string text(most + 1, '\0');
  if (stream.is_open()) stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (!stream.is_open() || stream.bad())
    throw InputError(fmt::format("{}: cannot be read", file.string()));
  if (text.size() > most)
    throw InputError(fmt::format("{}: expected a scene of at most {} bytes", file.string(), most));
  return text;
}

}  // namespace

GivenValue override_of(const std::string& key, RawValue value) {
  return {key, "--set " + key, std::move(value)};
}

/// Puts the values of a file and overrides together with the defaults of a key table.
class SceneLoader {
public:
  SceneLoader(const std::string& name, std::vector<GivenValue> in_file,
              std::vector<GivenValue> overrides)
      : name_(name), in_file_(std::move(in_file)), overrides_(std::move(overrides)) {}

  Scene load(const KeyTableOf& table_of, Mistakes& mistakes) {
    const GivenValue& given = problem();
    const std::string problem =
        std::get<std::string>(checked_value(run_keys().front(), given.value, given.origin));
    std::vector<Key> table;
    try {
      table = table_of(problem);
    } catch (const InputError& error) {
      throw InputError(given.origin + ": " + error.what());
    }
    in_file_ = without_retired_keys(std::move(in_file_), table);
    overrides_ = without_retired_keys(std::move(overrides_), table);
    // In the order of the file, so that its first mistake is the first that is reported.
    std::set<std::string> refused;  // [load] for [[load]], once for all its keys
    for (const GivenValue& value : in_file_) {
      if (gives_table(value.name, value.value, table)) continue;
      const auto array = array_without_number(value.name, table);
      if (!array || refused.insert(*array).second)
        mistakes.collect([&] { check(value, table, problem); });
    }
    for (const GivenValue& value : overrides_)
      mistakes.collect([&] { check_override(value, table, problem); });
    const std::set<std::string> meant = keys_meant(table);

    Scene scene;
    scene.path_ = name_;
    for (const Key& key : table)
      if (key.name.find_first_of("*#") == std::string::npos)
        scene.entries_.push_back(resolve(key, meant, mistakes));
      else
        for (const std::string& name : given_names_of(key))
          scene.entries_.push_back(resolve(*find_key({key}, name), meant, mistakes));
    for (Scene::Entry& entry : scene.entries_)
      if (!entry.key.or_product.empty()) mistakes.collect([&] { multiply(entry, scene, meant); });
    return scene;
  }

private:
  const GivenValue& problem() const {
    const Key& key = run_keys().front();
    if (const GivenValue* given = find(overrides_, key.name)) return *given;
    if (const GivenValue* given = find(in_file_, key.name)) return *given;
    // A misspelt key outside any table can only have meant this one.
    for (const GivenValue& given : in_file_)
      if (!nearest_name(given.name, {key.name}).empty())
        refuse_unknown_key(given.origin, given.name, given.value, {key}, "gnomon help scene");
    throw InputError(
        fmt::format("{}: missing, expected the name of a problem (`gnomon list problems`)",
                    message_about(name_, 0, key.name)));
  }

  /// The key exists and the value is acceptable; also where an override replaces the value.
  static void check(const GivenValue& given, const std::vector<Key>& table,
                    const std::string& problem) {
    const auto key = find_key(table, given.name);
    if (!key)
      refuse_unknown_key(given.origin, given.name, given.value, table,
                         "gnomon help scene " + problem);
    checked_value(*key, given.value, given.origin);
  }

  static void check_override(const GivenValue& given, const std::vector<Key>& table,
                             const std::string& problem) {
    if (gives_table(given.name, given.value, table))
      throw InputError(fmt::format("{}: expected one value, as in --set {}.KEY=VALUE, got a table",
                                   given.origin, given.name));
    if (const auto array = array_without_number(given.name, table); array && given.name != *array) {
      const std::string key = given.name.substr(array->size());
      throw InputError(fmt::format("{}: expected the number of a [[{}]], as in {}.1{}",
                                   given.origin, *array, *array,
                                   key.starts_with(".#") ? key.substr(2) : key));
    }
    if (const auto number = given.name.find(".#"); number != given.name.npos)
      throw InputError(
          fmt::format("{}: expected a number or a name in the place of #, as in {}.1{}",
                      given.origin, given.name.substr(0, number), given.name.substr(number + 2)));
    check(given, table, problem);
  }

  /// The keys that unknown ones seem to mean: they are not reported as missing as well.
  std::set<std::string> keys_meant(const std::vector<Key>& table) const {
    std::set<std::string> meant;
    for (const auto* values : {&overrides_, &in_file_})
      for (const GivenValue& given : *values)
        if (!find_key(table, given.name) && !gives_table(given.name, given.value, table))
          meant.insert(key_meant(given.name, table));
    return meant;
  }

  /// The names, ascending, that file and overrides give keys of a name with "*" or "#".
  std::set<std::string> given_names_of(const Key& key) const {
    std::set<std::string> names;
    for (const auto* values : {&overrides_, &in_file_})
      for (const GivenValue& given : *values)
        if (chosen_name(key.name, given.name)) names.insert(given.name);
    return names;
  }

  /// Values that the key does not accept are reported by check() and left out.
  Scene::Entry resolve(const Key& key, const std::set<std::string>& meant,
                       Mistakes& mistakes) const {
    Scene::Entry entry{key, key.default_value, {}};
    for (const auto* values : {&overrides_, &in_file_})
      if (const GivenValue* given = find(*values, key.name)) {
        entry.origin = given->origin;
        const auto checked = check_value(key, given->value);
        if (const auto* value = std::get_if<SceneValue>(&checked)) entry.value = *value;
        return entry;
      }
    if (key.required() && key.or_product.empty() && !meant.contains(key.name) &&
        !given_as_array(key.name))
      mistakes.collect([&] { refuse_missing_key(message_about(name_, 0, key.name), key); });
    return entry;
  }

  /// Whether the file has an array, [[body]], in the place of the table of a key.
  bool given_as_array(const std::string& name) const {
    const std::string first = name.substr(0, name.find('.')) + ".1.";
    return std::ranges::any_of(
        in_file_, [&](const GivenValue& given) { return given.name.starts_with(first); });
  }

  /// Gives the entry the value of its product (Key::or_product) where the scene has that. The first
  /// factor, whose only use this is, is left out then. An override goes before the file.
  void multiply(Scene::Entry& entry, Scene& scene, const std::set<std::string>& meant) const {
    const std::string& first = entry.key.or_product.front();
    const bool by_product = scene.given(first);
    if (by_product && entry.value) {
      const bool overridden = find(overrides_, entry.key.name);
      if (overridden == (find(overrides_, first) != nullptr))
        throw InputError(fmt::format("{}: expected either {} or {}, got both", scene.where(first),
                                     entry.key.name, first));
      if (overridden) return scene.value(first).reset();
    }
    // A value that was refused has its own mistake.
    const auto is_given = [&](const std::string& name) {
      return find(overrides_, name) || find(in_file_, name) || meant.contains(name);
    };
    if (!by_product && !is_given(entry.key.name) && !is_given(first))
      refuse_missing_key(message_about(name_, 0, entry.key.name), entry.key);
    if (!by_product) return;
    double product = 1;
    for (const std::string& factor : entry.key.or_product) {
      if (!scene.has(factor) && is_given(factor)) return;
      if (!scene.has(factor))
        throw InputError(fmt::format("{}: expected also {}", scene.where(first), factor));
      product *= scene.real(factor);
    }
    entry.origin = scene.where(first);
    const auto checked = check_value(entry.key, RawValue{RawScalar(product)});
    if (const auto* complaint = std::get_if<Complaint>(&checked))
      throw InputError(entry.origin + ": as " + entry.key.name + " " + complaint->text);
    entry.value = std::get<SceneValue>(checked);
    scene.value(first).reset();
  }

  const std::string& name_;
  std::vector<GivenValue> in_file_, overrides_;
};

SceneFile::SceneFile(const std::filesystem::path& file)
    : SceneFile(read_file(file), file.string()) {}

SceneFile::SceneFile(const std::string& text, const std::string& name) : name_(name) {
  for (RawEntry& entry : read_toml(text, name))
    values_.push_back(
        {entry.name, message_about(name, entry.line, entry.name), std::move(entry.value)});
}

std::string SceneFile::numbered(const std::string& key, const std::string& origin) const {
  for (const GivenValue& given : values_) {
    if (!given.name.ends_with(".name")) continue;
    const auto* scalar = std::get_if<RawScalar>(&given.value.content);
    const auto* name = scalar ? std::get_if<std::string>(scalar) : nullptr;
    const std::string entry = given.name.substr(0, given.name.size() - 5);  // "body.2"
    if (!name || entry.find('.') == std::string::npos) continue;
    const std::string array = entry.substr(0, entry.find('.') + 1),
                      named = array + toml_key(*name) + ".", bare = array + *name + ".";
    if (key.starts_with(named)) return entry + "." + key.substr(named.size());
    if (key.starts_with(bare))
      throw InputError(fmt::format("{}: expected quotes around the name, {}{}", origin, named,
                                   key.substr(bare.size())));
  }
  return key;
}

Scene SceneFile::scene(std::vector<GivenValue> overrides, const KeyTableOf& table_of,
                       Mistakes* mistakes) const {
  Mistakes own;
  for (GivenValue& given : overrides) given.name = numbered(given.name, given.origin);
  Scene scene =
      SceneLoader(name_, values_, std::move(overrides)).load(table_of, mistakes ? *mistakes : own);
  own.require_none();
  return scene;
}

}  // namespace gnomon
