#include "part/body_motions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <gnomon/base/error.hpp>
#include <gnomon/cycles/cycle_scene.hpp>
#include <gnomon/scene/keys.hpp>
#include <gnomon/shapes/shape_keys.hpp>

#include "model/connected_parts.hpp"
#include "part/histories.hpp"
#include "part/part_cycle.hpp"

namespace gnomon::part {

std::vector<Key> motion_keys_of_bodies() {
  return {text_key("motion.#.body", absent("needed in every [[motion]]"),
                   "body of a [[pair]] whose material moves, while its shape stays where it is"),
          reals_key("motion.#.velocity", "mm/s", absent("none"), {},
                    "its velocity, in the plane also with a third number, out of it"),
          real_key("motion.#.rotation", "rad/s", absent("none"), any_quantity,
                   "its rotation about motion.#.center, from the first direction to the second; "
                   "where bodies roll, without a velocity, that about the axle; "
                   "axisymmetric: about r = 0; in space: about motion.#.axis, right-handed"),
          reals_key("motion.#.center", "mm", absent("no rotation"), {},
                    "point of the axis of rotation"),
          reals_key("motion.#.axis", "", absent("no rotation in space"), {},
                    "in space: direction of the axis of rotation, of any length"),
          real_key("motion.#.force", "N, in the plane N/mm", absent("the velocity is given"),
                   any_quantity,
                   "where bodies roll: on the body along its velocity, which it determines; above "
                   "zero it drives, zero rolls freely (docs/rolling.md)"),
          real_key("motion.#.force_across", "N", absent("the velocity is given"), any_quantity,
                   "in space: the same along the axis across the velocity"),
          real_key("motion.#.moment", "N mm", absent("none"), any_quantity,
                   "in space, where bodies roll: on the body about motion.#.axis, the normal of "
                   "the contact, in place of its rotation, which it determines"),
          cycle_function_key(
              "motion.#.cycle.x", "mm",
              std::string("displacement of the body along x over a cycle") + cycle_function_form),
          cycle_function_key("motion.#.cycle.y", "mm", "along y"),
          cycle_function_key("motion.#.cycle.z", "mm",
                             "along z; in plane strain out of the plane, axisymmetric along the "
                             "axis"),
          cycle_function_key("motion.#.cycle.rotation", "rad",
                             "angle by which the body has turned about motion.#.center (in space "
                             "about .axis)")};
}

namespace {

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

/// The spin of the rate one about the axis of a motion, and a point of the axis.
template <int dim>
CycleAxis<dim> read_axis(const Scene& scene, const std::string& table, const std::string& rotation,
                         Section section) {
  const std::string center = table + ".center", axis = table + ".axis";
  if (dim == 2 && scene.given(axis)) refuse(scene, axis, "none in the plane");
  CycleAxis<dim> result;
  if (section == Section::meridian) {
    if (scene.given(center)) refuse(scene, center, "none: an axisymmetric body turns about r = 0");
    result.meridian = true;
    return result;
  }
  if (!scene.given(center)) refuse(scene, rotation, "also " + center + ", a point of the axis");
  result.centre = read_point<dim>(scene, center);
  if constexpr (dim == 2) {
    result.spin = spin_in_plane(1);
  } else {
    if (!scene.given(axis)) refuse(scene, rotation, "also " + axis + ", the direction of the axis");
    result.spin = spin_about(read_direction<3>(scene, axis), 1);
  }
  return result;
}

template <int dim>
RigidMotion<dim> read_steady_motion(const Scene& scene, const std::string& table, Section section) {
  const std::string velocity = table + ".velocity", rotation = table + ".rotation";
  RigidMotion<dim> motion = read_velocity<dim>(scene, velocity);
  if (section == Section::meridian && motion.velocity[0] != 0)
    refuse(scene, velocity, "none along r: an axisymmetric body would widen");
  const double rate = scene.given(rotation) ? scene.real(rotation) : 0;
  if (rate == 0) return motion;
  const CycleAxis<dim> axis = read_axis<dim>(scene, table, rotation, section);
  if (axis.meridian) {
    motion.across_by_x[0] = rate;
    return motion;
  }
  const double across = motion.across;
  motion = rigid_motion<dim>(motion.velocity, Tensor<dim>(rate * axis.spin), axis.centre);
  motion.across = across;
  return motion;
}

template <int dim>
BodyCycle<dim> read_motion(const Scene& scene, const std::string& table, Section section) {
  BodyCycle<dim> body{.motion = read_steady_motion<dim>(scene, table, section)};
  const std::string cycle = table + ".cycle.", rotation = cycle + "rotation";
  body.cycle.displacement = {read_cycle_function(scene, cycle + "x"),
                             read_cycle_function(scene, cycle + "y"),
                             read_cycle_function(scene, cycle + "z")};
  body.cycle.rotation = read_cycle_function(scene, rotation);
  if (body.cycle.rotation) body.axis = read_axis<dim>(scene, table, rotation, section);
  if (section == Section::meridian) put_in_meridian(scene, cycle, body.cycle);
  if (!body.moves() && !scene.given(table + ".velocity") && !scene.given(table + ".rotation"))
    throw InputError(fmt::format("{}: [[motion]]: expected {}.velocity, .rotation or .cycle{}",
                                 scene.path().string(), table,
                                 scene.given(table + ".force") ? " beside the force" : ""));
  return body;
}

bool has_cycle(const Scene& scene, const std::string& table) {
  return std::ranges::any_of(std::array{"x", "y", "z", "rotation"}, [&](const char* function) {
    return scene.given(table + ".cycle." + function);
  });
}

/// By name of a body its [[motion]]; of one without, that of a body which is bonded to it.
template <int dim>
std::map<std::string, std::string> tables_of(const Scene& scene, const AssemblyParts<dim>& parts) {
  std::map<std::string, std::string> tables;
  for (const std::string& table : entries_of(scene, "motion", motion_keys_of_bodies(), {"body"}))
    if (const std::string key = table + ".body"; !tables.emplace(scene.text(key), table).second)
      refuse(scene, key,
             fmt::format("one [[motion]] for each body, got two for \"{}\"", scene.text(key)));
  const std::map<std::string, std::string> given = tables;
  const std::vector<int> part = connected_parts(parts.mesh, parts.bodies);
  for (std::size_t b = 0; b < part.size(); ++b)
    for (std::size_t other = 0; other < part.size(); ++other) {
      const auto found = given.find(parts.bodies[other].name);
      if (part[other] != part[b] || found == given.end()) continue;
      const auto& [own, table] = *tables.emplace(parts.bodies[b].name, found->second).first;
      if (table != found->second && has_cycle(scene, table))
        refuse(scene, found->second + ".body",
               fmt::format("one [[motion]] with a cycle for bodies that are bonded: \"{}\" goes "
                           "where \"{}\" does",
                           found->first, own));
    }
  return tables;
}

}  // namespace

template <int dim>
std::map<std::string, BodyCycle<dim>> read_motions_of_bodies(const Scene& scene,
                                                             const AssemblyParts<dim>& parts) {
  std::map<std::string, BodyCycle<dim>> motions;
  for (const auto& [body, table] : tables_of(scene, parts)) {
    BodyCycle<dim> motion = read_motion<dim>(scene, table, parts.section());
    motion.name = scene.text(table + ".body");
    motions.emplace(body, std::move(motion));
  }
  return motions;
}

template <int dim>
RollingBody<dim> read_rolling_body(const Scene& scene, const AssemblyParts<dim>& parts,
                                   const std::string& body) {
  const auto tables = tables_of(scene, parts);
  const auto found = tables.find(body);
  if (found == tables.end()) return {};
  const std::string& table = found->second;
  const RigidMotion<dim> along = read_velocity<dim>(scene, table + ".velocity");
  if (along.across != 0) refuse(scene, table + ".velocity", "two numbers where bodies roll");
  RollingBody<dim> result{.velocity = along.velocity, .table = table};
  for (std::size_t k = 0; k < 2; ++k)
    if (const std::string key = table + (k == 0 ? ".force" : ".force_across"); scene.given(key))
      result.force[k] = scene.real(key);
  const std::string rotation = table + ".rotation", moment = table + ".moment";
  const bool turns = scene.given(rotation) && scene.real(rotation) != 0, acts = scene.given(moment);
  if (!turns && !acts) return result;
  const std::string& key = acts ? moment : rotation;
  if (turns && acts) refuse(scene, key, "either a rotation or a moment, which determines it");
  result.on_axle = turns && !scene.given(table + ".velocity");
  if (dim == 2 && acts)
    refuse(scene, key, "none in the plane: a moment about the axle is a force along the contact");
  if (dim == 2 && !result.on_axle)
    refuse(scene, key,
           "either a rotation about the axle or the velocity of the material where it touches");
  const CycleAxis<dim> axis = read_axis<dim>(scene, table, key, Section::plane);
  result.centre = axis.centre;
  if (turns) result.spin = scene.real(rotation) * axis.spin;
  if (!acts) return result;
  result.moment = scene.real(moment);
  result.turn = axis.spin;
  return result;
}

template RollingBody<2> read_rolling_body(const Scene&, const AssemblyParts<2>&,
                                          const std::string&);
template RollingBody<3> read_rolling_body(const Scene&, const AssemblyParts<3>&,
                                          const std::string&);
template std::map<std::string, BodyCycle<2>> read_motions_of_bodies(const Scene&,
                                                                    const AssemblyParts<2>&);
template std::map<std::string, BodyCycle<3>> read_motions_of_bodies(const Scene&,
                                                                    const AssemblyParts<3>&);

}  // namespace gnomon::part
