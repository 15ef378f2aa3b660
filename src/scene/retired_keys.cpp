#include "scene/retired_keys.hpp"

#include <algorithm>

#include "scene/chosen_name.hpp"
#include "scene/key_check.hpp"
#include "scene/toml_text.hpp"

namespace gnomon {

namespace {

struct RetiredKey {
  std::string name;          ///< with "*" or "#" as that of a Key
  std::string now = {};      ///< its name today, with the same "*"; empty: it has none
  std::string instead = {};  ///< of one without a name: "expected ..."; empty: no number is missed
  std::vector<SceneValue> ignored = {};  ///< values that need nothing instead: earlier defaults
};

std::vector<RetiredKey> make_keys() {
  const std::string linear =
      "expected body.material = \"linear\", which has small strains, in its place";
  const std::string side = "expected counter_body.side in its place: ";
  return {
      {.name = "output.last",
       .instead = "expected none: the end of a run is always stored",
       .ignored = {true}},
      {.name = "output.checkpoints"},  // it is in every earlier result
      {.name = "shape.augmentation"},  // it changes no solution
      {.name = "shape.young_modulus"},
      {.name = "mesh.geometry", .now = "mesh.file"},
      {.name = "body.plane", .now = "model.plane"},
      {.name = "body.kinematics", .instead = linear, .ignored = {"finite"}},
      {.name = "body.#.kinematics", .instead = linear, .ignored = {"finite"}},
      {.name = "wear.tables.*.x", .now = "tables.*.x"},
      {.name = "wear.tables.*.y", .now = "tables.*.y"},
      {.name = "cycle.tables.*.x", .now = "tables.*.x"},
      {.name = "cycle.tables.*.y", .now = "tables.*.y"},
      {.name = "counter_body.apex", .now = "counter_body.center"},
      {.name = "counter_body.point", .now = "counter_body.center"},
      {.name = "counter_body.minor_radius", .now = "counter_body.radius"},
      {.name = "counter_body.file", .now = "counter_body.points"},
      {.name = "counter_body.closed",
       .instead = side + "\"inside\" or \"outside\" of a closed curve, \"left\" or \"right\" of an "
                         "open one",
       .ignored = {false}},
      {.name = "counter_body.concave",
       .instead = side + "\"outside\" of the shape, or \"inside\"",
       .ignored = {false}},
      {.name = "counter_body.motion.out_of_plane",
       .instead = "expected counter_body.motion.velocity with a third number in its place"},
  };
}

const RetiredKey* find_retired(const std::string& name) {
  static const std::vector<RetiredKey> keys = make_keys();
  for (const RetiredKey& key : keys)
    if (key.name == name || chosen_name(key.name, name)) return &key;
  return nullptr;
}

bool is_number(const RawValue& value) {
  const auto* scalar = std::get_if<RawScalar>(&value.content);
  return scalar &&
         (std::holds_alternative<long>(*scalar) || std::holds_alternative<double>(*scalar));
}

bool is_ignored(const RetiredKey& key, const RawValue& value) {
  if (!key.now.empty()) return false;
  if (key.instead.empty()) return is_number(value);
  return std::ranges::any_of(key.ignored, [&](const SceneValue& ignored) {
    return toml_text(ignored) == toml_text(value);
  });
}

/// The name today of a retired key of this name.
std::string name_now(const RetiredKey& key, const std::string& name) {
  std::string now = key.now;
  if (const auto chosen = chosen_name(key.name, name); chosen && !now.empty())
    now.replace(now.find('*'), 1, *chosen);
  return now;
}

}  // namespace

std::vector<GivenValue> without_retired_keys(std::vector<GivenValue> given,
                                             const std::vector<Key>& table) {
  std::vector<GivenValue> kept;
  for (GivenValue& value : given) {
    const RetiredKey* key = find_key(table, value.name) ? nullptr : find_retired(value.name);
    if (key && is_ignored(*key, value.value)) continue;
    const std::string now = key ? name_now(*key, value.name) : "";
    if (find_key(table, now)) {
      const auto other = std::ranges::find(given, now, &GivenValue::name);
      if (other == given.end())
        value.name = now;
      else if (toml_text(other->value) == toml_text(value.value))
        continue;
    }
    kept.push_back(value);
  }
  return kept;
}

std::string instead_of_retired(const std::string& name) {
  const RetiredKey* key = find_retired(name);
  if (!key) return "";
  if (!key->instead.empty()) return key->instead;
  return key->now.empty() ? "expected none, or a number, which changes nothing"
                          : "expected " + key->now + " in its place";
}

}  // namespace gnomon
