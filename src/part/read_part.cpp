// The parts of an assembly from a scene and its mesh.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <gnomon/base/error.hpp>
#include <gnomon/checks/checks.hpp>
#include <gnomon/model/magnitudes.hpp>
#include <gnomon/part/assembly_scene.hpp>
#include <gnomon/part/part_scene.hpp>
#include <gnomon/shapes/counter_surface.hpp>

#include "model/bring_together.hpp"
#include "model/rigid_balance.hpp"
#include "part/bodies.hpp"
#include "part/changing_friction.hpp"
#include "part/facing_facets.hpp"
#include "part/first_loading.hpp"
#include "part/friction_limit.hpp"
#include "part/groups.hpp"
#include "part/held_bodies.hpp"
#include "part/nominal_speed.hpp"
#include "part/pair_cycle.hpp"
#include "part/pairs.hpp"
#include "part/phases.hpp"
#include "part/rolling_scene.hpp"
#include "part/shape_support.hpp"
#include "part/stick_path.hpp"
#include "part/surfaces.hpp"
#include "part/symmetry.hpp"
#include "part/tracks.hpp"
#include "part/unshaped_part.hpp"

namespace gnomon {

namespace {

using namespace part;

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

/// How far bodies of pairs that nothing moves are apart, in words; where a cycle does, nothing.
template <int dim>
std::string distance_text(const AssemblyParts<dim>& parts) {
  if (parts.cycle) return "";
  const double rounding = 1e-9 * Box<dim>::around(parts.mesh.nodes).diagonal();
  std::vector<std::string> apart;
  for (const MortarPair<dim>& pair : parts.pairs)
    if (const double gap = travel_to_touch<dim>(pair, pair.approach, parts.mesh.nodes);
        std::isfinite(gap) && gap > rounding)
      apart.push_back(fmt::format("\"{}\" and \"{}\" are {:.3g} mm apart", pair.bodies[0],
                                  pair.bodies[1], gap));
  return apart.empty() ? "" : fmt::format(", or meshes that overlap: {}", fmt::join(apart, ", "));
}

/// Throws where nothing presses the bodies on each other.
template <int dim>
Magnitudes find_magnitudes(const Scene& scene, const AssemblyParts<dim>& parts) try {
  const double duration = scene.real("time.end");
  const Pressing press = pressing_of(parts, duration);
  if (press.force == 0 && press.overlap == 0)
    throw NothingPresses(fmt::format(
        "{}: expected something that presses the bodies on each other: {}a [[load]] "
        "against the {}, or a [[support]] with value{}{}",
        scene.path().string(), parts.pairs.empty() ? "counter_body.press.force or .approach, " : "",
        parts.pairs.empty() ? "counter-body" : "other body",
        parts.cycle ? ", or phases in which bodies overlap" : "", distance_text(parts)));
  return magnitudes_of(parts, duration);
} catch (const RecoverableError& error) {
  throw unsound_law(scene, error);
}

void append(std::vector<std::string>& remarks, const std::vector<std::string>& more) {
  remarks.insert(remarks.end(), more.begin(), more.end());
}

/// Once more, with the final speed: sliding distances count by it.
template <int dim>
void read_laws_again(const Scene& scene, AssemblyParts<dim>& parts) {
  for (Surface<dim>& surface : parts.interface.surfaces)
    if (surface.wears)
      surface.wear = read_surface_law(scene, surface.name, parts.nominal_speed(surface));
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
void judge_gap(const Scene& scene, const Magnitudes& expected, AssemblyParts<dim>& parts) {
  constexpr double most_slope = 0.5, most_thinning = 0.06;
  const bool does = expected.slope <= most_slope && expected.thinning <= most_thinning;
  const std::string extent = fmt::format(
      "the worn surface is expected to have a slope of about {:.2g}, and a depth of {:.2g} times "
      "the body's size",
      expected.slope, expected.thinning);
  const bool small = has_small_strains(parts.bodies);
  if (parts.shape.gap && !does && scene.is_set("shape.motion"))  // a plan has measured it
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
  AssemblyParts<dim> parts = read_unshaped_part(scene, part);
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
    if (std::string remark = remark_on_friction(scene, parts); !remark.empty())
      parts.remarks.push_back(std::move(remark));
    if (parts.pairs.size() > 1)
      parts.remarks.push_back(
          "stroke, friction_force and the loop are those of the first [[pair]]; friction_work, "
          "slip_path and stick_area are of all");
    if (std::string history = history_that_matters(parts); !history.empty())
      parts.proposals.push_back(std::move(history));
    AssemblyParts<dim> slow = parts;
    for (int k = 0; k < 2; ++k) {  // the second time with what the first speed wears
      slow.interface.speed = speed_on_path(scene, slow, magnitudes);
      magnitudes = find_magnitudes(scene, slow);
    }
    if (*parts.interface.speed == 0) {
      parts.interface.speed = slow.interface.speed;
      read_laws_again(scene, parts);
    }
    parts.scales = magnitudes.scales;
  }
  if (parts.interface.rolling) {
    if (!slips_as_given(parts) && !scene.given("wear.velocity")) require_no_distance(scene);
    if (!parts.pairs.empty() && parts.pairs.front().slides > 0) {  // the speed is that of the first
      const double first = parts.pairs.front().slides;
      for (MortarPair<dim>& pair : parts.pairs) pair.slides /= first;
    }
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
  if (parts.interface.rolling) require_balanced_rolling(scene, parts);
  const std::optional<CyclicMotion<dim>> cycle =
      parts.cycle ? std::optional(parts.cycle->motion) : std::nullopt;
  if (cycle && !parts.interface.sticks) require_gross_sliding(scene, *cycle, parts);
  require_lines(scene, parts);
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
  append(parts.remarks, remarks_on_symmetry(parts, magnitudes));
  if (!parts.pairs.empty()) append(parts.remarks, remarks_on_pivots(scene, part));
  const std::vector<ContactPatch<dim>> patches = contact_nodes_of(parts);
  if (parts.pairs.empty() && !parts.interface.sticks && !parts.interface.rolling)
    append(parts.remarks, remarks_on_speeds(scene, patches, parts.interface.partner, cycle));
  keep_normals_to_supports(parts);
  complete_surface_laws(scene, parts);
  append(parts.remarks, remarks_on_passing_material(scene, parts));
  parts = completed(scene, magnitudes.facet, std::move(parts));
  judge_gap(scene, magnitudes, parts);
  require_moving_shape(scene, patches, parts.shape);
  require_held(scene, parts, units);
  return parts;
}

template AssemblyParts<2> read_part(const Scene&, const ImportedBody<2>&);
template AssemblyParts<3> read_part(const Scene&, const ImportedBody<3>&);

}  // namespace gnomon
