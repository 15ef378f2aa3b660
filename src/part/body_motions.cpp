#include "part/body_motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <gnomon/base/error.hpp>
#include <gnomon/scene/keys.hpp>
#include <gnomon/shapes/shape_keys.hpp>

#include "part/histories.hpp"

namespace gnomon::part {

std::vector<Key> motion_keys_of_bodies() {
  return {text_key("motion.#.body", absent("needed in every [[motion]]"),
                   "body of a [[pair]] whose material moves, while its shape stays where it is"),
          reals_key("motion.#.velocity", "mm/s", absent("none"), {},
                    "its velocity, in the plane also with a third number, out of it"),
          real_key("motion.#.rotation", "rad/s", absent("none"), any_quantity,
                   "its rotation about motion.#.center, from the first direction to the second; "
                   "axisymmetric: about r = 0; in space: about motion.#.axis, right-handed"),
          reals_key("motion.#.center", "mm", absent("no rotation"), {},
                    "point of the axis of rotation"),
          reals_key("motion.#.axis", "", absent("no rotation in space"), {},
                    "in space: direction of the axis of rotation, of any length")};
}

namespace {

void refuse(const Scene& scene, const std::string& key, const std::string& expected) {
  throw InputError(scene.where(key) + ": expected " + expected);
}

template <int dim>
RigidMotion<dim> read_velocity(const Scene& scene, const std::string& key) {
  RigidMotion<dim> motion;
  if (!scene.given(key)) return motion;
  const std::vector<double>& components = scene.reals(key);
  if (dim == 2 && components.size() == 3) {
    motion.velocity = Eigen::Map<const Vector<dim>>(components.data());
    motion.across = components[2];
  } else {
    motion.velocity = read_point<dim>(scene, key);
  }
  return motion;
}

template <int dim>
RigidMotion<dim> read_motion(const Scene& scene, const std::string& table, Section section) {
  const std::string velocity = table + ".velocity", rotation = table + ".rotation",
                    center = table + ".center", axis = table + ".axis";
  if (!scene.given(velocity) && !scene.given(rotation))
    throw InputError(fmt::format("{}: [[motion]]: expected {} or {}", scene.path().string(),
                                 velocity, rotation));
  RigidMotion<dim> motion = read_velocity<dim>(scene, velocity);
  const double rate = scene.given(rotation) ? scene.real(rotation) : 0;
  if (dim == 2 && scene.given(axis)) refuse(scene, axis, "none in the plane");
  if constexpr (dim == 2)
    if (section == Section::meridian) {
      if (motion.velocity[0] != 0)
        refuse(scene, velocity, "none along r: an axisymmetric body would widen");
      if (scene.given(center))
        refuse(scene, center, "none: an axisymmetric body turns about r = 0");
      motion.across_by_x[0] = rate;
      return motion;
    }
  if (rate == 0) return motion;
  if (!scene.given(center)) refuse(scene, rotation, "also " + center + ", a point of the axis");
  Tensor<dim> spin;
  if constexpr (dim == 2) {
    spin = spin_in_plane(rate);
  } else {
    if (!scene.given(axis)) refuse(scene, rotation, "also " + axis + ", the direction of the axis");
    spin = spin_about(read_direction<3>(scene, axis), rate);
  }
  const double across = motion.across;
  motion = rigid_motion<dim>(motion.velocity, spin, read_point<dim>(scene, center));
  motion.across = across;
  return motion;
}

}  // namespace

template <int dim>
std::map<std::string, RigidMotion<dim>> read_motions_of_bodies(const Scene& scene,
                                                               Section section) {
  std::map<std::string, RigidMotion<dim>> motions;
  for (const std::string& table : entries_of(scene, "motion", motion_keys_of_bodies(), {"body"})) {
    const std::string key = table + ".body", name = scene.text(key);
    if (!motions.try_emplace(name, read_motion<dim>(scene, table, section)).second)
      refuse(scene, key, fmt::format("one [[motion]] for each body, got two for \"{}\"", name));
  }
  return motions;
}

template <int dim>
RigidMotion<dim> difference_of(const std::map<std::string, RigidMotion<dim>>& motions,
                               const std::array<std::string, 2>& bodies) {
  RigidMotion<dim> result;
  for (const int side : {0, 1}) {
    const auto found = motions.find(bodies[static_cast<std::size_t>(side)]);
    if (found == motions.end()) continue;
    const double sign = side == 1 ? 1 : -1;
    result.velocity += sign * found->second.velocity;
    result.spin += sign * found->second.spin;
    result.across += sign * found->second.across;
    result.across_by_x += sign * found->second.across_by_x;
  }
  return result;
}

template std::map<std::string, RigidMotion<2>> read_motions_of_bodies(const Scene&, Section);
template std::map<std::string, RigidMotion<3>> read_motions_of_bodies(const Scene&, Section);
template RigidMotion<2> difference_of(const std::map<std::string, RigidMotion<2>>&,
                                      const std::array<std::string, 2>&);
template RigidMotion<3> difference_of(const std::map<std::string, RigidMotion<3>>&,
                                      const std::array<std::string, 2>&);

}  // namespace gnomon::part
