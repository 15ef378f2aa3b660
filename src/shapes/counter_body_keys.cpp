// The key table of a counter-body: that of every registered shape, motion and press.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <gnomon/scene/keys.hpp>
#include <gnomon/shapes/counter_body_scene.hpp>

namespace gnomon {

namespace {

std::vector<Key> motion_keys() {
  return {reals_key("counter_body.motion.velocity", "mm/s", absent("none"), {},
                    "velocity of its surface, in the plane also with a third number, out of it; "
                    "the counter-body itself stays: a steady state"),
          real_key("counter_body.motion.rotation", "rad/s", absent("none"), any_quantity,
                   "rotation about motion.center, from the first direction to the second; "
                   "axisymmetric: about r = 0; in space: about motion.axis, right-handed"),
          reals_key("counter_body.motion.center", "mm", absent("counter_body.center"), {},
                    "point of the axis of rotation"),
          reals_key("counter_body.motion.axis", "", absent("counter_body.axis"), {},
                    "in space: direction of the axis of rotation, of any length")};
}

/// Of the table `press`, or of each of an array of them.
std::vector<Key> press_keys(const std::string& press) {
  return {
      reals_key(press + ".direction", "", absent("needed by press.force and .approach"), {},
                "direction in which the counter-body is pressed, of any length; without force and "
                "approach it is held there"),
      real_key(press + ".force", "N", absent("it does not move, or as press.approach says"),
               {.min = 0, .max = positive_quantity.max},
               "force along press.direction, in 2D per mm out of the plane; axisymmetric: the "
               "whole force"),
      reals_key(press + ".factors", "", absent("press.force does not change with time"),
                {.max = positive_quantity.max},
                "factors of press.force at press.times, 1e-6 or more: linear between them, "
                "constant before the first and after the last"),
      {.name = press + ".cycle",
       .kind = KeyKind::text,
       .absent_meaning = "press.force does not change over the cycle",
       .help = "factor of press.force, or of press.moment, over the cycle: an expression in tau, "
               "or a file of points "
               "(.csv); a tangential force that drives fretting, for example (friction.stick)"},
      {.name = press + ".approach",
       .kind = KeyKind::reals,
       .unit = "mm",
       .absent_meaning = "it does not move",
       .or_single = Range{},
       .help = "how far it has moved along press.direction: one number, or numbers at press.times, "
               "straight between them"},
      reals_key(
          press + ".times", "s", absent("one force, or one approach, at all times"), non_negative,
          "ascending times of press.factors or press.approach, one twice for a jump; steps end on "
          "them exactly")};
}

/// An entry of [[counter_body.press]] may be a moment instead.
std::vector<Key> entry_keys() {
  const std::string press = "counter_body.press.#";
  std::vector<Key> keys = press_keys(press);
  keys.push_back(real_key(press + ".moment", "N mm", absent("a direction"), any_quantity,
                          "instead of direction and force: it turns freely under this moment, in "
                          "2D per mm, from the first direction to the second"));
  keys.push_back(reals_key(press + ".center", "mm", absent("counter_body.center"), {},
                           "point of the axis of the moment"));
  keys.push_back(reals_key(press + ".axis", "", absent("counter_body.axis"), {},
                           "in space: direction of the axis of the moment, of any length"));
  return keys;
}

/// Of a shape. A key that is there already is shared: it has the help of all.
void add_keys(std::vector<Key>& keys, const std::vector<Key>& of_shape, const std::string& shape) {
  for (const Key& key : of_shape) {
    Key* const there = same_key(keys, key, shape);
    if (there == nullptr) {
      keys.push_back(key);
      keys.back().default_value.reset();
    } else if (there->help.find(key.help) == std::string::npos) {
      there->help += "; " + key.help;
    }
  }
}

/// The names of the shapes that have the key.
std::vector<std::string> owners_of(const Key& key) {
  std::vector<std::string> names;
  for (const CounterShapeKind& kind : Registry<CounterShapeKind>::all())
    for (const auto* keys : {&kind.keys, &kind.keys_in_space})
      if (std::ranges::count(*keys, key.name, &Key::name) > 0) names.push_back(kind.name);
  return names;
}

}  // namespace

std::vector<Key> counter_body_keys() {
  std::vector<Key> keys;
  for (const auto of_kind : {&CounterShapeKind::keys, &CounterShapeKind::keys_in_space})
    for (const CounterShapeKind& kind : Registry<CounterShapeKind>::all())
      add_keys(keys, kind.*of_kind, kind.name);
  for (Key& key : keys)
    key.absent_meaning = fmt::format("by the shape; of {}", fmt::join(owners_of(key), ", "));
  keys.insert(keys.begin(),
              text_key("counter_body.shape", absent("bodies meet each other, by [[pair]]"),
                       "shape of the rigid counter-body", Registry<CounterShapeKind>::names()));
  for (const auto& part : {motion_keys(), press_keys("counter_body.press"), entry_keys()})
    keys.insert(keys.end(), part.begin(), part.end());
  return keys;
}

}  // namespace gnomon
