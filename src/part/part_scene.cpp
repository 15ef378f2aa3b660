#include <fmt/format.h>

#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/checks/checks.hpp>
#include <gnomon/cycles/cycle_scene.hpp>
#include <gnomon/mesh/mesh_file.hpp>
#include <gnomon/model/magnitudes.hpp>
#include <gnomon/model/wear_model.hpp>
#include <gnomon/part/assembly_scene.hpp>
#include <gnomon/part/part_scene.hpp>
#include <gnomon/shapes/counter_body_scene.hpp>

#include "model/rigid_balance.hpp"
#include "part/bodies.hpp"
#include "part/body_meshes.hpp"
#include "part/changing_friction.hpp"
#include "part/first_loading.hpp"
#include "part/graded_mesh.hpp"
#include "part/groups.hpp"
#include "part/held_bodies.hpp"
#include "part/histories.hpp"
#include "part/loads.hpp"
#include "part/nominal_speed.hpp"
#include "part/pair_cycle.hpp"
#include "part/pair_keys.hpp"
#include "part/pairs.hpp"
#include "part/phases.hpp"
#include "part/rolling_scene.hpp"
#include "part/shape_support.hpp"
#include "part/stick_path.hpp"
#include "part/stored_part.hpp"
#include "part/supports.hpp"
#include "part/surfaces.hpp"
#include "part/tracks.hpp"

