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
  if (key.presence == Key::Presence::optional) comment += "; absent: " + key.absent_meaning;
  return comment;
}

namespace {

std::string presence(const Key& key) {
  switch (key.presence) {
    case Key::Presence::required:
      return "required";
    case Key::Presence::defaulted:
      return "default " + toml_text(key.default_value);
    case Key::Presence::optional:
      return "optional, absent: " + key.absent_meaning;
  }
  return {};
}

}  // namespace

std::string describe_keys(const std::vector<Key>& table) {
  std::string text;
  for (const KeyGroup& group : group_keys(table)) {
    text += text.empty() ? "" : "\n";
    for (const Key& key : group.keys)
      text +=
          fmt::format("{}: {}\n    {}; {}\n", key.name, key.help, expectation(key), presence(key));
  }
  return text;
}

}  // namespace gnomon
