#include "scene/table_layout.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/key_check.hpp"
#include "scene/toml_text.hpp"

namespace gnomon {

std::vector<KeyGroup> group_keys(const std::vector<Key>& table) {
  std::vector<KeyGroup> groups(1);  // the group without a name
  for (const Key& key : table) {
    const std::size_t dot = key.name.rfind('.');
    const std::string name = dot == std::string::npos ? "" : key.name.substr(0, dot);
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const KeyGroup& candidate) { return candidate.name == name; });
    if (group == groups.end()) group = groups.insert(group, KeyGroup{name, {}});
    group->keys.push_back(key);
  }
  if (groups.front().keys.empty()) groups.erase(groups.begin());
  return groups;
}

std::string last_part(const std::string& name) {
  return name.substr(name.rfind('.') + 1);
}

std::string key_comment(const Key& key) {
  std::string comment = key.unit.empty() ? key.help : fmt::format("[{}] {}", key.unit, key.help);
  if (!key.absent_meaning.empty()) comment += "; absent: " + key.absent_meaning;
  return comment;
}

namespace {

/// Whether a key of an array of tables, "body.#.element", is also one of a single table.
bool stands_in_table_too(const Key& key, const std::vector<Key>& table) {
  const std::size_t number = key.name.find("#.");
  return number != std::string::npos &&
         std::ranges::count(table, std::string(key.name).erase(number, 2), &Key::name) > 0;
}

std::string presence(const Key& key, const std::vector<Key>& table) {
  const std::size_t dot = key.name.rfind('.');
  if (dot != std::string::npos &&
      std::ranges::count(table, std::string(key.name).insert(dot, ".#"), &Key::name) > 0) {
    const std::string name = key.name.substr(0, dot);
    return presence(key, {}) + fmt::format("; [{0}], or each [[{0}]]", name);
  }
  if (key.default_value) return "default " + toml_text(*key.default_value);
  return key.required() ? "required" : "optional, absent: " + key.absent_meaning;
}

}  // namespace

std::string describe_keys(const std::vector<Key>& table) {
  std::string text;
  for (const KeyGroup& group : group_keys(table)) {
    std::string entries;
    for (const Key& key : group.keys)
      if (!stands_in_table_too(key, table))
        entries += fmt::format("{}: {}\n    {}; {}\n", key.name, key.help, expectation(key),
                               presence(key, table));
    text += text.empty() || entries.empty() ? entries : "\n" + entries;
  }
  return text;
}

}  // namespace gnomon
