// The key table of a counter-body: that of every registered shape, motion and press.

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/shapes/counter_body_scene.hpp>

namespace gnomon {

namespace {

Key vector_key(const std::string& name, std::size_t length, const std::string& unit,
               const std::string& absent, const std::string& help) {
  return {.name = name,
          .kind = KeyKind::reals,
          .unit = unit,
          .absent_meaning = absent,
          .length = length,
          .help = help};
}

Key real_key(const std::string& name, const std::string& unit, const std::string& absent,
             const std::string& help) {
  return {.name = name,
          .unit = unit,
          .absent_meaning = absent,
          .range = {.min = -1e30, .max = 1e30},
          .help = help};
}

std::vector<Key> motion_keys(std::size_t dim) {
  std::vector<Key> keys = {
      vector_key("counter_body.motion.velocity", dim == 2 ? 0 : dim, "mm/s", "none",
                 dim == 2 ? "velocity of its surface, in the plane also with a third number, out "
                            "of it; the counter-body itself stays: a steady state"
                          : "velocity of its surface; the counter-body itself stays: a steady "
                            "state"),
      real_key("counter_body.motion.rotation", "rad/s", "none",
               dim == 2 ? "rotation about motion.center, from the first direction to the second; "
                          "axisymmetric: about r = 0"
                        : "rotation about motion.axis through motion.center, right-handed"),
      vector_key("counter_body.motion.center", dim, "mm", "counter_body.center",
                 "point of the axis of rotation")};
  if (dim == 3)
    keys.push_back(vector_key("counter_body.motion.axis", dim, "", "counter_body.axis",
                              "direction of the axis of rotation, of any length"));
  return keys;
}

/// Of the table `press`, or of each of an array of them.
std::vector<Key> press_keys(const std::string& press, std::size_t dim) {
  return {
      vector_key(press + ".direction", dim, "", "needed by press.force and .approach",
                 "direction in which the counter-body is pressed, of any length; without force and "
                 "approach it is held there"),
      {.name = press + ".force",
       .unit = "N",
       .absent_meaning = "it does not move, or as press.approach says",
       .range = {.min = 0, .max = positive_quantity.max},
       .help = "force along press.direction, in 2D per mm out of the plane; axisymmetric: the "
               "whole force"},
      {.name = press + ".factors",
       .kind = KeyKind::reals,
       .absent_meaning = "press.force does not change with time",
       .range = {.max = positive_quantity.max},
       .help = "factors of press.force at press.times, 1e-6 or more: linear between them, "
               "constant before the first and after the last"},
      {.name = press + ".approach",
       .kind = KeyKind::reals,
       .unit = "mm",
       .absent_meaning = "it does not move",
       .or_single = Range{},
       .help = "how far it has moved along press.direction: one number, or numbers at press.times, "
               "straight between them"},
      {.name = press + ".times",
       .kind = KeyKind::reals,
       .unit = "s",
       .absent_meaning = "one force, or one approach, at all times",
       .range = {.min = 0},
       .help =
           "ascending times of press.factors or press.approach, one twice for a jump; steps end on "
           "them exactly"}};
}

/// An entry of [[counter_body.press]] may be a moment instead.
std::vector<Key> entry_keys(std::size_t dim) {
  const std::string press = "counter_body.press.#";
  std::vector<Key> keys = press_keys(press, dim);
  keys.push_back(real_key(press + ".moment", "N mm", "a direction",
                          "instead of direction and force: it turns freely under this moment, in "
                          "2D per mm, from the first direction to the second"));
  keys.push_back(vector_key(press + ".center", dim, "mm", "counter_body.center",
                            "point of the axis of the moment"));
  if (dim == 3)
    keys.push_back(vector_key(press + ".axis", dim, "", "counter_body.axis",
                              "direction of the axis of the moment, of any length"));
  return keys;
}

/// Adds a key of a shape, or the name of the shape to the help of one that is there.
void add_shape_key(std::vector<Key>& keys, std::vector<std::vector<std::string>>& owners,
                   const Key& key, const std::string& shape) {
  const auto there = std::find_if(keys.begin(), keys.end(),
                                  [&](const Key& other) { return other.name == key.name; });
  owners.resize(std::max(owners.size(), keys.size()));
  if (there != keys.end()) {
    owners[static_cast<std::size_t>(there - keys.begin())].push_back(shape);
    if (there->help.find(key.help) == std::string::npos) there->help += "; " + key.help;
    return;
  }
  keys.push_back(key);
  keys.back().default_value.reset();
  owners.push_back({shape});
}

}  // namespace

template <int dim>
std::vector<Key> counter_body_keys() {
  std::vector<Key> keys;
  std::vector<std::vector<std::string>> owners;
  for (const auto& kind : Registry<CounterShapeKind<dim>>::all())
    for (const Key& key : kind.keys) add_shape_key(keys, owners, key, kind.name);
  for (std::size_t k = 0; k < keys.size(); ++k)
    keys[k].absent_meaning = "by the shape; of " + fmt::format("{}", fmt::join(owners[k], ", "));
  keys.insert(keys.begin(), {.name = "counter_body.shape",
                             .kind = KeyKind::text,
                             .choices = Registry<CounterShapeKind<dim>>::names(),
                             .help = "shape of the rigid counter-body"});
  for (const auto& part :
       {motion_keys(dim), press_keys("counter_body.press", dim), entry_keys(dim)})
    keys.insert(keys.end(), part.begin(), part.end());
  return keys;
}

std::vector<Key> counter_body_keys() {
  std::vector<Key> keys = counter_body_keys<2>();
  for (const Key& key : counter_body_keys<3>()) {
    const auto there = std::find_if(keys.begin(), keys.end(),
                                    [&](const Key& other) { return other.name == key.name; });
    if (there == keys.end()) {
      keys.push_back(key);
      continue;
    }
    if (there->length != key.length) there->length = 0;
    for (const std::string& shape : key.choices)
      if (std::find(there->choices.begin(), there->choices.end(), shape) == there->choices.end())
        there->choices.push_back(shape);
  }
  return keys;
}

template std::vector<Key> counter_body_keys<2>();
template std::vector<Key> counter_body_keys<3>();

}  // namespace gnomon
