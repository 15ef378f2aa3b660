#include "scene/retired_keys.hpp"

#include <algorithm>

#include "scene/chosen_name.hpp"
#include "scene/key_check.hpp"
#include "scene/toml_text.hpp"

namespace gnomon {

namespace {

template <class T>
const T* scalar(const RawValue* value) {
  const auto* content = value ? std::get_if<RawScalar>(&value->content) : nullptr;
  return content ? std::get_if<T>(content) : nullptr;
}

std::string text_of(const RawValue* value) {
  const auto* text = scalar<std::string>(value);
  return text ? *text : "";
}

RawValue raw(const char* text) {
  return {RawScalar(std::string(text))};
}

const Translated refused{.accepted = false};

/// Third component of a velocity in the plane.
Translated with_third_component(const RawValue& value, const RawValue* velocity) {
  RawArray components = {0.0, 0.0};
  if (velocity) {
    const auto* array = std::get_if<RawArray>(&velocity->content);
    if (!array || array->size() < 2) return refused;
    components = *array;
    components.resize(2);
  }
  if (!scalar<double>(&value) && !scalar<long>(&value)) return refused;
  components.push_back(std::get<RawScalar>(value.content));
  return {.value = RawValue{components}};
}

bool is_side_of_open_curve(const std::string& side) {
  return side == "left" || side == "right";
}

Translated side_of_concave(const RawValue& value, const RawValue* beside) {
  const auto* concave = scalar<bool>(&value);
  const std::string side = text_of(beside);
  if (!concave || (*concave && is_side_of_open_curve(side))) return refused;
  if (*concave) return {.value = raw("outside")};
  if (side == "outside") return {.value = raw("inside")};
  return {};
}

Translated side_of_closed(const RawValue& value, const RawValue* beside) {
  const auto* closed = scalar<bool>(&value);
  const std::string side = text_of(beside);
  if (!closed || (!side.empty() && *closed == is_side_of_open_curve(side))) return refused;
  if (*closed && side.empty()) return {.value = raw("inside")};
  return {};
}

Translated material_of_kinematics(const RawValue& value, const RawValue* material) {
  const std::string kinematics = text_of(&value);
  if (kinematics == "small") return {.value = raw("linear")};
  if (kinematics != "finite") return refused;
  if (text_of(material) == "linear") return {.value = raw("neo-hookean")};
  return {};
}

std::vector<RetiredKey> make_keys() {
  const std::string linear =
      "expected body.material = \"linear\", which has small strains, in its place";
  const std::string side = "expected counter_body.side in its place: ";
  return {
      {.name = "output.last",
       .accepted = {true},
       .instead = "expected none: the end of a run is always stored"},
      {.name = "output.checkpoints"},  // it is in every earlier result
      {.name = "shape.augmentation"},  // it changes no solution
      {.name = "shape.young_modulus"},
      {.name = "mesh.geometry", .now = "mesh.file"},
      {.name = "body.plane", .now = "model.plane"},
      {.name = "body.kinematics",
       .now = "body.material",
       .translate = material_of_kinematics,
       .instead = linear},
      {.name = "body.#.kinematics",
       .now = "body.#.material",
       .translate = material_of_kinematics,
       .instead = linear},
      {.name = "wear.tables.*.x", .now = "tables.*.x"},
      {.name = "wear.tables.*.y", .now = "tables.*.y"},
      {.name = "cycle.tables.*.x", .now = "tables.*.x"},
      {.name = "cycle.tables.*.y", .now = "tables.*.y"},
      {.name = "counter_body.apex", .now = "counter_body.center"},
      {.name = "counter_body.point", .now = "counter_body.center"},
      {.name = "counter_body.minor_radius", .now = "counter_body.radius"},
      {.name = "counter_body.file", .now = "counter_body.points"},
      {.name = "counter_body.closed",
       .now = "counter_body.side",
       .translate = side_of_closed,
       .instead = side + "\"inside\" or \"outside\" of a closed curve, \"left\" or \"right\" of an "
                         "open one"},
      {.name = "counter_body.concave",
       .now = "counter_body.side",
       .translate = side_of_concave,
       .instead = side + "\"outside\" of the shape, or \"inside\""},
      {.name = "counter_body.motion.out_of_plane",
       .now = "counter_body.motion.velocity",
       .translate = with_third_component,
       .instead = "expected counter_body.motion.velocity with a third number in its place"},
  };
}

/// The name of the key that has the place of a retired one of this name.
std::string name_now(const RetiredKey& key, const std::string& name) {
  std::string now = key.now;
  if (const auto chosen = chosen_name(key.name, name))
    now.replace(now.find_first_of("*#"), 1, *chosen);
  return now;
}

GivenValue* find(std::vector<GivenValue>& given, const std::string& name) {
  const auto found = std::ranges::find(given, name, &GivenValue::name);
  return found == given.end() ? nullptr : &*found;
}

const RawValue* value_in(const std::vector<GivenValue>& given, const std::string& name) {
  const auto found = std::ranges::find(given, name, &GivenValue::name);
  return found == given.end() ? nullptr : &found->value;
}

bool is_accepted(const RetiredKey& key, const RawValue& value) {
  return key.accepted.empty() || std::ranges::any_of(key.accepted, [&](const SceneValue& accepted) {
           return toml_text(accepted) == toml_text(value);
         });
}

}  // namespace

const RetiredKey* find_retired(const std::string& name) {
  static const std::vector<RetiredKey> keys = make_keys();
  for (const RetiredKey& key : keys)
    if (key.name == name || chosen_name(key.name, name)) return &key;
  return nullptr;
}

std::string instead_of(const RetiredKey& key) {
  if (!key.instead.empty()) return key.instead;
  return key.now.empty() ? "expected none" : "expected " + key.now + " in its place";
}

namespace {

/// Gives the value to the key that has the place of the retired one; false where it cannot.
bool translate(const GivenValue& value, const RetiredKey& key, std::vector<GivenValue>& result,
               const std::vector<GivenValue>& below, const std::vector<GivenValue>& above) {
  const std::string now = name_now(key, value.name);
  GivenValue* const beside = find(result, now);
  if (!key.translate) {
    if (beside) return toml_text(beside->value) == toml_text(value.value);
    result.push_back({now, value.origin, value.value});
    return true;
  }
  const Translated translated =
      key.translate(value.value, beside ? &beside->value : value_in(below, now));
  if (!translated.accepted || !translated.value) return translated.accepted;
  if (value_in(above, now)) return false;  // it would be lost there
  if (beside)
    beside->value = *translated.value;
  else
    result.push_back({now, value.origin, *translated.value});
  return true;
}

}  // namespace

std::vector<GivenValue> without_retired_keys(const std::vector<GivenValue>& given,
                                             const std::vector<GivenValue>& below,
                                             const std::vector<GivenValue>& above,
                                             const std::vector<Key>& table, Mistakes& mistakes) {
  std::vector<GivenValue> result;
  std::vector<std::pair<const GivenValue*, const RetiredKey*>> retired;
  for (const GivenValue& value : given) {
    const RetiredKey* key = find_key(table, value.name) ? nullptr : find_retired(value.name);
    if (key && (key->now.empty() || find_key(table, name_now(*key, value.name))))
      retired.emplace_back(&value, key);
    else
      result.push_back(value);
  }
  for (const auto& [value, key] : retired) {
    const bool done = key->now.empty() ? is_accepted(*key, value->value)
                                       : translate(*value, *key, result, below, above);
    if (!done) mistakes.add(value->origin + ": " + instead_of(*key));
  }
  return result;
}

}  // namespace gnomon
