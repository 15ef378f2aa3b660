// Loads a scene: file and overrides on one side, the table of keys on the other.

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <gnomon/base/error.hpp>
#include <gnomon/scene/scene.hpp>
#include <set>
#include <system_error>

#include "scene/chosen_name.hpp"
#include "scene/key_check.hpp"
#include "scene/nesting.hpp"
#include "scene/toml_reader.hpp"

namespace gnomon {

namespace {

/// A value that somebody gave for a key.
struct Given {
  std::string name;
  std::string origin;  // beginning of a message about it
  RawValue value;
};

std::string message_about(const std::string& file, int line, const std::string& key) {
  return line ? fmt::format("{}:{}: key `{}`", file, line, key)
              : fmt::format("{}: key `{}`", file, key);
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

void refuse_deep_nesting(const std::string& text) {
  constexpr std::size_t shown = 40;
  const auto deep = find_deep_nesting(text);
  if (!deep) return;
  std::string key = trimmed(text.substr(0, text.find_first_of("=\r\n")));
  if (key.size() > shown) key = key.substr(0, shown) + "...";
  throw InputError(fmt::format("--set {}: {}", key, deep->message));
}

bool is_table(const RawValue& value) {
  const auto* scalar = std::get_if<RawScalar>(&value.content);
  const auto* foreign = scalar ? std::get_if<ForeignValue>(scalar) : nullptr;
  return foreign && foreign->is_table;
}

/// "key=value" of the command line.
Given parse_override(const std::string& text) {
  refuse_deep_nesting(text);
  const std::size_t equals = text.find('=');
  const std::string key = trimmed(text.substr(0, equals));
  if (equals == std::string::npos || key.empty())
    throw InputError(fmt::format("--set {}: expected KEY=VALUE", text));
  const std::string origin = "--set " + key;
  const std::string value = trimmed(text.substr(equals + 1));
  if (value.empty()) throw InputError(origin + ": expected a value behind \"=\"");
  if (auto raw = read_toml_value(value)) return {key, origin, *raw};
  if (value.find_first_of("\"'[]{}#=,\r\n") != std::string::npos)
    throw InputError(fmt::format("{}: not a TOML value: {}", origin, value));
  return {key, origin, RawValue{RawScalar(value)}};  // a bare word is a text
}

std::vector<Given> parse_overrides(const std::vector<std::string>& texts) {
  std::vector<Given> overrides;
  for (const std::string& text : texts) {
    Given given = parse_override(text);
    for (const Given& earlier : overrides)
      if (earlier.name == given.name)
        throw InputError(given.origin + ": given twice, expected once");
    overrides.push_back(std::move(given));
  }
  return overrides;
}

const Given* find(const std::vector<Given>& given, const std::string& name) {
  for (const Given& candidate : given)
    if (candidate.name == name) return &candidate;
  return nullptr;
}

SceneValue checked(const Key& key, const Given& given) {
  const auto result = check_value(key, given.value);
  if (const auto* complaint = std::get_if<Complaint>(&result))
    throw InputError(given.origin + ": " + complaint->text);
  return std::get<SceneValue>(result);
}

/// The key of a chosen name, or the key itself.
Key named(const Key& key, const std::string& name) {
  Key result = key;
  result.name = name;
  return result;
}

/// Whether keys of the table stand below the name.
bool names_table(const std::string& name, const std::vector<Key>& table) {
  return std::any_of(table.begin(), table.end(),
                     [&](const Key& key) { return key.name.starts_with(name + "."); });
}

[[noreturn]] void fail_unknown(const Given& given, const std::vector<Key>& table,
                               const std::string& problem) {
  if (names_table(given.name, table))
    throw InputError(fmt::format("{}: expected a table of keys, [{}], got {}", given.origin,
                                 given.name, describe(given.value)));
  std::vector<std::string> names;
  for (const Key& key : table) names.push_back(key.name);
  const std::string near = nearest_name(given.name, names);
  throw InputError(fmt::format("{}: unknown key, {}", given.origin,
                               near.empty() ? "expected one of `gnomon help scene " + problem + "`"
                                            : "did you mean `" + near + "`?"));
}

/// Whether a whole known table is given; in a file an empty one, of others there are the keys.
bool gives_table(const Given& given, const std::vector<Key>& table) {
  return is_table(given.value) && names_table(given.name, table);
}

}  // namespace

class SceneLoader {
public:
  SceneLoader(std::string name, const std::string& text, const std::vector<std::string>& overrides)
      : name_(std::move(name)), overrides_(parse_overrides(overrides)) {
    for (RawEntry& entry : read_toml(text, name_))
      in_file_.push_back(
          {entry.name, message_about(name_, entry.line, entry.name), std::move(entry.value)});
  }

