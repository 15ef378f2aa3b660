// Typed access to a validated scene and its resolved dump.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/scene/scene.hpp>
#include <map>
#include <stdexcept>

#include "scene/chosen_name.hpp"
#include "scene/key_check.hpp"
#include "scene/table_layout.hpp"
#include "scene/toml_text.hpp"

namespace gnomon {

const Scene::Entry& Scene::entry(const std::string& key) const {
  for (const Entry& entry : entries_)
    if (entry.key.name == key) return entry;
  throw std::logic_error("scene key `" + key + "` is in no table");
}

template <class T>
const T& Scene::read(const std::string& key) const {
  const T* typed = std::get_if<T>(&any(key));
  if (!typed) throw std::logic_error("scene key `" + key + "` has another type");
  return *typed;
}

bool Scene::flag(const std::string& key) const {
  return read<bool>(key);
}
long Scene::integer(const std::string& key) const {
  return read<long>(key);
}
double Scene::real(const std::string& key) const {
  return read<double>(key);
}

const std::string& Scene::text(const std::string& key) const {
  return read<std::string>(key);
}

const std::vector<long>& Scene::integers(const std::string& key) const {
  return read<std::vector<long>>(key);
}

const std::vector<double>& Scene::reals(const std::string& key) const {
  return read<std::vector<double>>(key);
}

const std::vector<std::string>& Scene::texts(const std::string& key) const {
  return read<std::vector<std::string>>(key);
}

const SceneValue& Scene::any(const std::string& key) const {
  const Entry& found = entry(key);
  if (!found.value) throw std::logic_error("scene key `" + key + "` is absent");
  *found.is_read = true;
  return *found.value;
}

bool Scene::has(const std::string& key) const {
  return entry(key).value.has_value();
}

bool Scene::has_text_instead(const std::string& key) const {
  const Entry& found = entry(key);
  const bool instead = found.key.kind == KeyKind::reals && found.value &&
                       std::holds_alternative<std::string>(*found.value);
  if (instead) *found.is_read = true;
  return instead;
}

bool Scene::knows(const std::string& key) const {
  return std::any_of(entries_.begin(), entries_.end(),
                     [&](const Entry& entry) { return entry.key.name == key; });
}

bool Scene::given(const std::string& key) const {
  return knows(key) && has(key);
}

bool Scene::is_default(const std::string& key) const {
  return entry(key).value == entry(key).key.default_value;
}

namespace {

/// Why the scene has no use for the key; empty where it has one.
std::string why_idle(const Scene& scene, const Key& key) {
  return key.idle ? key.idle(scene) : "";
}

}  // namespace

std::vector<std::string> Scene::idle_texts() const {
  std::map<std::string, std::vector<std::string>> keys_by_reason;
  for (const Entry& entry : entries_)
    if (!entry.origin.empty())
      if (const std::string reason = why_idle(*this, entry.key); !reason.empty())
        keys_by_reason[reason].push_back(entry.key.name);
  std::vector<std::string> texts;
  for (const auto& [reason, keys] : keys_by_reason)
    texts.push_back(fmt::format("{} {} no effect: {}", fmt::join(keys, ", "),
                                keys.size() == 1 ? "has" : "have", reason));
  return texts;
}

std::vector<std::string> Scene::unread_keys() const {
  std::vector<std::string> keys;
  for (const Entry& entry : entries_)
    if (!entry.origin.empty() && entry.value && entry.value != entry.key.default_value &&
        !*entry.is_read && why_idle(*this, entry.key).empty())
      keys.push_back(entry.key.name);
  return keys;
}

bool Scene::is_set(const std::string& key) const {
  return !entry(key).origin.empty();
}

std::optional<double> Scene::real_if(const std::string& key) const {
  return has(key) ? std::optional(real(key)) : std::nullopt;
}

std::vector<std::string> Scene::chosen_names(const std::string& key) const {
  std::vector<std::string> names;
  for (const Entry& entry : entries_)
    if (const auto name = chosen_name(key, entry.key.name)) names.push_back(*name);
  return names;
}

std::vector<Key> Scene::controlling_keys() const {
  std::vector<Key> keys;
  for (const Entry& entry : entries_) {
    if (!entry.key.controls) continue;
    // Whether a choice of model applies, it says itself: it may change other keys.
    const bool is_model = entry.key.controls->source == ErrorSource::model;
    if (is_model || why_idle(*this, entry.key).empty()) keys.push_back(entry.key);
  }
  return keys;
}

std::string Scene::where(const std::string& key) const {
  const std::string& origin = entry(key).origin;
  return origin.empty() ? message_about(path_.string(), 0, key) : origin;
}

std::optional<SceneValue>& Scene::value(const std::string& key) {
  entry(key);  // for its error
  return std::find_if(entries_.begin(), entries_.end(),
                      [&](const Entry& entry) { return entry.key.name == key; })
      ->value;
}

Scene Scene::with(const std::string& key, SceneValue value) const {
  Scene result = *this;
  result.value(key) = std::move(value);
  return result;
}

Scene Scene::with(Key key, SceneValue value) const {
  if (knows(key.name)) return with(key.name, std::move(value));
  Scene result = *this;
  const std::string table = key.name.substr(0, key.name.find('.') + 1);
  auto place = result.entries_.end();
  while (place != result.entries_.begin() && !std::prev(place)->key.name.starts_with(table))
    --place;
  if (place == result.entries_.begin()) place = result.entries_.end();
  result.entries_.insert(place, {std::move(key), std::move(value), {}});
  return result;
}

Scene Scene::without(const std::string& key) const {
  if (entry(key).key.required()) throw std::logic_error("scene key `" + key + "` is not optional");
  Scene result = *this;
  const auto place =
      std::ranges::find(result.entries_, key, [](const Entry& entry) { return entry.key.name; });
  place->value = place->key.default_value;
  place->origin = {};
  return result;
}

Scene Scene::with_absolute_files() const {
  Scene result = *this;
  for (Entry& entry : result.entries_)
    if (auto* name = entry.value ? std::get_if<std::string>(&*entry.value) : nullptr;
        name && entry.key.names_file)
      *name = std::filesystem::absolute(path_.parent_path() / *name).lexically_normal().string();
  return result;
}

std::vector<std::string> Scene::differing_keys(const Scene& a, const Scene& b) {
  const auto value_in = [](const Scene& scene, const std::string& name) {
    for (const Entry& entry : scene.entries_)
      if (entry.key.name == name) return entry.value;
    return std::optional<SceneValue>();
  };
  std::vector<std::string> keys;
  for (const Entry& entry : a.entries_)
    if (entry.value != value_in(b, entry.key.name)) keys.push_back(entry.key.name);
  for (const Entry& entry : b.entries_)  // of another problem
    if (entry.value && !value_in(a, entry.key.name) &&
        std::find(keys.begin(), keys.end(), entry.key.name) == keys.end())
      keys.push_back(entry.key.name);
  return keys;
}

bool operator==(const Scene& a, const Scene& b) {
  return std::equal(a.entries_.begin(), a.entries_.end(), b.entries_.begin(), b.entries_.end(),
                    [](const Scene::Entry& x, const Scene::Entry& y) {
                      return x.key.name == y.key.name && x.value == y.value;
                    });
}

namespace {

/// A single number as itself where the key takes one instead of an array.
std::string value_text(const Key& key, const SceneValue& value) {
  const auto* numbers = std::get_if<std::vector<double>>(&value);
  const bool single =
      key.or_single && numbers && numbers->size() == 1 && inside(*key.or_single, numbers->front());
  return toml_text(single ? SceneValue(numbers->front()) : value);
}

}  // namespace

std::string Scene::resolved() const {
  std::vector<Key> keys;
  for (const Entry& entry : entries_) {
    const bool is_given = entry.value && entry.value != entry.key.default_value;
    if (is_given || why_idle(*this, entry.key).empty()) keys.push_back(entry.key);
  }
  std::string text;
  for (const KeyGroup& group : group_keys(keys)) {
    if (!group.name.empty()) text += fmt::format("\n[{}]\n", group.name);
    std::vector<std::string> assignments;
    for (const Key& key : group.keys) {
      const auto& value = entry(key.name).value;
      const std::string name = last_part(key.name);
      assignments.push_back(value ? fmt::format("{} = {}", name, value_text(key, *value))
                                  : fmt::format("# {} = ...", name));
    }
    std::size_t width =
        0;  // comments are aligned, but a single long array does not move all of them
    for (const std::string& assignment : assignments)
      if (assignment.size() <= 40) width = std::max(width, assignment.size());
    for (std::size_t i = 0; i < assignments.size(); ++i)
      text += fmt::format("{:<{}}  # {}\n", assignments[i], width, key_comment(group.keys[i]));
  }
  return text;
}

}  // namespace gnomon
