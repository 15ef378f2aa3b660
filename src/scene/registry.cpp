#include <gnomon/scene/registry.hpp>
#include <map>

namespace gnomon {

std::shared_ptr<void>& registered_of_type(const char* type) {
  // Function-local, because it is filled during static initialisation; never destroyed, because a
  // value may be of a plug-in whose code is gone at the end of the process.
  static auto& kept = *new std::map<std::string, std::shared_ptr<void>>;
  return kept[type];
}

Key* same_key(std::vector<Key>& table, const Key& key, const std::string& thing) {
  const auto same = std::ranges::find(table, key.name, &Key::name);
  if (same == table.end()) return nullptr;
  if (same->kind != key.kind || same->length != key.length ||
      (same->default_value && same->default_value != key.default_value))
    throw RegistrationError(thing + " has the key " + key.name +
                            " with another kind, length or default than the key of this name that "
                            "is known, expected another name or the same");
  return &*same;
}

void require_optional(const Key& key, const std::string& thing) {
  if (key.required())
    throw RegistrationError(thing + " has the key " + key.name +
                            " without a default, expected one, or `absent_meaning`: scenes that "
                            "choose another do not have it");
}

void add_key_of_choice(std::vector<Key>& table, const Key& key, const std::string& choice,
                       const std::string& thing) {
  require_optional(key, thing);
  const auto idle = [choice, thing](const Scene& scene) {
    const std::string& chosen = scene.text(choice);
    return chosen == thing ? "" : choice + " is \"" + chosen + "\"";
  };
  Key* const same = same_key(table, key, thing);
  if (same == nullptr) {
    table.push_back(key);
    table.back().idle = idle;
    return;
  }
  if (same->idle)  // of another thing
    same->idle = [idle, other = same->idle](const Scene& scene) {
      return other(scene).empty() ? "" : idle(scene);
    };
}

}  // namespace gnomon
