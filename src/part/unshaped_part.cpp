#include "part/unshaped_part.hpp"

#include <gnomon/base/error.hpp>
#include <gnomon/model/wear_scene.hpp>
#include <gnomon/part/assembly_scene.hpp>
#include <gnomon/shapes/counter_body_scene.hpp>

#include "part/bodies.hpp"
#include "part/changing_friction.hpp"
#include "part/first_loading.hpp"
#include "part/groups.hpp"
#include "part/histories.hpp"
#include "part/loads.hpp"
#include "part/nominal_speed.hpp"
#include "part/pair_keys.hpp"
#include "part/pairs.hpp"
#include "part/rolling_scene.hpp"
#include "part/stick_path.hpp"
#include "part/stored_part.hpp"
#include "part/supports.hpp"
#include "part/surfaces.hpp"
#include "part/tracks.hpp"

namespace gnomon::part {

namespace {

/// The mean over the contact surface, unit; zero where it is closed.
template <int dim>
Vector<dim> outward_normal(const std::vector<ContactPatch<dim>>& patches) {
  Vector<dim> sum = Vector<dim>::Zero();
  for (const auto& patch : patches) sum += patch.initial_area * patch.initial_normal;
  return sum.isZero(0) ? sum : sum.normalized();
}

/// The counter-body and what presses it. Where the scene gives no direction, it is met along the
/// mean normal of the contact surface.
template <int dim>
CounterBody<dim> read_partner(const Scene& scene, Section section,
                              const std::vector<ContactPatch<dim>>& patches) {
  std::vector<Vector<dim>> normals;  // where friction holds what does not press
  if (may_stick(scene) && !rolls(scene))
    for (const auto& patch : patches) normals.push_back(patch.initial_area * patch.initial_normal);
  CounterBody<dim> other = read_counter_body<dim>(scene, section, normals);
  const Vector<dim> outward = outward_normal(patches);
  if (outward.isZero(0)) return other;
  if (rolls(scene)) let_creep<dim>(scene, outward, other);
  if (other.guides.empty()) other.approach = -outward;
  return other;
}

/// What the interface needs to know of the motion: the partner with its place of first touch, its
/// force, and the phases of its cycle.
template <int dim>
struct Motion {
  CounterBody<dim> partner;
  std::optional<Rolling<dim>> rolling{};
  std::optional<double> force{};
  LoadHistory history{};
  double speed = 1;
  std::optional<ReadPhases<dim>> phases{};
};

/// Without contact nodes, after a mistake, the speed is not known.
template <int dim>
Motion<dim> read_motion(const Scene& scene, Section section,
                        const std::vector<ContactPatch<dim>>& patches) {
  CounterBody<dim> other = read_partner(scene, section, patches);
  Motion<dim> motion{.partner = other};
  if (!other.guides.empty()) motion.force = other.guides.front().force;
  const std::optional<CyclicMotion<dim>> cycle = read_part_cycle(scene, other);
  if (cycle && cycle->cycle.force) {
    motion.force = largest_force(cycle->cycle);
    other.guide(), motion.partner = other;
  }
  if (motion.force) {  // a guide of cycle.force alone has no key of its own
    const std::string& key = other.guides.front().key;
    motion.history = read_load_history(scene, key.empty() ? "counter_body.press" : key);
  }
  if (patches.empty()) return motion;
  const Meeting<dim> meeting = find_meeting(scene, patches, other, cycle);
  motion.partner = meeting.partner;
  motion.speed = meeting.speed;
  motion.rolling = read_rolling<dim>(scene, outward_normal(patches), motion.partner);
  if (cycle && motion.rolling) refuse(scene, "rolling.velocity", "no [cycle] beside it");
  if (cycle)
    motion.phases = may_stick(scene) ? read_path(scene, *cycle, motion.partner, motion.force)
                                     : read_phases(scene, *cycle, motion.partner, motion.force);
  return motion;
}

/// A part meets a rigid counter-body, or its bodies meet each other.
void require_partner(const Scene& scene) {
  if (!has_pairs(scene)) {
    if (!scene.given("counter_body.shape"))
      throw InputError(
          scene.path().string() +
          ": missing key `counter_body.shape`, or [[pair]] where bodies meet each other");
    return;
  }
  for (const Key& key : counter_body_keys())
    if (scene.given(key.name)) refuse(scene, key.name, "none beside [[pair]]");
  if (!has_bodies(scene))
    throw InputError(scene.path().string() + ": [[pair]]: expected also a [[body]] for each body");
  if (scene.real("contact.initial_gap") != 0)
    refuse(scene, "contact.initial_gap",
           "none beside [[pair]]: the meshes say where the bodies are");
}

}  // namespace

template <int dim>
AssemblyParts<dim> read_unshaped_part(const Scene& scene, const ImportedBody<dim>& part) {
  const Section section = dim == 2 ? section_of(scene) : Section::plane;
  Mistakes mistakes;
  find_unknown_groups(scene, part, mistakes);
  find_conflicts(scene, mistakes);
  std::vector<Surface<dim>> surfaces;
  std::vector<ContactPatch<dim>> patches;
  const bool pairs = has_pairs(scene);
  mistakes.collect([&] {
    if (dim == 3 && section_of(scene) == Section::meridian)
      refuse(scene, "model.plane", "a mesh in the plane, of r and z; this one is in space");
  });
  mistakes.collect([&] { require_partner(scene); });
  const bool wears = !pairs && mistakes.collect([&] {
    surfaces = wearing_surfaces(scene, part);
    patches = contact_patches<dim>(part.mesh, facets_of(surfaces), part.exterior, section);
  });
  Motion<dim> motion{};
  Supports<dim> supports{};
  std::vector<Body> bodies;
  std::vector<Load<dim>> loads, swinging_loads;
  if (!pairs) mistakes.collect([&] { motion = read_motion(scene, section, patches); });
  mistakes.collect([&] { supports = read_supports(scene, part); });
  mistakes.collect([&] {
    bodies = read_bodies(scene, part, section);
    loads = read_loads(scene, part, bodies);
    swinging_loads = read_swinging_loads(scene, part, bodies);
  });
  if (wears) mistakes.collect([&] { require_free_contact(scene, part); });
  if (wears)
    mistakes.collect([&] {
      require_surface_names(scene);
      for (Surface<dim>& surface : surfaces) {
        surface.wear = read_surface_law(scene, surface.name, motion.speed);
        if (!rolls(scene)) refuse_track(scene, surface.name);
      }
    });
  mistakes.require_none();
  AssemblyParts<dim> parts{.mesh = part.mesh,
                           .bodies = std::move(bodies),
                           .supports = std::move(supports),
                           .loads = std::move(loads),
                           .swinging_loads = std::move(swinging_loads),
                           .interface = {.surfaces = std::move(surfaces),
                                         .boundary = part.exterior,
                                         .partner = motion.partner,
                                         .force = motion.force,
                                         .history = motion.history,
                                         .normal_rule = read_normal_rule(scene),
                                         .sticks = may_stick(scene) && !motion.rolling,
                                         .friction = scene.real("friction.coefficient"),
                                         .rolling = motion.rolling,
                                         .speed = motion.speed},
                           .shape = read_shape_motion<dim>(scene, {}),
                           .remarks = part.remarks,
                           .named_parts = stored_parts(part)};
  if (pairs) {
    read_pairs(scene, part, parts);
    require_free_contact(scene, part);
    require_surface_names(scene);
    for (Surface<dim>& surface : parts.interface.surfaces)
      if (surface.wears) {
        surface.wear = read_surface_law(scene, surface.name, parts.nominal_speed(surface));
        surface.track = read_track(scene, surface, parts);
      }
  }
  if (motion.rolling) parts.interface.rolling->linear = has_small_strains(parts.bodies);
  for (Surface<dim>& surface : parts.interface.surfaces)
    if (motion.rolling) surface.track = read_track(scene, surface, parts);
  parts.interface.friction_factor = read_friction_factor(scene, parts);
  parts.interface.loading = read_first_loading(scene, parts.interface.sticks);
  if (!motion.phases) return parts;
  parts.cycle = motion.phases->contact;
  parts.phases = motion.phases->phases;
  parts.remarks.insert(parts.remarks.end(), motion.phases->remarks.begin(),
                       motion.phases->remarks.end());
  return parts;
}

template AssemblyParts<2> read_unshaped_part(const Scene&, const ImportedBody<2>&);
template AssemblyParts<3> read_unshaped_part(const Scene&, const ImportedBody<3>&);

}  // namespace gnomon::part