namespace gnomon {

namespace {

using namespace part;

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
  CounterBody<dim> other = read_counter_body<dim>(scene, section);
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
  if (motion.force) motion.history = read_load_history(scene, other.guides.front().key);
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

/// Contact of a few nodes says little about pressures.
template <int dim>
void warn_of_coarse_contact(const Magnitudes& magnitudes, std::vector<std::string>& remarks) {
  const double width = dim == 2 ? magnitudes.contact_nodes : std::sqrt(magnitudes.contact_nodes);
  if (width < 4)
    remarks.push_back(
        fmt::format("contact is about {:.0f} {} wide at the start: pressures there mean little "
                    "before it has grown; a finer mesh near the contact helps",
                    std::max(1.0, width), width < 1.5 ? "node" : "nodes"));
}

/// Where bodies of pairs would be pressed so deep into each other that a unit may be wrong; or
/// nothing.
std::string doubt_about_units(const Magnitudes& magnitudes, bool pairs) {
  constexpr double most = 0.1;
  if (!pairs || magnitudes.strain <= most) return {};
  return fmt::format(
      "the loads press the bodies into each other by about {:.3g} mm, and their elements there are "
      "{:.3g} mm: the mean pressure is {:.2g} times the modulus; are moduli given in MPa, and "
      "loads "
      "in N?",
      magnitudes.scales.displacement, magnitudes.facet, magnitudes.strain);
}

/// Throws where nothing presses the bodies on each other.
template <int dim>
Magnitudes find_magnitudes(const Scene& scene, const AssemblyParts<dim>& parts) try {
  const double duration = scene.real("time.end");
  const Pressing press = pressing_of(parts, duration);
  if (press.force == 0 && press.overlap == 0)
    throw InputError(fmt::format(
        "{}: expected something that presses the bodies on each other: {}a [[load]] "
        "against the {}, or a [[support]] with value",
        scene.path().string(), parts.pairs.empty() ? "counter_body.press.force or .approach, " : "",
        parts.pairs.empty() ? "counter-body" : "other body"));
  return magnitudes_of(parts, duration);
} catch (const RecoverableError& error) {
  throw unsound_law(scene, error);
}

void append(std::vector<std::string>& remarks, const std::vector<std::string>& more) {
  remarks.insert(remarks.end(), more.begin(), more.end());
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

/// All parts but the scales and where the shape is held, or all mistakes in them.
template <int dim>
AssemblyParts<dim> read_all_but_shape(const Scene& scene, const ImportedBody<dim>& part) {
  const Section section = dim == 2 ? section_of(scene) : Section::plane;
  Mistakes mistakes;
  find_unknown_groups(scene, part, mistakes);
  find_conflicts(scene, mistakes);
  std::vector<Surface<dim>> surfaces;
  std::vector<ContactPatch<dim>> patches;
  const bool pairs = has_pairs(scene);
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
        surface.wear = read_surface_law(scene, surface.name, *parts.interface.speed);
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
  append(parts.remarks, motion.phases->remarks);
  return parts;
}

/// Once more, with the final speed: sliding distances count by it.
template <int dim>
void read_laws_again(const Scene& scene, AssemblyParts<dim>& parts) {
  for (Surface<dim>& surface : parts.interface.surfaces)
    if (surface.wears) surface.wear = read_surface_law(scene, surface.name, *parts.interface.speed);
  parts.interface.friction_factor = read_friction_factor(scene, parts);
}

/// Contact belongs to all boundary that the counter-body can reach; wear.on says what wears.
template <int dim>
void join_reachable_boundary(const Magnitudes& magnitudes, AssemblyParts<dim>& parts) {
  // What is met later joins in an epoch of its own.
  const double depth = 1.5 * (magnitudes.deepest + magnitudes.scales.displacement);
  parts.interface.reach = depth;
  Surface<dim> others = reachable_boundary(parts, depth);
  if (others.facets.empty()) return;
  parts.remarks.push_back(fmt::format(
      "{} facets that are not in wear.on are in reach of the counter-body: they may touch it, and "
      "do not wear",
      others.facets.size()));
  parts.interface.surfaces.push_back(std::move(others));
}

/// Where wear as a gap keeps the worn shape to about 1e-3, and where not (docs/gap.md).
template <int dim>
void judge_gap(const Magnitudes& expected, AssemblyParts<dim>& parts) {
  constexpr double most_slope = 0.5, most_thinning = 0.06;
  const bool does = expected.slope <= most_slope && expected.thinning <= most_thinning;
  const std::string extent = fmt::format(
      "the worn surface is expected to have a slope of about {:.2g}, and a depth of {:.2g} of the "
      "body's size",
      expected.slope, expected.thinning);
  const bool small = has_small_strains(parts.bodies);
  if (parts.shape.gap && !does)
    parts.remarks.push_back(
        fmt::format("wear is a gap: {}; above {:g} and {:g} use shape.motion = \"mesh\"", extent,
                    most_slope, most_thinning));
  else if (!parts.shape.gap && does && small && expected.deepest > 0)
    parts.proposals.push_back("wear as a gap would do, for less time (shape.motion = \"gap\"): " +
                              extent);
}

template <int dim>
std::vector<Surface<dim>> wearing(std::vector<Surface<dim>> surfaces) {
  std::erase_if(surfaces, [](const Surface<dim>& surface) { return !surface.wears; });
  return surfaces;
}

}  // namespace

template <int dim>
AssemblyParts<dim> read_part(const Scene& scene, const ImportedBody<dim>& part) {
  AssemblyParts<dim> parts = read_all_but_shape(scene, part);
  require_pressed_pairs(scene, parts);
  Magnitudes magnitudes = find_magnitudes(scene, parts);
  parts.scales = magnitudes.scales;
  // Gaps are those of bodies at rest.
  if (const RigidBalance<dim> balance(parts, places_over_cycle(parts).front()); balance.settled) {
    AssemblyParts<dim> resting = parts;
    resting.mesh.nodes = balance.x;
    magnitudes = find_magnitudes(scene, resting);
    parts.scales = magnitudes.scales;
  }
  if (parts.interface.sticks) {
    require_path(scene, parts);
    parts.interface.memory_follows = memory_follows(scene);
    if (std::string history = history_that_matters(parts); !history.empty())
      parts.proposals.push_back(std::move(history));
    AssemblyParts<dim> slow = parts;
    for (int k = 0; k < 2; ++k) {  // the second time with what the first speed wears
      slow.interface.speed = speed_on_path(slow, magnitudes);
      magnitudes = find_magnitudes(scene, slow);
    }
    if (*parts.interface.speed == 0) {
      parts.interface.speed = slow.interface.speed;
      read_laws_again(scene, parts);
    }
    parts.scales = magnitudes.scales;
  }
  if (parts.interface.rolling) {
    for (int k = 0; k < 2; ++k) {  // the second time with what the first speed wears
      if (!scene.given("wear.velocity")) {
        parts.interface.speed = speed_of_rolling(parts, magnitudes);
        read_laws_again(scene, parts);
      }
      magnitudes = find_magnitudes(scene, parts);
    }
    scale_creepages(magnitudes, parts);
    parts.scales = magnitudes.scales;
  }
  if (parts.pairs.empty())
    join_reachable_boundary(magnitudes, parts);
  else
    restrict_pairs(scene, part, magnitudes, parts);
  const std::optional<CyclicMotion<dim>> cycle =
      parts.cycle ? std::optional(parts.cycle->motion) : std::nullopt;
  if (cycle && !parts.interface.sticks) require_gross_sliding(scene, *cycle, parts);
  require_lines(scene, part, parts);
  const ShapeSupport<dim> support =
      read_shape_support(scene, part, wearing(parts.interface.surfaces),
                         bonded_facets(parts.mesh, parts.bodies), magnitudes.deepest);
  parts.shape = read_shape_motion<dim>(scene, support.held, support.along);
  require_receding_tracks(scene, parts);
  append(parts.remarks, remarks_on_tracks(magnitudes, parts));
  if (std::isfinite(support.reach))
    parts.remarks.push_back(fmt::format(
        "the mesh moves within {:.3g} mm of the wearing surfaces (shape.reach)", support.reach));
  warn_of_coarse_contact<dim>(magnitudes, parts.remarks);
  const std::string units = doubt_about_units(magnitudes, !parts.pairs.empty());
  if (!units.empty()) parts.remarks.push_back(units);
  append(parts.remarks, remarks_on_bodies(scene, part));
  append(parts.remarks, doubts(parts.bodies));
  append(parts.remarks, remarks_on_loads(scene));
  if (!parts.pairs.empty()) append(parts.remarks, remarks_on_pivots(scene, part));
  const std::vector<ContactPatch<dim>> patches = contact_nodes_of(parts);
  if (parts.pairs.empty() && !parts.interface.sticks && !parts.interface.rolling)
    append(parts.remarks, remarks_on_speeds(scene, patches, parts.interface.partner, cycle));
  keep_normals_to_supports(parts);
  complete_surface_laws(scene, parts);
  append(parts.remarks, remarks_on_passing_material(scene, parts));
  parts = completed(scene, magnitudes.facet, std::move(parts));
  judge_gap(magnitudes, parts);
  require_moving_shape(scene, patches, parts.shape);
  require_held(scene, parts, units);
  return parts;
}

namespace {

template <int dim>
std::unique_ptr<Model> model_of(const Scene& scene, const ImportedBody<dim>& part) {
  const auto with = [&](long phases) { return read_part<dim>(with_phases(scene, phases), part); };
  return std::make_unique<WearModel<dim>>(!chooses_phases(scene) ? read_part<dim>(scene, part)
                                          : may_stick(scene)
                                              ? with_chosen_path<dim>(scene, with)
                                              : with_chosen_phases<dim>(scene, with));
}

template <int dim>
std::unique_ptr<Model> model_of_file(const Scene& scene, ImportedMesh mesh) {
  return model_of<dim>(scene, check_mesh<dim>(std::move(mesh), scene.texts("wear.on"),
                                              static_cast<int>(scene.integer("mesh.split")),
                                              separate_bodies(scene)));
}

/// 2 or 3 by the numbers of the counter-body's vectors; 0 if it has none.
std::size_t dimension_of(const Scene& scene) {
  for (const char* key : {"counter_body.press.direction", "counter_body.center"})
    if (scene.given(key)) return scene.reals(key).size();
  const std::string velocity = "counter_body.motion.velocity";  // of a plane one also out of it
  return scene.given(velocity) && scene.reals(velocity).size() == 2 ? 2 : 0;
}

/// The mistakes that can be found without the mesh.
void find_mistakes_without_mesh(const Scene& scene, Mistakes& mistakes) {
  find_conflicts(scene, mistakes);
  find_mistakes_of_supports(scene, mistakes);
  find_mistakes_of_loads(scene, mistakes);
  const std::size_t dim = has_pairs(scene) ? 0 : dimension_of(scene);
  if (dim == 2) mistakes.collect([&] { read_counter_body<2>(scene, section_of(scene)); });
  if (dim == 3) mistakes.collect([&] { read_counter_body<3>(scene, Section::plane); });
}

}  // namespace

std::unique_ptr<Model> make_part(const Scene& scene) {
  ImportedMesh mesh;
  Mistakes mistakes;
  find_mistakes_of_pairs(scene, mistakes);
  mistakes.require_none();
  if (!mistakes.collect([&] { mesh = read_graded_mesh(scene); }))
    find_mistakes_without_mesh(scene, mistakes);
  mistakes.require_none();
  return mesh.dimension == 2 ? model_of_file<2>(scene, std::move(mesh))
                             : model_of_file<3>(scene, std::move(mesh));
}

std::unique_ptr<Model> remake_part(const Scene& scene, const Grid& grid) {
  if (grid.cell == Grid::Cell::quadrilateral)
    return model_of<2>(scene, part_of_grid<2>(grid, scene.path().string()));
  return model_of<3>(scene, part_of_grid<3>(grid, scene.path().string()));
}

void find_mistakes_of_groups(const Scene& scene, Mistakes& mistakes) {
  find_conflicts(scene, mistakes);
  mistakes.collect([&] {
    ImportedMesh mesh = read_mesh(scene);
    const std::vector<std::string> separate = separate_bodies(scene);
    if (mesh.dimension == 2)
      find_unknown_groups(scene, check_mesh<2>(std::move(mesh), {}, 0, separate), mistakes);
    else
      find_unknown_groups(scene, check_mesh<3>(std::move(mesh), {}, 0, separate), mistakes);
  });
}

template AssemblyParts<2> read_part(const Scene&, const ImportedBody<2>&);
template AssemblyParts<3> read_part(const Scene&, const ImportedBody<3>&);

}  // namespace gnomon