  Scene load(const KeyTableOf& table_of) const {
    const Given& given = problem();
    const std::string problem = std::get<std::string>(checked(run_keys().front(), given));
    std::vector<Key> table;
    try {
      table = table_of(problem);
    } catch (const InputError& error) {
      throw InputError(given.origin + ": " + error.what());
    }
    // In the order of the file, so that its first mistake is the one that is reported.
    for (const Given& value : in_file_)
      if (!gives_table(value, table)) check_known(value, table, problem);
    for (const Given& value : overrides_) {
      if (gives_table(value, table))
        throw InputError(
            fmt::format("{}: expected one value, as in --set {}.KEY=VALUE, got a table",
                        value.origin, value.name));
      check_known(value, table, problem);
    }

    Scene scene;
    scene.path_ = name_;
    for (const Key& key : table)
      if (key.name.find('*') == std::string::npos)
        scene.entries_.push_back(resolve(key));
      else
        for (const std::string& name : given_names_of(key))
          scene.entries_.push_back(resolve(named(key, name)));
    return scene;
  }

private:
  const Given& problem() const {
    const std::string key = run_keys().front().name;
    if (const Given* given = find(overrides_, key)) return *given;
    if (const Given* given = find(in_file_, key)) return *given;
    // A misspelt key outside any table can only have meant this one.
    for (const Given& given : in_file_)
      if (!nearest_name(given.name, {key}).empty()) fail_unknown(given, {run_keys().front()}, "");
    throw InputError(
        fmt::format("{}: missing, expected the name of a problem (`gnomon list problems`)",
                    message_about(name_, 0, key)));
  }

  /// The key exists and the value is acceptable; also where an override replaces the value.
  static void check_known(const Given& given, const std::vector<Key>& table,
                          const std::string& problem) {
    for (const Key& key : table)
      if (key.name == given.name || chosen_name(key.name, given.name)) {
        checked(named(key, given.name), given);
        return;
      }
    fail_unknown(given, table, problem);
  }

  /// The names, ascending, that file and overrides give keys of a name with "*".
  std::set<std::string> given_names_of(const Key& key) const {
    std::set<std::string> names;
    for (const auto* values : {&overrides_, &in_file_})
      for (const Given& given : *values)
        if (chosen_name(key.name, given.name)) names.insert(given.name);
    return names;
  }

  Scene::Entry resolve(const Key& key) const {
    const std::string origin = message_about(name_, 0, key.name);
    for (const auto* values : {&overrides_, &in_file_})
      if (const Given* given = find(*values, key.name))
        return {key, checked(key, *given), given->origin};
    if (key.presence == Key::Presence::required)
      throw InputError(fmt::format("{}: missing, expected {}", origin, expectation(key)));
    if (key.presence == Key::Presence::defaulted) return {key, key.default_value, origin};
    return {key, std::nullopt, origin};
  }

  std::string name_;
  std::vector<Given> in_file_;
  std::vector<Given> overrides_;
};

Scene parse_scene(const std::string& text, const std::string& name,
                  const std::vector<std::string>& overrides, const KeyTableOf& table_of) {
  return SceneLoader(name, text, overrides).load(table_of);
}

Scene load_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides,
                 const KeyTableOf& table_of) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status))
    throw InputError(fmt::format("{}: no such file, expected a scene", file.string()));
  if (std::filesystem::is_directory(status))
    throw InputError(fmt::format("{}: is a folder, expected a scene file", file.string()));
  std::ifstream stream(file, std::ios::binary);
  constexpr std::size_t most = 1 << 24;  // bytes; a device may go on without an end
  std::string text(most + 1, '\0');
  if (stream.is_open()) stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (!stream.is_open() || stream.bad())
    throw InputError(fmt::format("{}: cannot be read", file.string()));
  if (text.size() > most)
    throw InputError(fmt::format("{}: expected a scene of at most {} bytes", file.string(), most));
  return parse_scene(text, file.string(), overrides, table_of);
}

}  // namespace gnomon
